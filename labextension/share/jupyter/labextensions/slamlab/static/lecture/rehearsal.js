// What `slamlab rehearse` asks: the lesson run, and stepped through stop by stop.

import { fits } from "./fit.js";
import { settled } from "./frames.js";
import { slidesOf } from "./stops.js";

const within = (ms, promise) => Promise.race([promise, new Promise((resolve) => { setTimeout(resolve, ms, "late"); })]);

// Run all cells, for at most so many ms: whether they came to an end, and of each
// {id, type, code, seconds, error, slide (the one it stands on or behind, from 1), title}.
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

// Step through all stops: of each {slide, title, minutes, id (of its cell), letters (as a part of their
// full size), fits}.
export async function walk(panel) {
  const deck = panel.slamlabDeck, seen = [];
  deck.go(0);
  for (let before = -1; deck.at !== before; deck.next()) {
    before = deck.at;
    await settled();
    const { title, minutes } = deck.slides[deck.slide];
    seen.push({
      slide: deck.slide + 1,
      title,
      minutes: minutes ?? 0,
      id: deck.notebook.widgets[deck.cell].model.id,
      letters: deck.shown.shrink,
      fits: fits(deck.page),
    });
  }
  return seen;
}
