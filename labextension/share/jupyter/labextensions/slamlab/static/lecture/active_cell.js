// The active cell, where a lecture begins and ends.

// Activate a cell and scroll to it, after the notebook is laid out.
export function goToCell(notebook, index) {
  notebook.activeCellIndex = Math.max(0, index);
  requestAnimationFrame(() => notebook.scrollToItem(notebook.activeCellIndex, "start"));
}
