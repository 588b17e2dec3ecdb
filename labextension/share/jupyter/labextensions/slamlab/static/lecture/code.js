// Code on a slide: folded to its one telling line unless it is short or the subject; locked. Of code that
// asks a question nothing is shown: it holds the answer.

import { element } from "../element.js";
import { questionIn } from "../questions.js";

const SHORT = 6; // lines that need no folding
const SUBJECT = "code"; // tag of a cell whose code is what the slide is about
const SHOWS = /^(views\.|ax\.|fig\b|plt\.|display\(|with |for |@|\)|\]|\}|\w+ = \(?f?["'])/; // says little
const DRAWS = /^((\w+ = )?views\.|[)\]}])/; // the figure says more

const outerLines = (source) => source.split("\n").filter((line) => /^[^\s#]/.test(line));

// Whether code is to be read as it stands: it is short, and no long call that only shows something.
function isTold(source) {
  const lines = source.trim().split("\n").length;
  return lines === 1 || (lines <= SHORT && !outerLines(source).every((line) => DRAWS.test(line)));
}

// The line that stands for folded code: the last statement that does more than show something.
function tellingLine(source) {
  const outer = outerLines(source);
  const telling = outer.findLast((line) => !SHOWS.test(line)) ?? outer[0] ?? "";
  return telling;
}

// Code that a notebook folds away is folded by the deck in its own way, as long as it is shown.
export function takeFolding(cell) {
  if (cell.model.type !== "code" || !cell.inputHidden) return;
  cell.inputHidden = false;
  cell.node.dataset.slamlabFolded = "";
}

export function giveFoldingBack(cell) {
  if (!("slamlabFolded" in cell.node.dataset)) return;
  delete cell.node.dataset.slamlabFolded;
  cell.inputHidden = true;
}

export function foldCode(cell) {
  if (cell.model.type !== "code") return;
  const source = cell.model.sharedModel.getSource();
  const subject = cell.model.getMetadata("tags")?.includes(SUBJECT);
  const asks = Boolean(questionIn(source));
  cell.node.classList.toggle("slamlab-folded", asks || (!subject && !isTold(source)));
  let line = cell.node.querySelector(".slamlab-telling");
  if (!line) {
    line = element("code", "slamlab-telling");
    cell.inputArea.node.after(line);
  }
  line.textContent = asks ? "" : tellingLine(source);
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
