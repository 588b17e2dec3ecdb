// Code folding on slides: which code is folded, and its one-line summary.

import { questionIn } from "../questions.js";

const SHORT = 6; // lines of code that is not folded
const SUBJECT = "code"; // tag of a cell whose code is the subject of the slide
const SHOWS = /^(\w+$|(views|live)\.|ax\.|fig\b|plt\.|(display|print|Markdown)\(|(with|for|if|elif|else|try|except|assert)\b|@|\)|\]|\}|\w+ = \(?f?["'])/; // statements that only show something
const INCOMPLETE = /[([{,]$|= (\{\}|\[\])$/; // the first line of a statement, or an empty container
const DRAWS = /^(\w+ = )?(views|live)\./; // the figure is more informative
const CLOSES = /^[)\]}]/; // the last line of a statement

const outerLines = (source) => source.split("\n").filter((line) => /^[^\s#]/.test(line));

// Whether code is shown in full: it is short, and does not end in drawing.
function isShownInFull(source) {
  const lines = source.trim().split("\n").length;
  return lines === 1 || (lines <= SHORT && !DRAWS.test(outerLines(source).findLast((line) => !CLOSES.test(line))));
}

// Whether the deck folds code; `folded`: the notebook folds it.
export function isFolded({ source, tags = [], folded = false }) {
  return folded || Boolean(questionIn(source)) || (!tags.includes(SUBJECT) && !isShownInFull(source));
}

// The last one-line statement that does not only show something; undefined if there is none.
const statement = (source) => outerLines(source).findLast((line) => !SHOWS.test(line) && !INCOMPLETE.test(line));

// Summary line of folded code: the comment at the beginning, or else such a statement.
export const summaryLine = (source) => /^# *\S.*/.exec(source)?.[0] ?? statement(source);

// Text shown for folded code. Without a summary line, or if the notebook folds the code, only the output is
// shown.
export function summaryOf({ source, folded, hasOutput }) {
  if (questionIn(source) || (hasOutput && folded)) return "";
  return summaryLine(source) ?? (hasOutput ? "" : outerLines(source)[0]) ?? "";
}
