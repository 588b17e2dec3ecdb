// Status bar below the slide: buttons, notices, section, timer, slide number.

import { button, element } from "../element.js";
import { clockFace } from "./timing.js";

const NOTICE_TIME = 4000; // [ms] a notice is shown
const AWAY = 600000; // [ms] for which a lecture may be left
const BUSY_DELAY = 1000; // [ms] of computing before it is shown

export class Bar {
  constructor(deck) {
    this.deck = deck;
    this.node = element("div", "slamlab-bar");
    this.section = element("span", "slamlab-section");
    this.number = element("span", "slamlab-number");
    this.timer = element("span", "slamlab-timer");
    this.message = element("span", "slamlab-notice");
    this.message.setAttribute("role", "status");
    this.trouble = element("span", "slamlab-trouble"); // of the kernel or the server, until it is mended
    this.trouble.setAttribute("role", "alert");
    this.buttons = element("span", "slamlab-buttons");
    this.busy = element("span", "slamlab-busy", "computing …"); // shown while figures are not up to date
    this.busy.hidden = true;
    this.node.append(this.buttons, this.busy, this.trouble, this.message, this.section, this.timer, this.number);
    deck.layer.append(this.node);
    this.timer.hidden = true;
    this.kept = `slamlab-timer:${deck.panel.context.path}`; // after a short break the timer continues
    const { began, seen } = JSON.parse(sessionStorage.getItem(this.kept) ?? "{}");
    this.setTimer(Date.now() - seen < AWAY ? began : Date.now());
    const act = (key) => () => deck.keys.get(key).action();
    this.button("◀", "Back (PageUp)", act("PageUp"));
    this.button("▶", "Next (PageDown)", act("PageDown"));
    this.button("run", "Run this cell (Ctrl+Enter)", act("Ctrl+Enter"));
    this.button("code", "Fold or unfold the code (c)", act("c"));
    this.button("?", "Keys (?)", act("?"));
    const clock = setInterval(() => this.#tick(), 1000);
    deck.changed.connect(() => this.#show());
    deck.ended.connect(() => {
      clearInterval(clock);
      clearTimeout(this.waiting);
      this.node.remove();
    });
    const status = (_, now) => {
      clearTimeout(this.waiting);
      if (now === "busy") this.waiting = setTimeout(() => { this.busy.hidden = false; }, BUSY_DELAY);
      else this.busy.hidden = true;
    };
    deck.panel.sessionContext.statusChanged.connect(status);
    const showTrouble = () => { this.trouble.textContent = deck.health.text; };
    deck.health.changed.connect(showTrouble);
    showTrouble();
    deck.ended.connect(() => deck.panel.sessionContext.statusChanged.disconnect(status));
  }

  button(label, title, action) {
    const made = button(label, () => {
      action();
      made.blur(); // so that the deck gets the keys again
    }, title);
    this.buttons.append(made);
    return made;
  }

  notice(text, time = NOTICE_TIME) {
    clearTimeout(this.forgetting);
    this.message.textContent = text;
    if (text && time < Infinity) this.forgetting = setTimeout(() => { this.message.textContent = ""; }, time);
  }

  // Set the start of the lecture [ms].
  setTimer(began) {
    this.began = began;
    this.#tick();
  }

  toggle(part) {
    this[part].hidden = !this[part].hidden;
    this.#tick();
  }

  help() {
    const open = this.deck.layer.querySelector(".slamlab-help");
    if (open) return open.remove();
    const help = element("dl", "slamlab-help");
    help.dataset.slamlabCloses = "";
    const byWhat = Map.groupBy(this.deck.keys, ([, { does }]) => does);
    for (const [does, keys] of byWhat) {
      const names = keys.map(([key]) => key.replace(/ $/, "Space").replace("ArrowRight", "→").replace("ArrowLeft", "←"));
      help.append(element("dt", "", names.join(", ")), element("dd", "", does));
    }
    this.deck.layer.append(help);
  }

  #show() {
    const { deck } = this;
    const { title, heads } = deck.slides[deck.slide];
    this.section.textContent = heads && deck.stops[deck.at].cell === deck.slides[deck.slide].cells[0] ? "" : title;
    this.number.textContent = `${deck.slide + 1} / ${deck.slides.length}`;
  }

  #tick() {
    const seen = Date.now();
    this.timer.textContent = clockFace((seen - this.began) / 1000);
    sessionStorage.setItem(this.kept, JSON.stringify({ began: this.began, seen }));
  }
}
