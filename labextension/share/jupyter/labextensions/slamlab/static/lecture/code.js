// Code on a slide: folded to its one telling line unless it is short or the subject; locked. Nothing is shown
// of code that the notebook folds, which nobody needs to read, and of a question, which holds the answer.

import { element } from "../element.js";
import { questionIn } from "../questions.js";

const SHORT = 6; // lines that need no folding
const SUBJECT = "code"; // tag of a cell whose code is what the slide is about
const SHOWS = /^(views\.|ax\.|fig\b|plt\.|display\(|with |for |@|\)|\]|\}|\w+ = \(?f?["'])/; // says little
const FOLDED = "slamlabFolded"; // by the notebook
const OPENS = /[([{,]$|= (\{\}|\[\])$/; // a statement's first line alone, or a beginning, says little, too
const DRAWS = /^((\w+ = )?views\.|[)\]}])/; // the figure says more

const outerLines = (source) => source.split("\n").filter((line) => /^[^\s#]/.test(line));

// Whether code is to be read as it stands: it is short, and no long call that only shows something.
function isTold(source) {
  const lines = source.trim().split("\n").length;
  return lines === 1 || (lines <= SHORT && !outerLines(source).every((line) => DRAWS.test(line)));
}

// The line that stands for folded code: the last statement of one line that does more than show something.
// Where there is none, or where the notebook folds it, too, the output stands for it, and has its room.
function tellingLine(cell, source) {
  const hasOutput = cell.model.outputs.length > 0;
  if (questionIn(source) || (hasOutput && FOLDED in cell.node.dataset)) return "";
  const outer = outerLines(source);
  const telling = outer.findLast((line) => !SHOWS.test(line) && !OPENS.test(line));
  return telling ?? (hasOutput ? "" : outer[0] ?? "");
}

// Whether the deck folds a cell's code.
function isFolded(cell, source) {
  const subject = cell.model.getMetadata("tags")?.includes(SUBJECT);
  return FOLDED in cell.node.dataset || Boolean(questionIn(source)) || (!subject && !isTold(source));
}

// Code that was run, gave no output, and is folded to a line, which fills no slide by itself.
export function saysLittle(cell) {
  const { type, executionCount, outputs, sharedModel } = cell.model;
  return type === "code" && executionCount !== null && !outputs.length && isFolded(cell, sharedModel.getSource());
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
  const source = cell.model.sharedModel.getSource();
  cell.node.classList.toggle("slamlab-folded", isFolded(cell, source));
  let line = cell.node.querySelector(".slamlab-telling");
  if (!line) {
    line = element("code", "slamlab-telling");
    cell.inputArea.node.after(line);
  }
  line.textContent = tellingLine(cell, source);
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
