// Ink on slides: pen, marker, laser pointer, eraser. Strokes are anchored to the content below them, and
// stored in a separate file. Without a tool in use, the content gets pointer events.

import { anchorAt, placeOf } from "./anchors.js";
import { InkBar, TOOLS } from "./ink_bar.js";
import { InkFile } from "./ink_file.js";
import { Laser } from "./laser.js";
import { drawn, passes, pathOf, strokeOf, svg } from "./strokes.js";

const REACH = 8; // pixels around the eraser
const STEPS = 200; // undo steps

export function addInk(deck) { return new Ink(deck); }

class Ink {
  constructor(deck) {
    Object.assign(this, { deck, strokes: [], past: [], tool: undefined, inUse: "blue" });
    this.surface = svg("svg", { class: "slamlab-ink", "aria-hidden": "true" });
    deck.layer.prepend(this.surface); // below the bar and dialogs
    this.bar = new InkBar(this);
    this.laser = new Laser(this.surface);
    this.file = new InkFile(deck.app.serviceManager.contents, deck.panel.context.path, (text) => deck.notice(text));
    this.#listen();
    this.loaded = this.#load();
    deck.key("i", "ink: pen, marker, laser, eraser, off", () => this.cycle());
    deck.key("Ctrl+z", "undo the last stroke", () => this.undo());
    deck.button("ink", "Draw on the slides (i)", () => this.cycle());
    deck.changed.connect(() => this.#place());
  }

  // Load the ink; whether the file was read, if there is one.
  async #load() {
    let kept;
    try {
      kept = await this.file.read();
      this.strokes = [...kept ?? [], ...this.strokes];
    } catch (error) {
      this.deck.notice(`The ink file could not be read (${error.message}). New ink is not saved.`);
      this.file = undefined; // keep the file's content
    }
    this.#show();
    return Boolean(kept);
  }

  cycle() {
    const tools = [...TOOLS.map(({ tool }) => tool), undefined];
    this.use(this.bar.node.isConnected ? tools[tools.indexOf(this.tool) + 1] : "pen");
  }

  // Select a tool, or none: then the bar closes and controls get pointer events again.
  use(tool) {
    this.tool = tool;
    if (tool && !this.bar.node.isConnected) this.deck.bar.node.prepend(this.bar.node);
    if (!tool) this.bar.node.remove();
    if (tool !== "laser") this.laser.hide();
    this.surface.dataset.tool = tool ?? "";
    this.bar.show(tool, this.inUse);
  }

  colour(name) {
    this.inUse = name;
    this.use(["pen", "marker"].includes(this.tool) ? this.tool : "pen");
  }

  undo() {
    const before = this.past.at(-1);
    const touched = before && [...before, ...this.strokes].filter((one) => before.includes(one) !== this.strokes.includes(one));
    if (!touched?.some(({ anchor }) => this.#isHere(anchor))) return this.deck.notice("There is nothing to undo on this slide.");
    this.past.pop();
    this.#keep(before);
  }

  clear() { this.#change(this.strokes.filter(({ anchor }) => !this.#isHere(anchor))); }

  // Whether an anchor is on the current page, even at a later stop.
  #isHere({ cell }) {
    return this.deck.shown.cells.some((index) => this.deck.notebook.widgets[index].model.id === cell);
  }

  // ---- pointer ------------------------------------------------------------------------------------

  #listen() {
    const { surface, deck } = this;
    surface.addEventListener("pointerdown", (event) => this.#down(event));
    surface.addEventListener("pointermove", (event) => this.#move(event));
    surface.addEventListener("pointerup", (event) => this.#up(event));
    surface.addEventListener("pointercancel", () => this.#drop()); // a palm, or a system gesture
    surface.addEventListener("pointerleave", () => this.laser.hide());
    const leaves = () => this.file?.flush();
    window.addEventListener("pagehide", leaves);
    deck.ended.connect(() => {
      window.removeEventListener("pagehide", leaves);
      this.use(undefined);
      surface.remove();
      leaves();
    });
  }

  #down(event) {
    event.preventDefault(); // keep the focus
    if (event.pointerType === "pen") this.hasPen = true;
    const palm = this.hasPen && event.pointerType === "touch";
    if (palm || !event.isPrimary || event.button > 0 && !(event.buttons & 32)) return;
    const tool = event.buttons & 32 ? "eraser" : this.tool; // the eraser end of a pen
    this.drawing = { pointer: event.pointerId, tool, points: [] };
    this.surface.setPointerCapture(event.pointerId);
    if (["pen", "marker"].includes(tool)) {
      const look = { tool, colour: this.inUse, width: TOOLS.find((one) => one.tool === tool).width * this.deck.zoom };
      this.drawing.look = look;
      this.drawing.group = drawn({ ...look, id: "", points: [[event.clientX, event.clientY, 0.5]] });
      this.surface.append(this.drawing.group);
    }
    this.#move(event);
  }

  #move(event) {
    if (this.tool === "laser") this.laser.move(event.clientX, event.clientY, Boolean(this.drawing));
    if (this.drawing?.pointer !== event.pointerId) return;
    const { tool, points, group } = this.drawing;
    const coalesced = event.getCoalescedEvents?.() ?? [];
    for (const one of coalesced.length ? coalesced : [event]) {
      const at = [one.clientX, one.clientY, one.pointerType === "pen" ? one.pressure : 0.5];
      if (at[0] !== points.at(-1)?.[0] || at[1] !== points.at(-1)?.[1]) points.push(at);
      if (tool === "eraser") this.#erase(at);
    }
    group?.querySelector("path").setAttribute("d", pathOf(points));
  }

  #up(event) {
    if (this.drawing?.pointer !== event.pointerId) return;
    const { look, points } = this.drawing;
    this.#drop();
    if (!look) return;
    const middle = [0, 1].map((k) => (Math.min(...points.map((at) => at[k])) + Math.max(...points.map((at) => at[k]))) / 2);
    const anchor = anchorAt(this.deck, middle);
    const place = anchor && placeOf(this.deck, anchor);
    if (!place) return this.deck.notice("You cannot draw here.");
    this.#change([...this.strokes, strokeOf(look, anchor, place, points)]);
  }

  #drop() {
    this.drawing?.group?.remove();
    this.drawing = undefined;
  }

  #erase(at) {
    const hit = this.strokes.filter((stroke) => {
      const place = placeOf(this.deck, stroke.anchor);
      return place && passes(stroke, place, at, REACH);
    });
    if (hit.length) this.#change(this.strokes.filter((stroke) => !hit.includes(stroke)));
  }

  // ---- strokes ------------------------------------------------------------------------------------

  #change(strokes) {
    if (strokes.length === this.strokes.length) return;
    this.past = [...this.past.slice(1 - STEPS), this.strokes];
    this.#keep(strokes);
  }

  #keep(strokes) {
    this.strokes = strokes;
    this.#show();
    this.loaded.then(() => this.file?.keep(this.strokes));
  }

  #show() {
    this.surface.querySelectorAll(".slamlab-stroke").forEach((one) => one.remove());
    this.groups = new Map(this.strokes.map((stroke) => [stroke, drawn(stroke)]));
    this.surface.prepend(...this.groups.values());
    this.#place();
  }

  // Move every stroke to the position of its anchor.
  #place() {
    for (const [{ anchor }, group] of this.groups ?? []) {
      const place = placeOf(this.deck, anchor);
      group.classList.toggle("slamlab-unseen", !place);
      group.classList.toggle("slamlab-onpicture", anchor.kind === "picture");
      if (place) group.setAttribute("transform", `translate(${place.x} ${place.y}) scale(${place.scale})`);
    }
  }
}
