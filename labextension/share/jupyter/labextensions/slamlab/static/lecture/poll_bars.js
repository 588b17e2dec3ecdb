// What the class has answered, as bars: each with its letter, its words and its count, not its colour alone.

import { element } from "../element.js";

export const LETTERS = "ABCDEFGH";
const COLOURS = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442", "#000000"];

function row(letter, words, count, most, colour) {
  const filled = element("div");
  Object.assign(filled.style, { width: `${(100 * count) / most}%`, background: colour });
  const bar = element("div", "slamlab-vote-bar", filled);
  bar.setAttribute("aria-hidden", "true");
  const told = [element("strong", "", letter), element("span", "", words), element("span", "", String(count))];
  return element("li", "", element("div", "slamlab-vote-row", ...told), bar);
}

export const many = (count, what) => `${count} ${what}${count === 1 ? "" : "s"}`;

const short = (number) => String(Number(number.toPrecision(3)));

// The bars of a poll's counts. question = {choices: texts or null, unit}.
export function drawBars(place, question, counts) {
  const rows = question.choices
    ? question.choices.map((text, n) => [LETTERS[n], text, counts.counts[n], COLOURS[n]])
    : counts.bars.map(({ from, to, count }) => {
      const range = from === to ? short(from) : `${short(from)} to ${short(to)}`;
      return ["", `${range} ${question.unit}`, count, COLOURS[0]];
    });
  const most = Math.max(1, ...rows.map((one) => one[2]));
  const list = rows.map(([letter, text, count, colour]) => row(letter, text, count, most, colour));
  const heading = element("h2", "", many(counts.answers, "answer"));
  const [low, , high] = (counts.quartiles ?? []).map(short);
  const middle = low ? [element("p", "", `Half of them lie between ${low} and ${high} ${question.unit}.`)] : [];
  place.replaceChildren(heading, element("ul", "", ...list), ...middle);
}
