// Names for what a reader without a screen meets, and plain words where no kernel moves controls.

import { forEachElement } from "./watching.js";

const TEXT = ".jp-OutputArea-output, .jp-MarkdownOutput";
const OUTPUT = ".jp-OutputArea-output";
const DEAD = "Run this cell for its controls.";

export function nameParts(panel) {
  // JupyterLab calls the cells a feed, whose parts must be articles, and names no editor
  forEachElement(panel, ".jp-Cell", (cell) => cell.setAttribute("role", "article"));
  forEachElement(panel, ".jp-Cell .cm-content", (editor) => {
    const code = editor.closest(".jp-CodeCell");
    editor.setAttribute("aria-label", code ? "code" : "text");
  });
  forEachElement(panel, ".jp-collapseHeadingButton", (button) => {
    button.setAttribute("aria-label", "fold this section");
  });
  // what is too wide and scrolls is reached without a mouse; a formula grows when it is typeset
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
    // it would be read out with 16 digits
    const VALUE = "aria-valuetext";
    const tell = () => {
      const text = readout?.textContent;
      if (text && handle.getAttribute(VALUE) !== text) handle.setAttribute(VALUE, text);
    };
    tell();
    new MutationObserver(tell).observe(handle, { attributeFilter: [VALUE] });
  });
  // a field without a label: what is shown when the mouse rests on it
  forEachElement(panel, ".jupyter-widgets textarea[title]", (field) => {
    field.setAttribute("aria-label", field.title);
  });
}

// Keys on a control in an output are its own: JupyterLab, which listens first, would cut a cell by x
// and go to the next by an arrow. It looks for shortcuts from the focus outwards, up to this mark.
export function keepKeys() {
  const keep = (event) => {
    const { target } = event;
    if (!target.parentElement?.closest(OUTPUT)) return; // wide text is an output itself
    const lab = event.ctrlKey || event.metaKey || event.altKey || (event.shiftKey && event.key === "Enter");
    target.toggleAttribute("data-lm-suppress-shortcuts", !lab || Boolean(target.closest(".slamlab-deck")));
  };
  window.addEventListener("keydown", keep, true);
}

export function tellDeadWidgets(panel) {
  // the line that stands for a widget whose kernel is gone, as after a notebook is opened again
  forEachElement(panel, ".jp-OutputArea-output.jupyter-widgets", (output) => {
    const tell = () => {
      if (!/^Error displaying widget/.test(output.textContent)) return;
      output.textContent = DEAD;
      output.classList.add("slamlab-dead");
    };
    tell();
    new MutationObserver(tell).observe(output, { childList: true, characterData: true, subtree: true });
  });
}
