// Laser pointer: follows the pointer, and leaves a trace while pressed; both fade.

import { pathOf, svg } from "./strokes.js";

const STILL = 1500; // [ms] until a resting point fades
const TRACE = 30; // points of the trace

export class Laser {
  constructor(surface) {
    this.dot = svg("circle", { class: "slamlab-laserdot", r: 7, "data-still": "true" });
    this.trace = svg("path", { class: "slamlab-lasertrace", "data-still": "true" });
    surface.append(this.trace, this.dot);
    this.points = [];
  }

  move(x, y, pressed) {
    this.dot.setAttribute("cx", x);
    this.dot.setAttribute("cy", y);
    this.points = pressed ? [...this.points.slice(1 - TRACE), [x, y]] : [];
    if (pressed) this.trace.setAttribute("d", pathOf(this.points)); // the last trace stays and fades
    this.trace.dataset.still = !pressed;
    this.dot.dataset.still = false;
    clearTimeout(this.resting);
    this.resting = setTimeout(() => this.hide(), STILL);
  }

  hide() {
    clearTimeout(this.resting);
    this.points = [];
    this.dot.dataset.still = this.trace.dataset.still = true;
  }
}
