// Slides and stops of a notebook. A slide begins at a cell of type slide or subslide. A stop is the
// content that one key press reveals: the slide's first cells, a fragment, the cells after a question, a
// folded answer, a step of an output.

import { isSummaryOnly } from "./code.js";
import { questionIn } from "../questions.js";

const STEP = ".slamlab-step";
const PARTS = ["outputHidden", "inputHidden"]; // of a cell

const typeOf = (cell) => cell.model.getMetadata("slideshow")?.slide_type ?? "-";

// Folded code that was run and has no output, such as helpers of the next cell.
const isSilent = ({ model }) => model.type === "code" && model.getMetadata("jupyter")?.source_hidden
  && model.executionCount !== null && !model.outputs.length;

// notes are for the speaker; skipped and silent cells are run but not shown
export const isShown = (cell) => !["notes", "skip"].includes(typeOf(cell)) && !isSilent(cell);

const isHeading = ({ model }) => model.type === "markdown" && /^#+ .*$/.test(model.sharedModel.getSource().trim());

// HTML of a cell's outputs, even if they are not rendered.
export function htmlOf(cell) {
  const outputs = cell.model.outputs;
  const all = Array.from({ length: outputs?.length ?? 0 }, (_, k) => outputs.get(k).data["text/html"] ?? "");
  return all.flat().join("");
}

// Steps of a cell's outputs, such as lines of a derivation.
export const stepsOf = (cell) => htmlOf(cell).match(/class="[^"]*\bslamlab-step\b/g)?.length ?? 0;

const isFolded = (cell) => Boolean(cell.model.getMetadata("jupyter")?.outputs_hidden);

// Text that explains an answer: folded as a whole; on a slide it is a fragment.
const isAnswer = (cell) =>
  cell.model.type === "markdown" && Boolean(cell.model.getMetadata("slamlab")?.answers);

// The slides of a notebook: {cells, notes: indices, minutes, title}.
export function slidesOf(notebook) {
  const slides = [];
  let section = { title: "", minutes: 0 };
  let begins = true; // at the next shown cell
  notebook.widgets.forEach((cell, index) => {
    const type = typeOf(cell);
    const text = cell.model.sharedModel.getSource();
    // a slide of folded code alone is joined to the next one of its section
    const alone = slides.at(-1)?.cells.every((one) => isSummaryOnly(notebook.widgets[one]));
    begins ||= type === "slide" || (type === "subslide" && !alone);
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

// The stops of a slide: {slide, cell, step}; all cells up to `cell` are shown, and the first `step`
// hidden parts of this one. Pages begin at the cells in `breaks`. The summary line of folded code and a
// heading are shown together with the next cell, and the cells in `joined` with the previous one.
export function stopsOf(notebook, slide, number, breaks = [], joined = []) {
  const stops = [];
  let asked = true; // a slide's first cell begins a stop
  let waits = false; // for what follows
  slide.cells.forEach((index) => {
    const cell = notebook.widgets[index];
    const begins = breaks.includes(index) || (!waits && (asked || (typeOf(cell) === "fragment" && !joined.includes(index))));
    waits = isSummaryOnly(cell) || isHeading(cell);
    asked = cell.model.type === "code" && Boolean(questionIn(cell.model.sharedModel.getSource()));
    const folded = Number(isFolded(cell));
    const waiting = folded + stepsOf(cell);
    if (!begins && stops.at(-1).step === 0) stops.pop(); // shown together with the previous one
    for (let step = 0; step <= waiting; step++) stops.push({ slide: number, cell: index, step });
  });
  return stops;
}

// Show the content of a page (indices of cells) at a stop; later content is invisible but keeps its
// space. Only the last `lines` of a derivation that is too long for a page are shown.
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

// Unfold an answer, which is invisible until its stop.
export function unfold(cell) {
  if (isFolded(cell)) open(cell, "outputHidden");
  if (isAnswer(cell) && cell.inputHidden) open(cell, "inputHidden");
}

function open(cell, part) {
  cell[part] = false;
  cell.node.dataset[part] = "";
}

// Fold the answers again.
export function refold(notebook) {
  for (const cell of notebook.widgets) {
    for (const part of PARTS) {
      if (!(part in cell.node.dataset)) continue;
      delete cell.node.dataset[part];
      cell[part] = true;
    }
  }
}
