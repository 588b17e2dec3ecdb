// Plugins of the course: each keeps one thing in order, and all else works without them.

import { keepFolded, openAnswers } from "./answers.js";
import { keepClean } from "./clean.js";
import { keepKeys, nameControls, nameParts, tellDeadWidgets } from "./controls.js";
import { lecturePlugin } from "./lecture/plugin.js";
import { playDerivations } from "./derivations.js";
import { showProgress } from "./progress.js";

const NARROW = 1000; // pixels, below which the side bar leaves a notebook too little room

// The plugins; offered is what the application shares: its classes and tokens by their names.
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
    forEachNotebook("clean", "A notebook that was only opened is not unsaved.", keepClean),
    forEachNotebook("answers", "Answers unfold once a question is answered.", openAnswers),
    forEachNotebook("parts", "Cells and editors have names, too.", nameParts),
    forEachNotebook("names", "Sliders have names for who cannot see them.", nameControls),
    forEachNotebook("dead", "Controls without a kernel say how they come alive.", tellDeadWidgets),
    forEachNotebook("derivations", "Derivations are played line by line.", playDerivations),
    forEachNotebook("progress", "The head of a notebook shows how far one is.", showProgress),
    {
      id: "slamlab:keys",
      description: "Keys on a control are the control's.",
      autoStart: true,
      activate: keepKeys,
    },
    {
      id: "slamlab:folded",
      description: "Answers stay folded when they are run.",
      autoStart: true,
      requires: [INotebookTracker],
      activate: (app, tracker) => keepFolded(NotebookActions, tracker),
    },
    lecturePlugin(offered),
    {
      id: "slamlab:narrow",
      description: "On a narrow screen the side bar starts closed.",
      autoStart: true,
      activate: (app) => {
        app.restored.then(() => {
          if (window.innerWidth < NARROW) app.shell.collapseLeft?.();
        });
      },
    },
  ];
}
