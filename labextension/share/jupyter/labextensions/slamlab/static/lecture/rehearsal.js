// Rehearsal, called by `slamlab rehearse`: run the lesson, and step through its stops.

import { fits, PRINTED, printedWidth } from "./fit.js";
import { FRAMES, settled } from "./rendering.js";
import { slidesOf } from "./slides.js";

const LATE = 100; // frames after which a slide that does not fit is reported

const within = (ms, promise) => Promise.race([promise, new Promise((resolve) => { setTimeout(resolve, ms, "late"); })]);

// Run all cells, with a timeout [ms]; returns whether it expired, and for each cell
// {id, type, code, seconds, error, slide (the last one that begins at or before it, from 1), title}.
export async function run(panel, patience) {
  const app = window.jupyterapp, notebook = panel.content;
  const runAll = async () => {
    await panel.sessionContext.ready;
    notebook.notebookConfig = { ...notebook.notebookConfig, recordTiming: true };
    await app.commands.execute("notebook:run-all-cells");
  };
  const ended = await within(patience, runAll());
  const slides = slidesOf(notebook);
  const places = notebook.widgets.map((_, index) => placeOf(slides, index));
  return { late: ended === "late", cells: [...notebook.model.cells].map((cell, k) => ({ ...report(cell), ...places[k] })) };
}

function placeOf(slides, index) {
  const slide = Math.max(0, slides.findLastIndex(({ cells }) => cells[0] <= index));
  return { slide: slide + 1, title: slides[slide]?.title ?? "" };
}

function report(cell) {
  const { id, type } = cell;
  const code = type === "code" ? cell.sharedModel.getSource() : "";
  return { id, type, code, seconds: secondsOf(cell), error: code ? errorOf(cell) : "" };
}

function secondsOf(cell) {
  const times = cell.getMetadata("execution") ?? {};
  const began = times["iopub.execute_input"] ?? times["iopub.status.busy"];
  return began ? (Date.parse(times["shell.execute_reply"]) - Date.parse(began)) / 1000 || 0 : 0;
}

function errorOf(cell) {
  if (cell.getMetadata("tags")?.includes("raises-exception")) return "";
  const error = cell.toJSON().outputs.find((output) => output.output_type === "error");
  if (error) return `${error.ename}: ${error.evalue}`;
  return cell.executionCount === null ? "was not run" : "";
}

// Step through all stops; returns for each {slide, title, minutes, id (of its cell), letters (text size
// relative to full size), fits, faults (texts)}.
export async function walk(panel) {
  const deck = panel.slamlabDeck, seen = [];
  deck.go(0);
  for (let before = -1; deck.at !== before; deck.next()) {
    before = deck.at;
    await settled();
    // formulas that are typeset late are laid out again
    for (let frames = 0; frames < LATE && !fits(deck.page); frames += FRAMES) await settled();
    const { title, minutes } = deck.slides[deck.slide];
    seen.push({
      slide: deck.slide + 1,
      title,
      minutes: minutes ?? 0,
      id: deck.notebook.widgets[deck.cell].model.id,
      letters: deck.shown.shrink,
      fits: fits(deck.page),
      faults: faultsOf(deck),
    });
  }
  return seen;
}

const ALIGNED = /\S {2,}\S/; // columns; a sentence may break
const CONTROL = "application/vnd.jupyter.widget-view+json";
const USES = /\b(Press|Click|Move|Drag|Set|Play) [^.]*(▶|slider|button)|(Rotate|Change) the |\b([Pp]ress ▶|Tick the box)|(slider|button)s? (above|below)/; // text that needs a control

// What a class would miss on the slide as it is seen at this stop.
function faultsOf({ notebook, page, shown, slides, slide, stops, at }) {
  const visible = (one) => !one.closest(".slamlab-off, .slamlab-later") && one.getClientRects().length > 0;
  const cells = shown.cells.map((index) => notebook.widgets[index]);
  const seen = cells.filter(({ node }) => visible(node));
  const found = [];
  const lines = seen.filter(({ node }) => node.matches(".slamlab-folded") && !node.querySelector(".jp-OutputArea-child"));
  if (lines.length === seen.length) found.push("shows only a line of folded code");
  const heads = seen.every(({ node }) => node.querySelector(":is(h1, h2, h3)") && !node.querySelector("p, li, table, mjx-container, img"));
  if (heads && stops[at + 1]?.slide === slide) found.push("shows only a heading at first");
  const printed = seen.flatMap(({ node }) => [...node.querySelectorAll(PRINTED)]).filter(visible);
  if (printed.some((one) => ALIGNED.test(one.textContent) && printedWidth(one) > 1.001)) found.push("breaks a printed line");
  const isRight = ({ node }) => node.matches(".slamlab-right");
  if (page.matches(".slamlab-columns") && seen.every(isRight)) found.push("has an empty left half");
  const texts = seen.filter(({ model }) => model.type === "markdown").map(({ node }) => node.textContent);
  const here = slides[slide].cells.some((index) => notebook.widgets[index].model.outputs?.toJSON().some(({ data }) => data?.[CONTROL]));
  if (!here && texts.some((text) => USES.test(text))) found.push("mentions a control that is on another slide");
  return found;
}
