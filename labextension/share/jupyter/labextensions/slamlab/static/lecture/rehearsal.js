// What `slamlab rehearse` asks: the lesson run, and stepped through stop by stop.

import { fits } from "./fit.js";
import { settled } from "./frames.js";

const within = (ms, promise) => Promise.race([promise, new Promise((resolve) => { setTimeout(resolve, ms, "late"); })]);

// Run all cells, for at most so many ms: whether they came to an end, and of each {id, type, code, slide, seconds, error}.
export async function run(panel, patience) {
  const app = window.jupyterapp, notebook = panel.content;
  const runAll = async () => {
    await panel.sessionContext.ready;
    notebook.notebookConfig = { ...notebook.notebookConfig, recordTiming: true };
    await app.commands.execute("notebook:run-all-cells");
  };
  const ended = await within(patience, runAll());
  return { late: ended === "late", cells: [...notebook.model.cells].map(report) };
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

// Step through all stops: of each {slide, title, minutes, cell (its id), first (the slide's, its index),
// letters (as a part of their full size), fits}.
export async function walk(panel) {
  const deck = panel.slamlabDeck, seen = [];
  deck.go(0);
  for (let before = -1; deck.at !== before; deck.next()) {
    before = deck.at;
    await settled();
    const { title, minutes, cells } = deck.slides[deck.slide];
    seen.push({
      slide: deck.slide + 1,
      title,
      minutes: minutes ?? 0,
      first: cells[0],
      cell: deck.notebook.widgets[deck.cell].model.id,
      letters: deck.shown.shrink,
      fits: fits(deck.page),
    });
  }
  return seen;
}
