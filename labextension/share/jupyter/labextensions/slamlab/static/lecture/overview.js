// All slides at a glance: a card each, with its heading and its first picture.

import { element } from "../element.js";
import { htmlOf } from "./stops.js";

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
  list.addEventListener("keydown", (event) => step(list, event));
}

function card(deck, slide, number) {
  const button = element("button", "", element("b", "", `${number + 1}`), element("span", "", slide.title || "—"));
  if (slide.minutes) button.append(element("small", "", `${slide.minutes} min`));
  const html = slide.cells.map((index) => htmlOf(deck.notebook.widgets[index])).join("");
  const src = /src="(data:image[^"]+)"/.exec(html)?.[1];
  if (src) button.append(Object.assign(new Image(), { src, alt: "" }));
  if (number === deck.slide) button.setAttribute("aria-current", "true");
  button.addEventListener("click", () => {
    deck.layer.querySelector(OPEN).remove();
    deck.goToSlide(number);
  });
  return element("li", "", button);
}

function step(list, event) {
  const buttons = [...list.querySelectorAll("button")];
  const by = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
  if (event.key === "o") list.remove();
  if (!by) return;
  buttons[buttons.indexOf(document.activeElement) + by]?.focus();
  event.preventDefault();
}
