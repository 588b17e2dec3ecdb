// The deck's end of the presenter's window: says what is shown, does what it is told.

import { element } from "../element.js";
import { questionIn } from "../questions.js";
import { channelOf } from "./channel.js";
import { slidesOfSection } from "./plan.js";
import { copied, notesOf, pictureOf, stylesOf, stylesSignature } from "./picture.js";

const PAGE = new URL("presenter.html", import.meta.url).href;
const SIZE = "popup,width=1200,height=760";
const PAUSES = [100, 700]; // ms that pictures wait: for the next key; for what is drawn and laid out meanwhile
const OWN = new Set(["p", "f"]); // keys that mean another thing there

export function addPresenter(deck) { return new Presenting(deck); }

class Presenting {
  constructor(deck) {
    this.deck = deck;
    this.id = crypto.randomUUID(); // two decks of one notebook must not be mixed up
    this.path = deck.panel.context.path;
    this.channel = channelOf(this.path);
    this.channel.onmessage = ({ data }) => this.#heard(data);
    deck.key("p", "presenter's window", () => this.open());
    deck.button("presenter", "The presenter's window: notes, next slide, time (p)", () => this.open());
    this.#follow();
    this.#tell();
  }

  open() {
    const address = `${PAGE}#${encodeURIComponent(this.path)}`;
    if (this.window && !this.window.closed) return this.window.focus();
    this.window = window.open(address, "slamlab-presenter", SIZE);
    if (!this.window) this.#offer(address);
  }

  // A key may open no window where a click on a link may.
  #offer(address) {
    this.deck.layer.querySelector(".slamlab-offer")?.remove();
    const link = element("a", "", "Open the presenter's window");
    const offer = element("p", "slamlab-offer", "The browser let no window open. ", link);
    offer.dataset.slamlabCloses = "";
    offer.setAttribute("role", "alert");
    Object.assign(link, { href: address, target: "slamlab-presenter" });
    link.addEventListener("click", () => offer.remove());
    this.deck.layer.append(offer);
    link.focus();
  }

  #follow() {
    const { deck } = this;
    const { sessionContext } = deck.panel;
    const told = () => this.#tell();
    const status = (_, now) => {
      if (["dead", "autorestarting", "restarting"].includes(now)) this.forgot = this.#counts();
      this.#tell();
    };
    const ended = () => this.channel.postMessage({ from: this.id, said: "ended" });
    const blanked = new MutationObserver(told);
    blanked.observe(deck.layer, { attributes: true, attributeFilter: ["class"] });
    sessionContext.statusChanged.connect(status);
    window.addEventListener("pagehide", ended);
    deck.changed.connect(told);
    deck.classChanged.connect(told);
    deck.ended.connect(() => {
      this.#wait();
      blanked.disconnect();
      sessionContext.statusChanged.disconnect(status);
      window.removeEventListener("pagehide", ended);
      ended();
      this.channel.close();
    });
  }

  #heard({ to, asks, knows, styled, key, slide }) {
    if (to && to !== this.id) return;
    if (asks) {
      this.heard = { knows, styled };
      this.#tell();
    }
    if (key) this.deck.keys.get(key)?.action();
    if (slide >= 0) this.deck.goToSlide(slide);
    if (key) this.#tell(); // some keys change no stop
  }

  #tell() {
    const { deck } = this;
    this.channel.postMessage({
      from: this.id,
      said: "state",
      at: deck.at,
      stops: deck.stops.length,
      slide: deck.slide,
      slides: deck.slides.map(({ title, minutes }) => ({ title, minutes })),
      kernel: this.#kernel(),
      blank: deck.layer.classList.contains("slamlab-blank"),
      ofClass: deck.ofClass,
      began: deck.bar.began,
      keys: [...deck.keys].filter(([key]) => !OWN.has(key)).map(([key, { does }]) => [key, does]),
      size: [window.innerWidth, window.innerHeight],
    });
    if (!this.heard) return; // nobody looks
    this.#wait();
    this.drawing = PAUSES.map((pause) => setTimeout(() => this.#draw(), pause));
  }

  #wait() { this.drawing?.forEach(clearTimeout); }

  // Pictures of this stop and the next, notes and questions, unless they are known there.
  #draw() {
    const { deck } = this;
    const styles = stylesSignature();
    if (this.heard.styled !== styles) {
      this.channel.postMessage({ from: this.id, said: "styles", styled: styles, ...stylesOf() });
      this.heard.styled = styles;
    }
    const drawn = {
      present: pictureOf(deck, deck.at)?.outerHTML ?? "",
      next: pictureOf(deck, deck.at + 1)?.outerHTML ?? "",
      then: deck.slides[deck.stops[deck.at + 1]?.slide]?.title,
      notes: notesOf(deck, deck.slide).map((note) => note.innerHTML),
      questions: this.#questions(),
    };
    const text = JSON.stringify(drawn);
    if (text !== this.drawn) {
      this.drawn = text;
      this.serial = crypto.randomUUID();
    }
    if (this.heard.knows === this.serial) return;
    this.channel.postMessage({ from: this.id, said: "pictures", serial: this.serial, at: deck.at, ...drawn });
    this.heard.knows = this.serial;
  }

  // The questions of this slide and of what is left of its section: [{slide, html, text}].
  #questions() {
    const { notebook, slides, slide } = this.deck;
    const [, last] = slidesOfSection(slides, slide);
    return slides.slice(slide, last + 1).flatMap(({ cells }, k) => cells
      .map((index) => notebook.widgets[index])
      .filter(({ model }) => model.type === "code" && questionIn(model.sharedModel.getSource()))
      .map((cell) => ({ slide: slide + k, ...asked(cell) })));
  }

  // "", or what is wrong with the kernel: none, dead, starting, empty (nothing was run since it died).
  #kernel() {
    const kernel = this.deck.panel.sessionContext.session?.kernel;
    if (!kernel) return "none";
    if (kernel.status === "dead") return "dead";
    if (["autorestarting", "restarting", "starting"].includes(kernel.status)) return "starting";
    if (this.forgot === this.#counts()) return "empty";
    this.forgot = undefined;
    return "";
  }

  #counts() {
    return this.deck.notebook.widgets.map(({ model }) => model.executionCount ?? "").join();
  }
}

// A question as it is drawn; as plain text before its slide was shown, or it was run.
function asked({ node, model }) {
  const drawn = node.querySelector(".jp-OutputArea-output.jp-RenderedMarkdown");
  if (drawn) return { html: copied(drawn).innerHTML };
  const text = model.outputs.length ? model.outputs.get(0).data["text/plain"] : model.sharedModel.getSource();
  return { text: [text].flat().join("") };
}
