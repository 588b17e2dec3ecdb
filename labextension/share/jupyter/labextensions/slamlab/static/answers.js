// Answers are stored folded; those of a question unfold when it is answered (slamlab.checks.ask).

import { forEachElement } from "./watching.js";

const answerOf = (cell) => cell.model.getMetadata("slamlab")?.answers;
const isText = (cell) => cell.model.type === "markdown";
const foldedTexts = new WeakSet(); // as they were before the last key or press

export function openAnswers(panel) {
  forEachElement(panel, ".jp-Cell", (node) => { // its place says what opens it: style.css
    const cell = panel.content.widgets.find((each) => each.node === node);
    if (cell && answerOf(cell)) node.dataset.slamlabAnswers = answerOf(cell);
  });
  forEachElement(panel, "[data-slamlab-answered]", (told) => {
    for (const cell of panel.content.widgets) {
      if (answerOf(cell) !== told.dataset.slamlabAnswered) continue;
      if (cell.outputHidden) cell.outputHidden = false;
      if (isText(cell) && cell.inputHidden) cell.inputHidden = false; // code is folded for itself
      foldedTexts.delete(cell);
    }
  });
}

// JupyterLab opens a cell that is run: an answer that was folded is folded again, until it is asked for.
export function keepFolded(NotebookActions, tracker) {
  const look = () => tracker.forEach((panel) => {
    for (const cell of panel.content.widgets.filter(isText)) {
      foldedTexts[cell.inputHidden ? "add" : "delete"](cell);
    }
  });
  for (const event of ["keydown", "pointerdown"]) document.addEventListener(event, look, true);
  let before; // how the answers were when a run began; cells that run together are opened at once
  const begun = (_, { notebook }) => {
    if (before) return;
    before = notebook.widgets.filter(answerOf).map(
      (cell) => [cell, cell.outputHidden, cell.inputHidden || foldedTexts.has(cell)]);
    queueMicrotask(() => {
      for (const [cell, output, input] of before) {
        if (output) cell.outputHidden = true;
        if (input) cell.inputHidden = true;
      }
      before = undefined;
    });
  };
  NotebookActions.executionScheduled.connect(begun); // of code
  NotebookActions.executed.connect(begun); // of text, which is not scheduled, and open by then
}
