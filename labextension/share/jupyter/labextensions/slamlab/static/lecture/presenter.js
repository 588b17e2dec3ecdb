// The presenter's window: notes, the slide that comes, time; its keys are the deck's. It asks for all it
// shows, so that it does not matter which of the two windows was there first, or was reloaded.

import { element, giveBackFocus } from "../element.js";
import { channelOf } from "./channel.js";
import { nameOf } from "./guard.js";
import { clockFace, planAt, plannedAt } from "./plan.js";
import { Screen } from "./screen.js";

const ASKING = 2000; // ms between two questions
const UNANSWERED = 3; // questions until it is told
const FONTS = /@font-face\s*\{[^}]*\bMJX[^}]*\}/g; // of formulas
const KERNEL = {
  none: "There is no kernel: sliders and figures do not move.",
  dead: "The kernel has died: sliders and figures do not move. Restart it in the notebook; the slides go on.",
  starting: "The kernel is starting again …",
  empty: "The kernel was started anew and knows nothing of before: r runs all cells up to here.",
};

const path = decodeURIComponent(location.hash.slice(1));
const channel = channelOf(path);
const at = (id) => document.getElementById(id);
const present = new Screen(at("present"), "The slide now"), next = new Screen(at("next"), "What comes next");
const kept = JSON.parse(sessionStorage.getItem(path) ?? "{}"); // {began, slide}: outlives a reload
const heard = { knows: undefined, styled: undefined };
let deck, state, unanswered = 0;

const keep = (what) => sessionStorage.setItem(path, JSON.stringify(Object.assign(kept, what)));
const say = (words) => { if (at("told").textContent !== words) at("told").textContent = words; };
const tell = (what) => channel.postMessage({ to: deck, ...what });

function ask() {
  unanswered += 1;
  if (deck && unanswered > UNANSWERED) {
    say("The slides' window does not answer. Is it closed? This window goes on when they are back.");
    lose();
  }
  tell({ asks: true, ...heard });
}

// The deck is gone; any other of this notebook may take its place.
function lose() {
  deck = undefined;
  document.body.dataset.deck = "gone";
}

channel.onmessage = ({ data }) => {
  if (deck && data.from !== deck) return; // a second deck of the same notebook
  unanswered = 0;
  if (data.said === "ended") {
    say("The slides have ended. This window goes on when they are started again.");
    lose();
  } else if (!deck) begin(data);
  ({ state: showState, pictures: showPictures, styles: showStyles })[data.said]?.(data);
};

function begin({ from, slide, slides }) {
  deck = from;
  document.body.dataset.deck = "here";
  const left = kept.slide;
  const elsewhere = kept.deck !== from && left > 0 && left < slides?.length && left !== slide;
  at("resume").hidden = !elsewhere;
  if (elsewhere) {
    at("resume").textContent = `go on at slide ${left + 1}`;
    at("resume").onclick = () => { tell({ slide: left }); at("resume").hidden = true; };
  }
  Object.assign(heard, { knows: undefined, styled: undefined });
  tell({ asks: true, ...heard });
}

function showState(told) {
  if (JSON.stringify(told.slides) !== JSON.stringify(state?.slides)) list(told.slides);
  state = told;
  keep({ deck, slide: told.slide, began: kept.began ?? told.began });
  document.body.dataset.at = told.at;
  document.body.dataset.slide = told.slide;
  at("place").textContent = `${told.slide + 1} / ${told.slides.length}  ${told.slides[told.slide].title}`;
  document.title = `Presenter: ${at("place").textContent}`;
  at("slides").value = told.slide;
  say([told.blank && "The screen is blank: . shows the slide again.", KERNEL[told.kernel]].filter(Boolean).join(" "));
  at("class").textContent = told.ofClass;
  present.resize(told.size);
  next.resize(told.size);
  tick();
}

function list(slides) {
  at("slides").replaceChildren(...slides.map(({ title }, k) => new Option(`${k + 1} ${title}`, k)));
}

function showPictures(told) {
  heard.knows = told.serial;
  document.body.dataset.drawn = told.at;
  present.show(told.present);
  const coming = told.then === undefined ? "This is the end." : `${told.then} …`;
  next.show(told.next, told.next ? "" : coming);
  at("notes").innerHTML = told.notes.join("<hr>") || "<p>There are no notes on this slide.</p>";
  at("questions").replaceChildren(...told.questions.flatMap(question));
  if (!told.questions.length) at("questions").textContent = "No question in this section.";
}

function question({ slide, html, text }) {
  const where = element("p", "where", slide === state.slide ? "on this slide" : `on slide ${slide + 1}`);
  const asked = element("div");
  if (html) asked.innerHTML = html;
  else asked.textContent = text;
  return [where, asked];
}

function showStyles(told) {
  heard.styled = told.styled;
  present.style(told);
  next.style(told);
  const dark = told.body.some(([name, value]) => name === "data-jp-theme-light" && value === "false");
  document.documentElement.toggleAttribute("data-dark", dark);
  const formulas = told.sheets.find(({ id }) => id === "MJX-CHTML-styles"); // notes have formulas, too
  if (!formulas) return;
  const fonts = told.sheets.flatMap(({ text }) => text?.match(FONTS) ?? []); // in a sheet of their own
  const style = at("formulas") ?? document.head.appendChild(Object.assign(document.createElement("style"), { id: "formulas" }));
  style.textContent = [formulas.text, ...fonts].join("\n");
}

function tick() {
  const now = Date.now();
  at("clock").textContent = new Date(now).toLocaleTimeString([], { hour: "2-digit", minute: "2-digit" });
  if (!state) return;
  const elapsed = (now - kept.began) / 1000;
  at("elapsed").textContent = clockFace(elapsed);
  at("plan").textContent = planAt(state.slides, state.slide, elapsed / 60);
}

window.addEventListener("keydown", (event) => {
  const name = nameOf(event);
  if (!state?.keys.some(([key]) => key === name) || event.altKey) return;
  const here = event.target.closest("select, button, a, .text");
  if (here && (here.matches("select") ? name.length === 1 || /^(Arrow|Home|End|Enter)/.test(name)
    : here.matches(".text") ? / $|^(Arrow|Home|End)/.test(name) : /^(Enter| )$/.test(name))) return;
  event.preventDefault(); // F5 would reload
  tell({ key: name });
});
document.querySelectorAll("[data-key]").forEach((button) => {
  button.addEventListener("click", () => tell({ key: button.dataset.key }));
});
at("slides").addEventListener("change", () => tell({ slide: Number(at("slides").value) }));
// after a break, or for the second part on another day
at("again").addEventListener("click", () => {
  keep({ began: Date.now() - 60000 * (state ? plannedAt(state.slides, state.slide) : 0) });
  tick();
});
giveBackFocus(document);
setInterval(tick, 1000);
setInterval(ask, ASKING);
ask();
