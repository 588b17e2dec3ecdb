// The bar below the slide: buttons for who has no keys, the slide's number, the time.

import { button, element } from "../element.js";
import { clockFace } from "./plan.js";

const TELL = 4000; // ms a notice stays
const AWAY = 600000; // ms for which a lecture may be left
const AT_ONCE = 1000; // ms of computing that need no word

export class Bar {
  constructor(deck) {
    this.deck = deck;
    this.node = element("div", "slamlab-bar");
    this.section = element("span", "slamlab-section");
    this.number = element("span", "slamlab-number");
    this.timer = element("span", "slamlab-timer");
    this.told = element("span", "slamlab-notice");
    this.told.setAttribute("role", "status");
    this.buttons = element("span", "slamlab-buttons");
    this.busy = element("span", "slamlab-busy", "computing …"); // a figure that does not follow its slider yet
    this.busy.hidden = true;
    this.node.append(this.buttons, this.busy, this.told, this.section, this.timer, this.number);
    deck.layer.append(this.node);
    this.timer.hidden = true;
    const { began, left } = deck.panel.slamlabTime ?? {}; // who leaves the slides for a moment has the same lecture
    this.began = Date.now() - left < AWAY ? began : Date.now();
    const act = (key) => () => deck.keys.get(key).action();
    this.button("◀", "Back (PageUp)", act("PageUp"));
    this.button("▶", "Next (PageDown)", act("PageDown"));
    this.button("run", "Run this cell (Ctrl+Enter)", act("Ctrl+Enter"));
    this.button("code", "Fold or unfold the code (c)", act("c"));
    this.button("?", "Keys", act("?"));
    const clock = setInterval(() => this.#tick(), 1000);
    deck.changed.connect(() => this.#show());
    deck.ended.connect(() => {
      clearInterval(clock);
      clearTimeout(this.waiting);
      deck.panel.slamlabTime = { began: this.began, left: Date.now() };
      this.node.remove();
    });
    const status = (_, now) => {
      clearTimeout(this.waiting);
      if (now === "busy") this.waiting = setTimeout(() => { this.busy.hidden = false; }, AT_ONCE);
      else this.busy.hidden = true;
      if (now === "dead" || now === "autorestarting") {
        this.notice("The kernel has died. r runs all cells up to here once it is back.", Infinity);
      }
    };
    deck.panel.sessionContext.statusChanged.connect(status);
    deck.ended.connect(() => deck.panel.sessionContext.statusChanged.disconnect(status));
  }

  button(label, title, action) {
    const made = button(label, () => {
      action();
      made.blur(); // or the deck would not have its keys back
    }, title);
    this.buttons.append(made);
    return made;
  }

  notice(text, stays = TELL) {
    clearTimeout(this.forgetting);
    this.told.textContent = text;
    if (text && stays < Infinity) this.forgetting = setTimeout(() => { this.told.textContent = ""; }, stays);
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
      const names = keys.map(([key]) => key.replace(/ $/, "Space").replace("Arrow", ""));
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
    this.timer.textContent = clockFace((Date.now() - this.began) / 1000);
  }
}
