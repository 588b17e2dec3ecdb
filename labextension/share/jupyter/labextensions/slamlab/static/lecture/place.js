// The place in the notebook where a lecture begins and ends.

// Make a cell the active one and bring it into sight, once its notebook is laid out.
export function goToCell(notebook, index) {
  notebook.activeCellIndex = Math.max(0, index);
  requestAnimationFrame(() => notebook.scrollToItem(notebook.activeCellIndex, "start"));
}
