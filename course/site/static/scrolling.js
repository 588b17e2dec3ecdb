// What scrolls sideways can be scrolled with the keyboard; what does not is no stop of the Tab key.
{
  const WIDE = ".highlight pre, .formula, .cell_output table, .table-wrapper";

  function stopWhereItScrolls() {
    for (const block of document.querySelectorAll(WIDE)) {
      if (block.scrollWidth > block.clientWidth) block.tabIndex = 0;
      else block.removeAttribute("tabindex");
    }
  }

  addEventListener("resize", stopWhereItScrolls);
  document.fonts.ready.then(stopWhereItScrolls);
}
