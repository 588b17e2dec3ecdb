// Plugins of the course; each is independent, and notebooks work without them.

import { keepFolded, openAnswers } from "./answers.js";
import { keepClean } from "./unsaved_state.js";
import { keepKeys, nameControls, nameParts, explainDeadWidgets } from "./controls.js";
import { lecturePlugin } from "./lecture/plugin.js";
import { playDerivations } from "./derivations.js";
import { showProgress } from "./progress.js";

const NARROW = 1000; // width [px] below which the side bar starts closed

// The plugins; offered contains classes and tokens that the application shares.
export function plugins(offered) {
  const { INotebookTracker, NotebookActions, Widget } = offered;
  for (const sheet of ["style.css", "lecture/lecture.css", "lecture/ink.css", "lecture/audience.css"]) {
    const style = document.createElement("link");
    style.rel = "stylesheet";
    style.href = new URL(sheet, import.meta.url).href;
    document.head.append(style);
  }

  const forEachNotebook = (name, description, attend) => ({
    id: `slamlab:${name}`,
    description,
    autoStart: true,
    requires: [INotebookTracker],
    activate: (app, tracker) => {
      const safely = (panel) => Promise.resolve(attend(panel, app, Widget)).catch(console.error);
      tracker.forEach(safely);
      tracker.widgetAdded.connect((_, panel) => { safely(panel); });
    },
  });

  return [
    forEachNotebook("clean", "Opening a notebook does not mark it as unsaved.", keepClean),
    forEachNotebook("answers", "Answers unfold when a question is answered.", openAnswers),
    forEachNotebook("parts", "Cells and editors have accessible names.", nameParts),
    forEachNotebook("names", "Sliders have accessible names.", nameControls),
    forEachNotebook("dead", "Controls without a kernel show how to start them.", explainDeadWidgets),
    forEachNotebook("derivations", "Derivations are shown line by line.", playDerivations),
    forEachNotebook("progress", "The top of a notebook shows your progress.", showProgress),
    {
      id: "slamlab:keys",
      description: "A focused control receives its keys.",
      autoStart: true,
      activate: keepKeys,
    },
    {
      id: "slamlab:folded",
      description: "Answers stay folded when cells are run.",
      autoStart: true,
      requires: [INotebookTracker],
      activate: (app, tracker) => keepFolded(NotebookActions, tracker),
    },
    lecturePlugin(offered),
    {
      id: "slamlab:narrow",
      description: "The side bar starts closed on a narrow screen.",
      autoStart: true,
      activate: (app) => {
        app.restored.then(() => {
          if (window.innerWidth < NARROW) app.shell.collapseLeft?.();
        });
      },
    },
  ];
}
