// Answers are stored folded; those of a question unfold when it is answered (slamlab.checks.ask).

import { forEachElement } from "./watching.js";

export function openAnswers(panel) {
  forEachElement(panel, "[data-slamlab-answered]", (told) => {
    for (const cell of panel.content.widgets) {
      if (cell.model.getMetadata("slamlab")?.answers !== told.dataset.slamlabAnswered) continue;
      if (cell.outputHidden) cell.outputHidden = false;
      if (cell.inputHidden) cell.inputHidden = false;
    }
  });
}
