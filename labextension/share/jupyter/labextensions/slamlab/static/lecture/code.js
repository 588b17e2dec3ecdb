// Code on a slide: folded to its one telling line unless it is short or the subject; locked. Nothing is shown
// of code that the notebook folds, which nobody needs to read, and of a question, which holds the answer.

import { element } from "../element.js";
import { isFolded, standsFor } from "./telling.js";

const FOLDED = "slamlabFolded"; // by the notebook

const told = (cell) => ({
  source: cell.model.sharedModel.getSource(),
  tags: cell.model.getMetadata("tags"),
  folded: FOLDED in cell.node.dataset,
  hasOutput: cell.model.outputs.length > 0,
});

// Code that was run, gave no output, and is folded to a line, which fills no slide by itself.
export function saysLittle(cell) {
  const { type, executionCount, outputs } = cell.model;
  return type === "code" && executionCount !== null && !outputs.length && isFolded(told(cell));
}

// Code that a notebook folds away is folded by the deck in its own way, as long as it is shown.
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
  cell.node.classList.toggle("slamlab-folded", isFolded(told(cell)));
  let line = cell.node.querySelector(".slamlab-telling");
  if (!line) {
    line = element("code", "slamlab-telling");
    cell.inputArea.node.after(line);
  }
  line.textContent = standsFor(told(cell));
}

// Nobody edits by accident: what is inert takes no focus, no key and no click.
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
