// The deck's side of the presenter window: sends its content, and executes its commands.

import { element } from "../element.js";
import { questionIn } from "../questions.js";
import { channelOf } from "./channel.js";
import { slidesOfSection } from "./timing.js";
import { copied, notesOf, pictureOf, stylesOf, stylesSignature } from "./slide_snapshot.js";

const PAGE = new URL("presenter.html", import.meta.url).href;
const SIZE = "popup,width=1200,height=760";
const PAUSES = [100, 700]; // [ms] before pictures are sent: after the last key, and after rendering
const OWN = new Set(["p", "f"]); // keys with another function there

export function addPresenter(deck) { return new Presenting(deck); }

class Presenting {
  constructor(deck) {
    this.deck = deck;
    this.id = crypto.randomUUID(); // distinguishes decks of one notebook
    this.path = deck.panel.context.path;
    this.channel = channelOf(this.path);
    this.channel.onmessage = ({ data }) => this.#receive(data);
    deck.key("p", "presenter window", () => this.open());
    deck.button("presenter", "Open the presenter window: notes, next slide, time (p)", () => this.open());
    this.#follow();
    this.#send();
  }

  open() {
    const address = `${PAGE}#${encodeURIComponent(this.path)}`;
    if (this.window && !this.window.closed) return this.window.focus();
    this.window = window.open(address, "slamlab-presenter", SIZE);
    if (!this.window) this.#offer(address);
  }

  // Browsers may block a window opened by a key, but not by a click on a link.
  #offer(address) {
    this.deck.layer.querySelector(".slamlab-offer")?.remove();
    const link = element("a", "", "Open the presenter window");
    const offer = element("p", "slamlab-offer", "The browser blocked the window. ", link);
    offer.dataset.slamlabCloses = "";
    offer.setAttribute("role", "alert");
    Object.assign(link, { href: address, target: "slamlab-presenter" });
    link.addEventListener("click", () => offer.remove());
    this.deck.layer.append(offer);
    link.focus();
  }

  #follow() {
    const { deck } = this;
    const changed = () => this.#send();
    const ended = () => this.channel.postMessage({ from: this.id, type: "ended" });
    const blanked = new MutationObserver(changed);
    blanked.observe(deck.layer, { attributes: true, attributeFilter: ["class"] });
    deck.health.changed.connect(changed);
    window.addEventListener("pagehide", ended);
    deck.changed.connect(changed);
    deck.classChanged.connect(changed);
    deck.ended.connect(() => {
      this.#wait();
      blanked.disconnect();
      window.removeEventListener("pagehide", ended);
      ended();
      this.channel.close();
    });
  }

  #receive({ from, to, requests, knows, styled, key, slide, began }) {
    if (from || (to && to !== this.id)) return; // from another deck, or to it
    if (requests) {
      this.answers ??= this.#answers();
      this.presenter = { knows, styled };
      this.#send();
    }
    if (key) this.deck.keys.get(key)?.action();
    if (slide >= 0) this.deck.goToSlide(slide);
    if (began) this.deck.bar.setTimer(began);
    if (key || began) this.#send(); // some keys do not change the stop
  }

  #send() {
    const { deck } = this;
    this.channel.postMessage({
      from: this.id,
      type: "state",
      at: deck.at,
      stops: deck.stops.length,
      slide: deck.slide,
      slides: deck.slides.map(({ title, minutes }) => ({ title, minutes })),
      trouble: deck.health.text,
      blank: deck.layer.classList.contains("slamlab-blank"),
      classStatus: deck.classStatus,
      began: deck.bar.began,
      keys: [...deck.keys].filter(([key]) => !OWN.has(key)).map(([key, { does }]) => [key, does]),
      size: [window.innerWidth, window.innerHeight],
    });
    if (!this.presenter) return; // there is no presenter window
    this.#wait();
    this.drawing = PAUSES.map((pause) => setTimeout(() => this.#draw(), pause));
  }

  #wait() { this.drawing?.forEach(clearTimeout); }

  // Send pictures of this stop and the next, notes and questions, unless they are unchanged.
  #draw() {
    const { deck } = this;
    const styles = stylesSignature();
    if (this.presenter.styled !== styles) {
      this.channel.postMessage({ from: this.id, type: "styles", styled: styles, ...stylesOf() });
      this.presenter.styled = styles;
    }
    const drawn = {
      present: pictureOf(deck, deck.at)?.outerHTML ?? "",
      next: pictureOf(deck, deck.at + 1)?.outerHTML ?? "",
      then: deck.slides[deck.stops[deck.at + 1]?.slide]?.title,
      notes: this.#notes().map((note) => note.innerHTML),
      questions: this.#questions(),
    };
    const text = JSON.stringify(drawn);
    if (text !== this.drawn) {
      this.drawn = text;
      this.serial = crypto.randomUUID();
    }
    if (this.presenter.knows === this.serial) return;
    this.channel.postMessage({ from: this.id, type: "pictures", serial: this.serial, at: deck.at, ...drawn });
    this.presenter.knows = this.serial;
  }

  // Notes of this slide, or the last ones of its section before it.
  #notes() {
    const [first] = slidesOfSection(this.deck.slides, this.deck.slide);
    for (let slide = this.deck.slide; slide > first; slide--) {
      const notes = notesOf(this.deck, slide);
      if (notes.length) return notes;
    }
    return notesOf(this.deck, first);
  }

  // Questions of this section, first those to come: [{slide, html, text, answer}].
  #questions() {
    const { notebook, slides, slide } = this.deck;
    const [first, last] = slidesOfSection(slides, slide);
    const found = slides.slice(first, last + 1).flatMap(({ cells }, k) => cells
      .map((index) => notebook.widgets[index])
      .filter((cell) => idIn(cell))
      .map((cell) => ({ slide: first + k, answer: this.solutions?.[idIn(cell)] ?? "", ...asked(cell) })));
    return found.sort((one, two) => (one.slide < slide) - (two.slide < slide));
  }

  // Ask the kernel for the right answers and their reasons.
  async #answers() {
    const ids = JSON.stringify(this.deck.notebook.widgets.map(idIn).filter(Boolean));
    try {
      this.solutions = JSON.parse(await this.deck.run(`print(__import__("json").dumps(__import__("classroom.checks").checks.answers(${ids})))`));
      this.#send();
    } catch {
      this.answers = undefined; // asked for again
    }
  }
}

const idIn = ({ model }) => model.type === "code" && questionIn(model.sharedModel.getSource())?.id;

// A rendered question, or plain text before it was shown or run.
function asked({ node, model }) {
  const drawn = node.querySelector(".jp-OutputArea-output.jp-RenderedMarkdown");
  if (drawn) return { html: copied(drawn).innerHTML };
  const text = model.outputs.length ? model.outputs.get(0).data["text/plain"] : model.sharedModel.getSource();
  return { text: [text].flat().join("") };
}
