// Folded answers: the answers to a question unfold when it is answered (classroom.checks.ask).

import { forEachElement } from "./observing.js";

const answerOf = (cell) => cell.model.getMetadata("slamlab")?.answers;
const isText = (cell) => cell.model.type === "markdown";
const foldedTexts = new WeakSet(); // texts that were folded before the last key or click

export function openAnswers(panel) {
  forEachElement(panel, ".jp-Cell", (node) => { // style.css uses it for the placeholder
    const cell = panel.content.widgets.find((each) => each.node === node);
    if (cell && answerOf(cell)) node.dataset.slamlabAnswers = answerOf(cell);
  });
  forEachElement(panel, "[data-slamlab-answered]", (answered) => {
    for (const cell of panel.content.widgets) {
      if (answerOf(cell) !== answered.dataset.slamlabAnswered) continue;
      if (cell.outputHidden) cell.outputHidden = false;
      if (isText(cell) && cell.inputHidden) cell.inputHidden = false; // code is folded separately
      foldedTexts.delete(cell);
    }
  });
}

// JupyterLab unfolds a cell that is run; an answer that was folded is folded again, unless a slide opened it.
export function keepFolded(NotebookActions, tracker) {
  const look = () => tracker.forEach((panel) => {
    for (const cell of panel.content.widgets.filter(isText)) {
      foldedTexts[cell.inputHidden ? "add" : "delete"](cell);
    }
  });
  for (const event of ["keydown", "pointerdown"]) document.addEventListener(event, look, true);
  let before; // state of the answers before a run; cells of one run are unfolded together
  const runStarted = (_, { notebook }) => {
    if (before) return;
    before = notebook.widgets.filter(answerOf).map(
      (cell) => [cell, cell.outputHidden,
        (cell.inputHidden || foldedTexts.has(cell)) && !("inputHidden" in cell.node.dataset)]);
    queueMicrotask(() => {
      for (const [cell, output, input] of before) {
        if (output) cell.outputHidden = true;
        if (input) cell.inputHidden = true;
      }
      before = undefined;
    });
  };
  NotebookActions.executionScheduled.connect(runStarted); // of code
  NotebookActions.executed.connect(runStarted); // of text cells, which are not scheduled
}
