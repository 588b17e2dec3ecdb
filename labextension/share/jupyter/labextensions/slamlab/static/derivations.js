// Derivations (classroom.derivation) shown line by line; without this plugin all lines are shown.

import { button, element } from "./element.js";
import { forEachElement } from "./observing.js";

export function playDerivations(panel) {
  forEachElement(panel, ".slamlab-derivation", (derivation) => {
    const steps = [...derivation.querySelectorAll(".slamlab-step")];
    if (!steps.length || derivation.previousElementSibling?.matches(".slamlab-playback")) return;
    derivation.before(playback(derivation, steps));
  });
}

function playback(derivation, steps) {
  let shown = steps.length;
  const status = element("span");
  status.setAttribute("role", "status");
  const buttons = [
    button("|◀", () => show(0), "first line only"),
    button("◀", () => show(shown - 1), "one line back"),
    button("▶", () => show(shown + 1), "next line"),
    button("▶|", () => show(steps.length), "all lines"),
  ];
  const bar = element("div", "slamlab-playback", ...buttons, status);
  bar.setAttribute("role", "group");
  bar.setAttribute("aria-label", derivation.getAttribute("aria-label") ?? "Derivation");

  function show(count) {
    shown = Math.min(Math.max(count, 0), steps.length);
    steps.forEach((step, k) => step.classList.toggle("slamlab-later", k >= shown));
    status.textContent = `line ${shown + 1} of ${steps.length + 1}`;
    buttons.forEach((one, k) => { // not disabled, so that a focused button keeps the focus
      one.setAttribute("aria-disabled", k < 2 ? shown === 0 : shown === steps.length);
    });
  }
  show(shown);
  return bar;
}
