// Toolbar of ink tools and colours.

import { button, element } from "../element.js";

export const TOOLS = [
  { tool: "pen", label: "pen", width: 3 },
  { tool: "marker", label: "marker", width: 22 },
  { tool: "laser", label: "laser", width: 4 },
  { tool: "eraser", label: "eraser", width: 0 },
];

// course colours with a contrast of at least 3 on white; black is the theme's text colour
export const COLOURS = { blue: "#0072b2", red: "#d55e00", green: "#009e73", pink: "#cc79a7", black: "currentcolor" };

export class InkBar {
  constructor(ink) {
    this.ink = ink;
    this.node = element("div", "slamlab-inkbar");
    this.node.setAttribute("role", "toolbar");
    this.node.setAttribute("aria-label", "Ink");
    this.node.dataset.slamlabCloses = ""; // by Escape
    this.node.addEventListener("slamlab-closed", () => ink.use(undefined));
    this.tools = TOOLS.map(({ tool, label }) => this.#button(label, `Draw with the ${label} (i: next tool)`, () => ink.use(tool)));
    this.colours = Object.entries(COLOURS).map(([name, colour]) => {
      const button = this.#button("", `Draw in ${name}`, () => ink.colour(name));
      button.classList.add("slamlab-inkcolour");
      button.style.setProperty("--slamlab-colour", colour);
      return button;
    });
    this.#button("undo", "Undo the last stroke (Ctrl+Z)", () => ink.undo());
    this.#button("clear", "Clear this slide (Ctrl+Z to undo)", () => ink.clear());
    this.#button("✕", "Stop drawing (Esc)", () => ink.use(undefined));
  }

  #button(label, title, action) {
    const made = button(label, action, title);
    this.node.append(made);
    return made;
  }

  // Show which tool and colour are in use.
  show(tool, colour) {
    this.tools.forEach((button, k) => button.setAttribute("aria-pressed", TOOLS[k].tool === tool));
    this.colours.forEach((button, k) => button.setAttribute("aria-pressed", Object.keys(COLOURS)[k] === colour));
  }
}
