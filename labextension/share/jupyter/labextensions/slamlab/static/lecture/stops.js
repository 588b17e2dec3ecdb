// Slides and stops of a notebook. A slide begins at a cell of type slide or subslide; a stop is what
// one key press reveals: the slide's first cells, a fragment, what follows a question, a folded answer, a
// step of an output.

import { saysLittle } from "./code.js";
import { questionIn } from "../questions.js";

const STEP = ".slamlab-step";
const PARTS = ["outputHidden", "inputHidden"]; // of a cell

const typeOf = (cell) => cell.model.getMetadata("slideshow")?.slide_type ?? "-";

// Folded code that was run and gave no output: helpers of the next cell, nothing to see.
const isSilent = ({ model }) => model.type === "code" && model.getMetadata("jupyter")?.source_hidden
  && model.executionCount !== null && !model.outputs.length;

// notes are for the speaker, skipped and silent cells only for the kernel
export const isShown = (cell) => !["notes", "skip"].includes(typeOf(cell)) && !isSilent(cell);

// HTML of a cell's outputs, whether they are drawn or not.
export function htmlOf(cell) {
  const outputs = cell.model.outputs;
  const all = Array.from({ length: outputs?.length ?? 0 }, (_, k) => outputs.get(k).data["text/html"] ?? "");
  return all.flat().join("");
}

// Steps of a cell's outputs, such as lines of a derivation.
export const stepsOf = (cell) => htmlOf(cell).match(/class="[^"]*\bslamlab-step\b/g)?.length ?? 0;

const isFolded = (cell) => Boolean(cell.model.getMetadata("jupyter")?.outputs_hidden);

// Text that explains an answer: it is folded whole, and on a slide it is a fragment like any other.
const isAnswer = (cell) =>
  cell.model.type === "markdown" && Boolean(cell.model.getMetadata("slamlab")?.answers);

// The slides of a notebook: {cells, notes: indices, minutes, title}.
export function slidesOf(notebook) {
  const slides = [];
  let section = { title: "", minutes: 0 };
  let begins = true; // with the next cell that is shown
  notebook.widgets.forEach((cell, index) => {
    const type = typeOf(cell);
    const text = cell.model.sharedModel.getSource();
    begins ||= ["slide", "subslide"].includes(type);
    if (isShown(cell) && begins) {
      const heading = cell.model.type === "markdown" && /^#+ +(.+)$/m.exec(text)?.[1];
      const minutes = cell.model.getMetadata("slamlab")?.minutes;
      section = { title: heading || section.title, minutes };
      slides.push({ cells: [], notes: [], heads: Boolean(heading), ...section });
      begins = false;
    }
    if (!slides.length) return;
    const slide = slides.at(-1);
    if (type === "notes") slide.notes.push(index);
    if (isShown(cell)) slide.cells.push(index);
  });
  return slides;
}

// The stops of a slide: {slide, cell, step}; all cells up to `cell` are shown, and of this one the
// first `step` of what waits in it. Pages begin at the cells named in `breaks`. A line that stands for
// folded code comes with what follows on its page.
export function stopsOf(notebook, slide, number, breaks = []) {
  const stops = [];
  let asked = true; // a slide's first cell begins a stop, too
  let waits = false; // for what follows
  slide.cells.forEach((index) => {
    const cell = notebook.widgets[index];
    const begins = breaks.includes(index) || (!waits && (asked || typeOf(cell) === "fragment"));
    waits = saysLittle(cell);
    asked = cell.model.type === "code" && Boolean(questionIn(cell.model.sharedModel.getSource()));
    const folded = Number(isFolded(cell));
    const waiting = folded + stepsOf(cell);
    if (!begins && stops.at(-1).step === 0) stops.pop(); // it comes together with the one before
    for (let step = 0; step <= waiting; step++) stops.push({ slide: number, cell: index, step });
  });
  return stops;
}

// Show of a page (indices of cells) what belongs to a stop: what comes later keeps its room unseen.
// Of a derivation too long for a page only the last `lines` are shown.
export function reveal(notebook, stop, page, lines = Infinity) {
  notebook.widgets.forEach((cell, index) => {
    const here = page.includes(index);
    cell.node.classList.toggle("slamlab-off", !here);
    cell.node.classList.toggle("slamlab-later", here && index > stop.cell);
    if (!here) return;
    const reached = index < stop.cell ? Infinity : index === stop.cell ? stop.step : -1;
    const folded = Number(isFolded(cell));
    if (folded) cell.outputArea.node.classList.toggle("slamlab-later", reached < 1);
    const steps = cell.node.querySelectorAll(STEP);
    const last = Math.min(reached - folded, steps.length); // the steps that are shown
    steps.forEach((step, k) => {
      step.classList.toggle("slamlab-later", k >= last);
      step.classList.toggle("slamlab-gone", lines < Infinity && (k >= last || k < last - lines));
    });
  });
}

// A folded answer waits with its room kept, like all that comes later.
export function unfold(cell) {
  if (isFolded(cell)) open(cell, "outputHidden");
  if (isAnswer(cell) && cell.inputHidden) open(cell, "inputHidden");
}

function open(cell, part) {
  cell[part] = false;
  cell.node.dataset[part] = "";
}

// Fold again what was unfolded: a lesson that was only shown is as it was.
export function refold(notebook) {
  for (const cell of notebook.widgets) {
    for (const part of PARTS) {
      if (!(part in cell.node.dataset)) continue;
      delete cell.node.dataset[part];
      cell[part] = true;
    }
  }
}
