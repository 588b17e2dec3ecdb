// Answers are stored folded; those of a question unfold when it is answered (slamlab.checks.ask).

import { forEachElement } from "./watching.js";

const answerOf = (cell) => cell.model.getMetadata("slamlab")?.answers;

export function openAnswers(panel) {
  forEachElement(panel, "[data-slamlab-answered]", (told) => {
    for (const cell of panel.content.widgets) {
      if (answerOf(cell) !== told.dataset.slamlabAnswered) continue;
      if (cell.outputHidden) cell.outputHidden = false;
      if (cell.inputHidden) cell.inputHidden = false;
    }
  });
}

// JupyterLab opens a cell that is run: an answer that was folded is folded again, until it is asked for.
export function keepFolded(NotebookActions) {
  let before; // how the answers were when a run began; cells that run together are opened at once
  const begun = (_, { notebook }) => {
    if (before) return;
    before = notebook.widgets.filter(answerOf).map((cell) => [cell, cell.outputHidden, cell.inputHidden]);
    queueMicrotask(() => {
      for (const [cell, output, input] of before) {
        if (output) cell.outputHidden = true;
        if (input) cell.inputHidden = true;
      }
      before = undefined;
    });
  };
  NotebookActions.executionScheduled.connect(begun); // of code
  NotebookActions.executed.connect(begun); // of text, which is not scheduled
}
