// The deck: a notebook shown as slides on the whole screen, with its live kernel and controls.

import { element, giveBackFocus } from "../element.js";
import { guard } from "./input_guard.js";
import { Health } from "./health.js";
import { Bar } from "./status_bar.js";
import { keysOf } from "./keys.js";
import { cellsOn, fits, layOut, pagesOf, textBeside, zoomOf } from "./fit.js";
import { goToCell } from "./active_cell.js";
import { foldCode, giveFoldingBack, lockCode, takeFolding } from "./code.js";
import { Signal } from "./signal.js";
import { refold, reveal, slidesOf, stopsOf, unfold } from "./slides.js";

const PANEL = "slamlab-deck";
const AHEAD = 3; // slides that are laid out in advance
const PAUSE = 150; // [ms] without a key before each of them

// JupyterLab renders cells when they become visible; a slide needs all its cells.
function draw(notebook, indices) {
  for (const index of indices) {
    const cell = notebook.widgets[index];
    if (!cell.isAttached) {
      cell.node.dataset.windowedListIndex = `${index}`; // JupyterLab finds its position by it
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
  classChanged = new Signal(); // the status of the class in the presenter window
  classStatus = "";
  at = 0;
  size = 1;
  stops = [];
  layouts = new Map(); // slide to its pages; a cache

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
    panel.node.popover = "manual"; // in the top layer, outside any ancestor
    panel.node.showPopover();
    this.keys = keysOf(this);
    this.release = guard(this);
    this.health = new Health(this);
    this.bar = new Bar(this);
    this.slides = slidesOf(notebook);
    this.waits = () => notebook.widgets.some(({ model }) => model.type === "code" && model.executionCount === null);
    this.early = this.waits();
    const slide = this.slides.findLastIndex(({ cells }) => cells[0] <= cell);
    this.gather();
    this.goToSlide(Math.max(0, slide));
    this.ran = (_, status) => { if (status === "idle" && this.early && !this.waits()) this.#slidesAgain(); };
    panel.sessionContext.statusChanged.connect(this.ran);
    this.unscroll = () => this.#unscroll();
    notebook.node.addEventListener("scroll", this.unscroll, true);
    this.observer = new ResizeObserver(() => this.#later());
    this.observer.observe(document.documentElement);
    notebook.widgets.forEach((one) => this.observer.observe(one.node));
  }

  get slide() { return this.stops[this.at]?.slide ?? 0; }

  // Index of the cell of the current stop.
  get cell() { return this.stops[this.at]?.cell ?? 0; }

  get zoom() { return zoomOf(this.size); }

  // Scale of the current page: zoom times the shrink factor.
  get scale() { return this.zoom * this.shown.shrink; }

  // Find all stops again; each page of a slide begins a stop.
  gather() {
    this.stops = this.slides.flatMap((slide, number) => {
      const pages = this.layouts.get(number) ?? [];
      const joined = pages.flatMap((page) => textBeside(this.notebook, page));
      return stopsOf(this.notebook, slide, number, pages.map(({ cells }) => cells[0]), joined);
    });
  }

  next() { if (this.at + 1 < this.stops.length) this.go(this.at + 1); }

  back() {
    if (!this.at) return;
    this.#pages(this.stops[this.at - 1].slide); // its last page may begin a new stop
    this.go(this.at - 1);
  }

  go(k) {
    const { slide } = this.stops[Math.max(0, Math.min(k, this.stops.length - 1))];
    const nth = k - this.#first(slide);
    const pages = this.#pages(slide); // the number of stops may have changed
    this.at = Math.max(0, Math.min(this.#first(slide) + nth, this.stops.length - 1));
    this.shown = pages.findLast(({ cells }) => cells[0] <= this.cell) ?? pages[0];
    this.#reveal();
    layOut(this.page, this.notebook, this.shown, this.zoom);
    this.#unscroll();
    this.signature = this.#signature();
    Object.assign(this.layer.dataset, { stop: this.at, stops: this.stops.length, shrink: this.shown.shrink });
    this.target = this.stops[this.at];
    // formulas may have been typeset since the slide was laid out in advance
    if (!this.refreshing && !fits(this.page)) return this.refresh(false);
    this.changed.emit(this);
    this.#prepare();
  }

  goToSlide(number) { this.go(this.#first(number)); }

  // Show the same stop again, after its content or the size changed. A running cell has no steps for a
  // while: the deck returns to the target stop when they are back.
  refresh(all = true) {
    if (!this.panel.node.classList.contains(PANEL)) return;
    const { target } = this;
    if (all) this.layouts.clear();
    else this.layouts.delete(target.slide);
    this.gather();
    this.at = this.#first(target.slide);
    this.#pages(target.slide);
    this.refreshing = true;
    this.go(Math.max(this.#first(target.slide), this.#reached(target)));
    this.refreshing = false;
    this.target = target;
  }

  // If the lecture began while cells waited to run, some had no output yet, and a slide for it.
  #slidesAgain() {
    const { cell, step } = this.target;
    this.early = false;
    this.slides = slidesOf(this.notebook);
    const slide = Math.max(0, this.slides.findLastIndex(({ cells }) => cells[0] <= cell));
    this.target = { slide, cell, step };
    this.refresh();
  }

  // Number of the slide of a cell, or of the last one before it.
  slideOf(cell) {
    const index = this.notebook.widgets.indexOf(cell);
    return Math.max(0, this.slides.findLastIndex(({ cells }) => cells[0] <= index));
  }

  key(key, does, action) { this.keys.set(key, { does, action }); }

  button(label, title, action) { return this.bar.button(label, title, action); }

  notice(text, time) { this.bar.notice(text, time); }

  // Run code silently in the notebook's kernel; return its printed output.
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
    this.release(); // first of all: whatever fails, the keys are the notebook's again
    this.observer.disconnect();
    panel.sessionContext.statusChanged.disconnect(this.ran);
    notebook.node.removeEventListener("scroll", this.unscroll, true);
    if (panel.node.isConnected) panel.node.hidePopover();
    panel.node.removeAttribute("popover");
    panel.node.classList.remove(PANEL);
    this.layer.remove();
    notebook.widgets.forEach(giveFoldingBack);
    refold(notebook);
    this.ended.emit(this); // the notebook is restored, except for changes
    if (panel.isDisposed) return;
    page.removeAttribute("style");
    page.classList.remove("slamlab-columns");
    for (const cell of notebook.widgets) {
      cell.node.classList.remove("slamlab-off", "slamlab-later", "slamlab-right", "slamlab-picture");
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

  // The pages of a slide; the first layout may add stops.
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

  // Measure the layout invisibly.
  #measured(measure) {
    this.page.classList.add("slamlab-measured");
    try {
      return measure();
    } finally {
      this.page.classList.remove("slamlab-measured");
    }
  }

  #first(slide) { return this.stops.findIndex((stop) => stop.slide === slide); }

  // The last stop that shows at most the content of this one.
  #reached({ slide, cell, step }) {
    return this.stops.findLastIndex((stop) => stop.slide < slide
      || (stop.slide === slide && (stop.cell < cell || (stop.cell === cell && stop.step <= step))));
  }

  #reveal() {
    reveal(this.notebook, this.stops[this.at], this.shown.cells, this.shown.lines);
  }

  // Undo JupyterLab's scrolling to its active cell.
  #unscroll() {
    for (let one = this.page; one !== this.panel.node; one = one.parentElement) {
      if (one.scrollTop || one.scrollLeft) one.scrollTo(0, 0);
    }
  }

  // Lay out the next slides, one by one, while idle and without a focused control.
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
      this.refresh(!this.signature.startsWith(`${screen},`));
    });
  }

  #signature() {
    const heights = cellsOn(this.page).map((one) => one.offsetHeight);
    return [window.innerWidth, window.innerHeight, ...heights].join();
  }
}
