// Accessible names of cells and controls, and a hint for widgets without a kernel.

import { forEachElement } from "./observing.js";

const TEXT = ".jp-OutputArea-output, .jp-MarkdownOutput";
const OUTPUT = ".jp-OutputArea-output";
const HINT = "Run this cell for its controls.";

export function nameParts(panel) {
  // JupyterLab's cell list has the role feed, whose children must be articles; editors have no names
  forEachElement(panel, ".jp-Cell", (cell) => cell.setAttribute("role", "article"));
  forEachElement(panel, ".jp-Cell .cm-content", (editor) => {
    const code = editor.closest(".jp-CodeCell");
    editor.setAttribute("aria-label", code ? "code" : "text");
  });
  forEachElement(panel, ".jp-collapseHeadingButton", (button) => {
    button.setAttribute("aria-label", "Fold this section");
  });
  // wide outputs scroll and need keyboard focus; a formula grows when it is typeset
  forEachElement(panel, `:is(${TEXT}), :is(${TEXT}) mjx-container`, (part) => {
    const text = part.closest(TEXT);
    new ResizeObserver(() => {
      if (text.scrollWidth > text.clientWidth) text.tabIndex = 0;
      else text.removeAttribute("tabindex");
    }).observe(part);
  });
}

export function nameControls(panel) {
  forEachElement(panel, ".widget-slider .noUi-handle", (handle) => {
    const slider = handle.closest(".widget-slider");
    const label = slider.querySelector(".widget-label")?.textContent;
    handle.setAttribute("aria-label", label || "slider");
    const readout = slider.querySelector(".widget-readout");
    readout?.setAttribute("aria-label", `${label}, as a number`);
    readout?.setAttribute("role", "textbox");
    // screen readers would read 16 digits
    const VALUE = "aria-valuetext";
    const update = () => {
      const text = readout?.textContent;
      if (text && handle.getAttribute(VALUE) !== text) handle.setAttribute(VALUE, text);
    };
    update();
    new MutationObserver(update).observe(handle, { attributeFilter: [VALUE] });
  });
  // a field without a label is named by its tooltip
  forEachElement(panel, ".jupyter-widgets textarea[title]", (field) => {
    field.setAttribute("aria-label", field.title);
  });
}

// Keep keys for a control in an output: otherwise JupyterLab would cut a cell by x, or select the next
// one by an arrow. It looks for shortcuts from the focused element up to this attribute.
export function keepKeys() {
  const keep = (event) => {
    const { target } = event;
    if (!target.parentElement?.closest(OUTPUT)) return; // wide text is itself the output
    const lab = event.ctrlKey || event.metaKey || event.altKey || (event.shiftKey && event.key === "Enter");
    target.toggleAttribute("data-lm-suppress-shortcuts", !lab || Boolean(target.closest(".slamlab-deck")));
  };
  window.addEventListener("keydown", keep, true);
}

export function explainDeadWidgets(panel) {
  // replace the error of a widget without a kernel, as after a notebook is opened again
  forEachElement(panel, ".jp-OutputArea-output.jupyter-widgets", (output) => {
    const update = () => {
      if (!/^Error displaying widget/.test(output.textContent)) return;
      output.textContent = HINT;
      output.classList.add("slamlab-dead");
    };
    update();
    new MutationObserver(update).observe(output, { childList: true, characterData: true, subtree: true });
  });
}
