// Overview of all slides: a card for each, with its heading and its first picture or text.

import { element } from "../element.js";
import { questionIn } from "../questions.js";
import { htmlOf } from "./slides.js";
import { summaryOf } from "./code_summary.js";

const OPEN = ".slamlab-overview";

export function toggleOverview(deck) {
  const open = deck.layer.querySelector(OPEN);
  if (open) return open.remove();
  const list = element("ol", "slamlab-overview");
  list.dataset.slamlabCloses = "";
  list.setAttribute("aria-label", "All slides");
  list.append(...deck.slides.map((slide, number) => card(deck, slide, number)));
  deck.layer.append(list);
  list.querySelectorAll("button")[deck.slide].focus();
  list.typed = ""; // digits of a slide's number
  list.addEventListener("keydown", (event) => step(list, event));
}

function card(deck, slide, number) {
  const cells = slide.cells.map((index) => deck.notebook.widgets[index]);
  const minutes = slide.minutes ? element("small", "", `${slide.minutes} min`) : "";
  const head = element("span", "", element("b", "", `${number + 1}`), slide.title || "—", minutes);
  const src = /src="(data:image[^"]+)"/.exec(cells.map(htmlOf).join(""))?.[1];
  const button = element("button", "", head, src ? Object.assign(new Image(), { src, alt: "" })
    : element("small", "", [...cells.filter(isSaid), ...cells].map(textOf).find(Boolean) ?? ""));
  if (number === deck.slide) button.setAttribute("aria-current", "true");
  button.addEventListener("click", () => {
    deck.layer.querySelector(OPEN).remove();
    deck.goToSlide(number);
  });
  return element("li", "", button);
}

// Whether a cell is text or a question; the text of other cells comes after it.
const isSaid = ({ model }) => model.type === "markdown" || Boolean(questionIn(model.sharedModel.getSource()));

// Text of a cell that distinguishes slides with the same heading, without formulas and the lines of tables.
function textOf({ model }) {
  const source = model.sharedModel.getSource();
  if (questionIn(source)) return "a question";
  if (model.type === "code") return [model.outputs.toJSON().find(({ text }) => text)?.text ?? summaryOf({ source })].flat().join("");
  return source.replace(/^#.*$/gm, "").replace(/\$\$?[^$]+\$\$?/g, "…").replace(/[*`]|\]\(.*?\)|\[/g, "").replace(/^[|: -]+$/gm, "").replace(/ *\|+ */g, " ").trim();
}

function step(list, event) {
  const buttons = [...list.querySelectorAll("button")];
  const by = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
  if (event.key === "o") list.remove();
  if (/^[0-9]$/.test(event.key)) {
    const goesOn = Number(list.typed + event.key) <= buttons.length;
    list.typed = goesOn ? list.typed + event.key : event.key;
    buttons[Number(list.typed) - 1]?.focus();
  }
  if (!by) return;
  buttons[buttons.indexOf(document.activeElement) + by]?.focus();
  event.preventDefault();
}
