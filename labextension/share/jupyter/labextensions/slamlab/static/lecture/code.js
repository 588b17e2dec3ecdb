// Code on a slide: locked, and folded to one summary line unless it is short or the subject of the slide.
// Code that the notebook folds, and code of a question, which contains the answer, is hidden.

import { element } from "../element.js";
import { isFolded, summaryOf } from "./code_summary.js";

const FOLDED = "slamlabFolded"; // by the notebook

const properties = (cell) => ({
  source: cell.model.sharedModel.getSource(),
  tags: cell.model.getMetadata("tags"),
  folded: FOLDED in cell.node.dataset,
  hasOutput: cell.model.outputs.length > 0,
});

// Code that was run, has no output, and is folded to one line.
export function isSummaryOnly(cell) {
  const { type, executionCount, outputs } = cell.model;
  return type === "code" && executionCount !== null && !outputs.length && isFolded(properties(cell));
}

// The deck replaces the notebook's folding of code by its own.
export function takeFolding(cell) {
  if (cell.model.type !== "code" || !cell.inputHidden) return;
  cell.inputHidden = false;
  cell.node.dataset[FOLDED] = "";
}

export function giveFoldingBack(cell) {
  if (!(FOLDED in cell.node.dataset)) return;
  delete cell.node.dataset[FOLDED];
  cell.inputHidden = true;
}

export function foldCode(cell) {
  if (cell.model.type !== "code") return;
  cell.node.classList.toggle("slamlab-folded", isFolded(properties(cell)));
  let line = cell.node.querySelector(".slamlab-telling");
  if (!line) {
    line = element("code", "slamlab-telling");
    cell.inputArea.node.after(line);
  }
  line.textContent = summaryOf(properties(cell));
}

// Prevent edits by accident: an inert element gets no focus, key or click.
export function lockCode(cell, locked = true) {
  const area = cell.inputArea?.node;
  if (!area) return;
  if (cell.model.type === "code") area.inert = locked;
  cell.node.classList.toggle("slamlab-unlocked", false);
}

export function unlockCode(cell) {
  cell.inputArea.node.inert = false;
  cell.node.classList.remove("slamlab-folded");
  cell.node.classList.add("slamlab-unlocked");
  cell.editor?.focus();
}
