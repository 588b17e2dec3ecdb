// All slides at a glance: a card each, with its heading and its first picture.

import { htmlOf } from "./stops.js";

const OPEN = ".slamlab-overview";

export function toggleOverview(deck) {
  const open = deck.layer.querySelector(OPEN);
  if (open) return open.remove();
  const list = document.createElement("ol");
  list.className = "slamlab-overview";
  list.dataset.slamlabCloses = "";
  list.setAttribute("aria-label", "All slides");
  list.append(...deck.slides.map((slide, number) => card(deck, slide, number)));
  deck.layer.append(list);
  list.querySelectorAll("button")[deck.slide].focus();
  list.addEventListener("keydown", (event) => step(list, event));
}

function card(deck, slide, number) {
  const item = document.createElement("li");
  const button = document.createElement("button");
  button.append(element("b", `${number + 1}`), element("span", slide.title || "—"));
  if (slide.minutes) button.append(element("small", `${slide.minutes} min`));
  const html = slide.cells.map((index) => htmlOf(deck.notebook.widgets[index])).join("");
  const src = /src="(data:image[^"]+)"/.exec(html)?.[1];
  if (src) button.append(Object.assign(new Image(), { src, alt: "" }));
  if (number === deck.slide) button.setAttribute("aria-current", "true");
  button.addEventListener("click", () => {
    deck.layer.querySelector(OPEN).remove();
    deck.go(deck.stops.findIndex((stop) => stop.slide === number));
  });
  item.append(button);
  return item;
}

export function element(tag, text, className = "") {
  return Object.assign(document.createElement(tag), { textContent: text, className });
}

function step(list, event) {
  const buttons = [...list.querySelectorAll("button")];
  const by = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
  if (event.key === "o") list.remove();
  if (!by) return;
  buttons[buttons.indexOf(document.activeElement) + by]?.focus();
  event.preventDefault();
}
