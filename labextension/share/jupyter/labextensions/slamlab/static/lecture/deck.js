// The deck: a notebook shown slide by slide on the whole screen, its kernel and controls alive.

import { element, giveBackFocus } from "../element.js";
import { guard } from "./guard.js";
import { Bar } from "./bar.js";
import { keysOf } from "./keys.js";
import { cellsOn, layOut, pagesOf, zoomOf } from "./fit.js";
import { goToCell } from "./place.js";
import { foldCode, giveFoldingBack, lockCode, takeFolding } from "./code.js";
import { Signal } from "./signal.js";
import { refold, reveal, slidesOf, stopsOf, unfold } from "./stops.js";

const PANEL = "slamlab-deck";
const AHEAD = 3; // slides that are laid out before they are shown
const PAUSE = 150; // ms without a key before the next one of them

// JupyterLab draws cells when they come into sight; a slide needs all of its own.
function draw(notebook, indices) {
  for (const index of indices) {
    const cell = notebook.widgets[index];
    if (!cell.isAttached) {
      cell.node.dataset.windowedListIndex = `${index}`; // its place is looked for by it
      notebook.layout.insertWidget(index, cell);
    }
    cell.placeholder = false;
    if (cell.node.querySelector(".slamlab-telling")) continue;
    takeFolding(cell);
    foldCode(cell);
    lockCode(cell);
    unfold(cell);
  }
}

export class Deck {
  changed = new Signal(); // after each change of stop, size or content
  ended = new Signal();
  classChanged = new Signal(); // what the presenter's window says of the class
  ofClass = "";
  at = 0;
  size = 1;
  stops = [];
  layouts = new Map(); // slide to its pages, as long as nothing changes

  constructor(panel, app) {
    Object.assign(this, { panel, app, notebook: panel.content });
    this.page = this.notebook.node.querySelector(".jp-WindowedPanel-viewport");
    this.layer = element("div", "slamlab-layer");
    giveBackFocus(this.layer);
  }

  // Start at the slide of a cell, or at the first one.
  start(cell = 0) {
    const { panel, notebook, layer } = this;
    this.config = notebook.notebookConfig;
    notebook.notebookConfig = { ...this.config, windowingMode: "none" };
    notebook.mode = "command";
    notebook.widgets.forEach(({ node }) => node.classList.add("slamlab-off"));
    panel.node.classList.add(PANEL);
    panel.node.append(layer);
    panel.node.popover = "manual"; // the top layer: no ancestor confines it
    panel.node.showPopover();
    this.keys = keysOf(this);
    this.release = guard(this);
    this.bar = new Bar(this);
    this.slides = slidesOf(notebook);
    const slide = this.slides.findLastIndex(({ cells }) => cells[0] <= cell);
    this.gather();
    this.goToSlide(Math.max(0, slide));
    this.unscroll = () => this.#unscroll();
    notebook.node.addEventListener("scroll", this.unscroll, true);
    this.observer = new ResizeObserver(() => this.#later());
    this.observer.observe(document.documentElement);
    notebook.widgets.forEach((one) => this.observer.observe(one.node));
  }

  get slide() { return this.stops[this.at]?.slide ?? 0; }

  // The cell that the stop shown is about: its index.
  get cell() { return this.stops[this.at]?.cell ?? 0; }

  get zoom() { return zoomOf(this.size); }

  // How large the page that is shown is: its zoom, less what it was shrunk by to fit.
  get scale() { return this.zoom * this.shown.shrink; }

  // Find all stops anew; pages that were laid out begin stops of their own.
  gather() {
    this.stops = this.slides.flatMap((slide, number) => {
      const breaks = this.layouts.get(number)?.map(({ cells }) => cells[0]) ?? [];
      return stopsOf(this.notebook, slide, number, breaks);
    });
  }

  next() { if (this.at + 1 < this.stops.length) this.go(this.at + 1); }

  back() {
    if (!this.at) return;
    this.#pages(this.stops[this.at - 1].slide); // its last page may begin a stop not known yet
    this.go(this.at - 1);
  }

  go(k) {
    const { slide } = this.stops[Math.max(0, Math.min(k, this.stops.length - 1))];
    const nth = k - this.#first(slide);
    const pages = this.#pages(slide); // it may have more stops now
    this.at = Math.max(0, Math.min(this.#first(slide) + nth, this.stops.length - 1));
    this.shown = pages.findLast(({ cells }) => cells[0] <= this.cell) ?? pages[0];
    this.#reveal();
    layOut(this.page, this.notebook, this.shown, this.zoom);
    this.#unscroll();
    this.signature = this.#signature();
    Object.assign(this.layer.dataset, { stop: this.at, stops: this.stops.length, shrink: this.shown.shrink });
    this.aim = this.stops[this.at];
    this.changed.emit(this);
    this.#prepare();
  }

  goToSlide(number) { this.go(this.#first(number)); }

  // The same stop anew, after its content changed, or the size of all. A cell that runs has no steps for
  // a while: the stop that was gone to is aimed at until they are back.
  again(all = true) {
    if (!this.panel.node.classList.contains(PANEL)) return;
    const { aim } = this;
    if (all) this.layouts.clear();
    else this.layouts.delete(aim.slide);
    this.gather();
    this.at = this.#first(aim.slide);
    this.#pages(aim.slide);
    this.go(Math.max(this.#first(aim.slide), this.#reached(aim)));
    this.aim = aim;
  }

  key(key, does, action) { this.keys.set(key, { does, action }); }

  button(label, title, action) { return this.bar.button(label, title, action); }

  notice(text, stays) { this.bar.notice(text, stays); }

  // Run code silently in the notebook's kernel; what it printed.
  async run(code) {
    const kernel = this.panel.sessionContext.session?.kernel;
    if (!kernel) throw new Error("there is no kernel");
    const running = kernel.requestExecute({ code, store_history: false, stop_on_error: false });
    let printed = "";
    running.onIOPub = ({ header, content }) => {
      if (header.msg_type === "stream" && content.name === "stdout") printed += content.text;
    };
    const { content } = await running.done;
    if (content.status !== "ok") throw new Error(`${content.ename}: ${content.evalue}`);
    return printed;
  }

  end() {
    const { panel, notebook, page } = this;
    if (!panel.node.classList.contains(PANEL)) return;
    this.observer.disconnect();
    notebook.node.removeEventListener("scroll", this.unscroll, true);
    this.release();
    notebook.widgets.forEach(giveFoldingBack);
    refold(notebook);
    this.ended.emit(this); // the lesson is as it was, but for what was changed
    panel.node.hidePopover();
    panel.node.removeAttribute("popover");
    panel.node.classList.remove(PANEL);
    this.layer.remove();
    page.removeAttribute("style");
    page.classList.remove("slamlab-columns");
    for (const cell of notebook.widgets) {
      cell.node.classList.remove("slamlab-off", "slamlab-later", "slamlab-right");
      for (const one of cell.node.querySelectorAll(".slamlab-later, .slamlab-gone")) {
        one.classList.remove("slamlab-later", "slamlab-gone");
      }
      cell.node.querySelector(".slamlab-telling")?.remove();
      lockCode(cell, false);
    }
    notebook.notebookConfig = this.config;
    panel.update();
    notebook.activate();
    goToCell(notebook, this.cell);
  }

  // The pages of a slide; laid out for the first time they may bring stops that were not known.
  #pages(number) {
    if (!this.layouts.has(number)) {
      const { cells, notes } = this.slides[number];
      draw(this.notebook, [...cells, ...notes]);
      const show = (some, lines, step = Infinity) => {
        const stop = { cell: step < Infinity ? some[0] : Infinity, step };
        reveal(this.notebook, stop, some, lines);
      };
      const measure = () => pagesOf(this.page, this.notebook, cells, this.zoom, show);
      this.layouts.set(number, this.#measured(measure));
      const here = this.stops[this.at];
      this.gather();
      this.at = Math.max(0, this.#reached(here));
    }
    return this.layouts.get(number);
  }

  // What is measured is shown for a moment, and must not be seen.
  #measured(measure) {
    this.page.classList.add("slamlab-measured");
    try {
      return measure();
    } finally {
      this.page.classList.remove("slamlab-measured");
    }
  }

  #first(slide) { return this.stops.findIndex((stop) => stop.slide === slide); }

  // The last stop that shows no more than this one.
  #reached({ slide, cell, step }) {
    return this.stops.findLastIndex((stop) => stop.slide < slide
      || (stop.slide === slide && (stop.cell < cell || (stop.cell === cell && stop.step <= step))));
  }

  #reveal() {
    reveal(this.notebook, this.stops[this.at], this.shown.cells, this.shown.lines);
  }

  // JupyterLab scrolls to its active cell; a slide stands still.
  #unscroll() {
    for (let one = this.page; one !== this.panel.node; one = one.parentElement) {
      if (one.scrollTop || one.scrollLeft) one.scrollTo(0, 0);
    }
  }

  // Lay out the next slides, one by one, while nobody waits, and no control would lose its focus by it.
  #prepare() {
    clearTimeout(this.preparing);
    const ahead = this.slides.slice(0, this.slide + 1 + AHEAD);
    const next = ahead.findIndex((_, number) => number > this.slide && !this.layouts.has(number));
    if (next < 0) return;
    this.preparing = setTimeout(() => {
      if (!this.panel.node.classList.contains(PANEL) || this.page.contains(document.activeElement)) return;
      this.#pages(next);
      this.#reveal();
      layOut(this.page, this.notebook, this.shown, this.zoom);
      this.#prepare();
    }, PAUSE);
  }

  #later() {
    cancelAnimationFrame(this.frame);
    this.frame = requestAnimationFrame(() => {
      const signature = this.#signature();
      if (signature === this.signature) return;
      const screen = signature.split(",", 2).join();
      this.again(!this.signature.startsWith(`${screen},`));
    });
  }

  #signature() {
    const heights = cellsOn(this.page).map((one) => one.offsetHeight);
    return [window.innerWidth, window.innerHeight, ...heights].join();
  }
}
