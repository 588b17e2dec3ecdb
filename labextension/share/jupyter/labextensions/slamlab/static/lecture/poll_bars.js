// Bar chart of a poll: each bar has a letter, a label and a count.

import { element } from "../element.js";

export const LETTERS = "ABCDEFGH";
const COLOUR = "#0072b2"; // of all bars: a colour of its own would mark a choice as right

function row(letter, words, count, share) {
  const filled = element("div");
  Object.assign(filled.style, { width: `${100 * share}%`, background: COLOUR });
  const bar = element("div", "slamlab-vote-bar", filled);
  bar.setAttribute("aria-hidden", "true");
  const parts = [element("strong", "", letter), element("span", "", words), element("span", "", String(count))];
  return element("li", "", element("div", "slamlab-vote-row", ...parts), bar);
}

export const many = (count, what) => `${count} ${what}${count === 1 ? "" : "s"}`;

const short = (number) => String(Number(number.toPrecision(6)));

// Draw the bars of a poll. question = {choices: texts or null, unit}.
export function drawBars(place, question, counts) {
  const rows = question.choices
    ? question.choices.map((text, n) => [LETTERS[n], text, counts.counts[n]])
    : counts.bars.map(({ from, to, count }) => {
      const range = from === to ? short(from) : `${short(from)} to ${short(to)}`;
      return ["", `${range} ${question.unit}`, count];
    });
  const list = rows.map(([letter, text, count]) => row(letter, text, count, count / Math.max(1, counts.answers)));
  const heading = element("h2", "", many(counts.answers, "answer"));
  const [low, , high] = (counts.quartiles ?? []).map(short);
  const middle = low ? [element("p", "", `Half of the answers are between ${low} and ${high} ${question.unit}.`)] : [];
  place.replaceChildren(heading, element("ul", "", ...list), ...middle);
}
