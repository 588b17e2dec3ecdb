// What the class has answered, as bars: each with its letter, its words and its count, not its colour alone.

import { element } from "../element.js";

const COLOURS = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442", "#000000"];

function row(letter, words, count, most, colour) {
  const filled = element("div");
  Object.assign(filled.style, { width: `${(100 * count) / most}%`, background: colour });
  const bar = element("div", "slamlab-vote-bar", filled);
  bar.setAttribute("aria-hidden", "true");
  return element("li", "", element("div", "slamlab-vote-row", element("strong", "", letter), words, element("span", "", String(count))), bar);
}

const short = (number) => String(Number(number.toPrecision(3)));

// The bars of a poll's counts. question = {choices: texts or null, unit}.
export function drawBars(place, question, counts) {
  const rows = question.choices
    ? question.choices.map((text, n) => ["ABCDEFGH"[n], text, counts.counts[n], COLOURS[n]])
    : counts.bars.map(({ from, to, count }) => {
      const range = from === to ? short(from) : `${short(from)} to ${short(to)}`;
      return ["", `${range} ${question.unit}`, count, COLOURS[0]];
    });
  const most = Math.max(1, ...rows.map((one) => one[2]));
  const list = rows.map(([letter, text, count, colour]) => row(letter, element("span", "", text), count, most, colour));
  const heading = element("h2", "", `${counts.answers} ${counts.answers === 1 ? "answer" : "answers"}`);
  const middle = counts.quartiles?.length
    ? [element("p", "", `Half of them lie between ${short(counts.quartiles[0])} and ${short(counts.quartiles[2])} ${question.unit}.`)]
    : [];
  place.replaceChildren(heading, element("ul", "", ...list), ...middle);
}
