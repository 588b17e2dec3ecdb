// Presenter window: notes, next slide, time; its keys are the deck's. It requests all its content, so that
// either window can be opened first or reloaded.

import { element, giveBackFocus } from "../element.js";
import { channelOf } from "./channel.js";
import { nameOf } from "./input_guard.js";
import { clockFace, planAt, plannedAt } from "./timing.js";
import { Screen } from "./slide_preview.js";

const POLLING = 2000; // [ms] between two requests
const MAX_UNANSWERED = 3; // requests without an answer before a message
const FONTS = /@font-face\s*\{[^}]*\bMJX[^}]*\}/g; // fonts of formulas

const path = decodeURIComponent(location.hash.slice(1));
const channel = channelOf(path);
const at = (id) => document.getElementById(id);
const present = new Screen(at("present"), "The current slide"), next = new Screen(at("next"), "The next slide");
const kept = JSON.parse(sessionStorage.getItem(path) ?? "{}"); // {deck, slide}: kept after a reload
const received = { knows: undefined, styled: undefined };
let deck, state, unanswered = 0;

const keep = (what) => sessionStorage.setItem(path, JSON.stringify(Object.assign(kept, what)));
const notify = (text) => { if (at("message").textContent !== text) at("message").textContent = text; };
const send = (what) => channel.postMessage({ to: deck, ...what });

function request() {
  unanswered += 1;
  if (deck && unanswered > MAX_UNANSWERED) {
    notify("The slides do not respond. Their window may be closed. This window continues when they respond again.");
    lose();
  }
  send({ requests: true, ...received });
}

// The deck has ended; another deck of this notebook may replace it.
function lose() {
  deck = undefined;
  document.body.dataset.deck = "gone";
}

channel.onmessage = ({ data }) => {
  if (deck && data.from !== deck) return; // a second deck of the same notebook
  unanswered = 0;
  if (data.type === "ended") {
    notify("The slides have ended. This window continues when they are started again.");
    lose();
  } else if (!deck) begin(data);
  ({ state: showState, pictures: showPictures, styles: showStyles })[data.type]?.(data);
};

function begin({ from, slide, slides }) {
  deck = from;
  document.body.dataset.deck = "here";
  const left = kept.slide;
  const elsewhere = kept.deck !== from && left > 0 && left < slides?.length && left !== slide;
  at("resume").hidden = !elsewhere;
  if (elsewhere) {
    at("resume").textContent = `continue at slide ${left + 1}`;
    at("resume").onclick = () => { send({ slide: left }); at("resume").hidden = true; };
  }
  Object.assign(received, { knows: undefined, styled: undefined });
  send({ requests: true, ...received });
}

function showState(message) {
  if (JSON.stringify(message.slides) !== JSON.stringify(state?.slides)) list(message.slides);
  state = message;
  keep({ deck, slide: message.slide });
  document.body.dataset.at = message.at;
  document.body.dataset.slide = message.slide;
  at("place").textContent = `${message.slide + 1} / ${message.slides.length}  ${message.slides[message.slide].title}`;
  document.title = `Presenter: ${at("place").textContent}`;
  at("slides").value = message.slide;
  notify([message.blank && "The screen is black. Press . to show the slide.", message.trouble].filter(Boolean).join(" "));
  at("class").textContent = message.classStatus;
  present.resize(message.size);
  next.resize(message.size);
  tick();
}

function list(slides) {
  at("slides").replaceChildren(...slides.map(({ title }, k) => new Option(`${k + 1} ${title}`, k)));
}

function showPictures(message) {
  received.knows = message.serial;
  document.body.dataset.drawn = message.at;
  present.show(message.present);
  const coming = message.then === undefined ? "This is the last slide." : `${message.then} …`;
  next.show(message.next, message.next ? "" : coming);
  at("notes").innerHTML = message.notes.join("<hr>") || "<p>There are no notes on this section.</p>";
  at("questions").replaceChildren(...message.questions.flatMap(question));
  if (!message.questions.length) at("questions").textContent = "There is no question in this section.";
}

function question({ slide, html, text, answer }) {
  const where = element("p", "where", slide === state.slide ? "on this slide" : `on slide ${slide + 1}`);
  const asked = element("div");
  if (html) asked.innerHTML = html;
  else asked.textContent = text;
  return [where, element("p", "answer", answer), asked];
}

function showStyles(message) {
  received.styled = message.styled;
  present.style(message);
  next.style(message);
  const dark = message.body.some(([name, value]) => name === "data-jp-theme-light" && value === "false");
  document.documentElement.toggleAttribute("data-dark", dark);
  const formulas = message.sheets.find(({ id }) => id === "MJX-CHTML-styles"); // notes may contain formulas
  if (!formulas) return;
  const fonts = message.sheets.flatMap(({ text }) => text?.match(FONTS) ?? []); // in a separate style sheet
  const style = at("formulas") ?? document.head.appendChild(Object.assign(document.createElement("style"), { id: "formulas" }));
  style.textContent = [formulas.text, ...fonts].join("\n");
}

function tick() {
  const now = Date.now();
  at("clock").textContent = new Date(now).toLocaleTimeString([], { hour: "2-digit", minute: "2-digit" });
  if (!state) return;
  const elapsed = (now - state.began) / 1000;
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
  send({ key: name });
});
document.querySelectorAll("[data-key]").forEach((button) => {
  button.addEventListener("click", () => send({ key: button.dataset.key }));
});
at("slides").addEventListener("change", () => send({ slide: Number(at("slides").value) }));
// after a break, or for the second part of a lecture
at("again").addEventListener("click", () => {
  if (state) send({ began: Date.now() - 60000 * plannedAt(state.slides, state.slide) });
});
giveBackFocus(document);
setInterval(tick, 1000);
setInterval(request, POLLING);
request();
