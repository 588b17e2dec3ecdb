// Derivations (slamlab.derivation) are played line by line, back and forth; without this all lines show.

import { forEachElement } from "./watching.js";

export function playDerivations(panel) {
  forEachElement(panel, ".slamlab-derivation", (derivation) => {
    const steps = [...derivation.querySelectorAll(".slamlab-step")];
    if (!steps.length || derivation.previousElementSibling?.matches(".slamlab-playback")) return;
    derivation.before(playback(derivation, steps));
  });
}

function playback(derivation, steps) {
  let shown = steps.length;
  const bar = document.createElement("div");
  bar.className = "slamlab-playback";
  bar.setAttribute("role", "group");
  bar.setAttribute("aria-label", derivation.getAttribute("aria-label") ?? "Derivation");
  const told = document.createElement("span");
  told.setAttribute("role", "status");
  const buttons = [
    ["|◀", "first line only", () => 0],
    ["◀", "one line back", () => shown - 1],
    ["▶", "next line", () => shown + 1],
    ["▶|", "all lines", () => steps.length],
  ].map(([sign, name, target]) => {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = sign;
    button.title = name;
    button.setAttribute("aria-label", name);
    button.addEventListener("click", () => show(target()));
    return button;
  });
  bar.append(...buttons, told);

  function show(count) {
    shown = Math.min(Math.max(count, 0), steps.length);
    steps.forEach((step, k) => step.classList.toggle("slamlab-later", k >= shown));
    told.textContent = `line ${shown + 1} of ${steps.length + 1}`;
    buttons.forEach((button, k) => { // not disabled: a button in focus would lose it
      button.setAttribute("aria-disabled", k < 2 ? shown === 0 : shown === steps.length);
    });
  }
  show(shown);
  return bar;
}
