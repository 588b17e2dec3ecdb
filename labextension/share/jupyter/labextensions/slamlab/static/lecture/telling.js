// Which code is folded on a slide, and the one line that stands for it then.

import { questionIn } from "../questions.js";

const SHORT = 6; // lines that need no folding
const SUBJECT = "code"; // tag of a cell whose code is what the slide is about
const SHOWS = /^(\w+$|views\.|ax\.|fig\b|plt\.|display\(|with |for |@|\)|\]|\}|\w+ = \(?f?["'])/; // says little
const OPENS = /[([{,]$|= (\{\}|\[\])$/; // a statement's first line alone, or a beginning, says little, too
const DRAWS = /^((\w+ = )?views\.|[)\]}])/; // the figure says more

const outerLines = (source) => source.split("\n").filter((line) => /^[^\s#]/.test(line));

// Whether code is to be read as it stands: it is short, and no long call that only shows something.
function isTold(source) {
  const lines = source.trim().split("\n").length;
  return lines === 1 || (lines <= SHORT && !outerLines(source).every((line) => DRAWS.test(line)));
}

// Whether the deck folds code; `folded`: the notebook does.
export function isFolded({ source, tags = [], folded = false }) {
  return folded || Boolean(questionIn(source)) || (!tags.includes(SUBJECT) && !isTold(source));
}

// The last statement of one line that does more than show something; undefined where there is none.
const statement = (source) => outerLines(source).findLast((line) => !SHOWS.test(line) && !OPENS.test(line));

// The line that says what folded code does: such a statement, else the comment that the code begins with.
export const tellingLine = (source) => statement(source) ?? /^# *\S.*/.exec(source)?.[0];

// What stands on a slide for folded code. Where it has no such statement, or where the notebook folds it, too, its
// output stands for it, and has its room.
export function standsFor({ source, folded, hasOutput }) {
  if (questionIn(source) || (hasOutput && folded)) return "";
  return (hasOutput ? statement(source) : tellingLine(source) ?? outerLines(source)[0]) ?? "";
}
