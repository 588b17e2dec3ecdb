// The lecture begins by a button of the notebook, the palette, or an address with ?lecture=1.

import { button, element } from "../element.js";
import { addAudience } from "./audience.js";
import { Deck } from "./deck.js";
import { addInk } from "./ink.js";
import { addPresenter } from "./presenting.js";
import { keepFile } from "./restore.js";
import { useActions } from "./running.js";
import { isShown } from "./stops.js";
import { strip } from "./strip.js";

const COMMAND = "slamlab:lecture";
const asked = new URLSearchParams(window.location.search).has("lecture");

export function lecturePlugin({ INotebookTracker, NotebookActions, ICommandPalette, Widget }) {
  return {
    id: "slamlab:lecture",
    description: "A notebook is shown slide by slide, alive.",
    autoStart: true,
    requires: [INotebookTracker],
    optional: [ICommandPalette],
    activate(app, tracker, palette) {
      useActions(NotebookActions);
      const start = (panel, cell) => lecture(panel, app, Widget, cell).catch(console.error);
      app.commands.addCommand(COMMAND, {
        label: "Lecture: Start at This Cell",
        isEnabled: () => Boolean(tracker.currentWidget),
        execute: () => start(tracker.currentWidget, tracker.currentWidget.content.activeCellIndex),
      });
      palette?.addItem({ command: COMMAND, category: "Lecture" });
      let waiting = asked;
      const attend = (panel) => {
        panel.toolbar.insertItem(10, "slamlab-lecture", startButton(Widget, app));
        if (waiting) panel.revealed.then(() => start(panel, 0));
        waiting = false;
      };
      tracker.forEach(attend);
      tracker.widgetAdded.connect((_, panel) => attend(panel));
    },
  };
}

function startButton(Widget, app) {
  const start = element("button", "jp-ToolbarButtonComponent slamlab-lecture-start", "Lecture");
  start.title = "Show this notebook slide by slide, from this cell on";
  start.addEventListener("click", () => app.commands.execute(COMMAND));
  return new Widget({ node: element("div", "jp-ToolbarButton", start) });
}

async function lecture(panel, app, Widget, cell) {
  await panel.context.ready;
  await panel.revealed;
  if (!panel.content.widgets.some(isShown)) {
    const none = "There is nothing to show: each cell of this notebook is a note or skipped on slides. ";
    const told = strip(panel, Widget, none, button("OK", () => told.dispose()));
    return;
  }
  const kept = keepFile(panel, Widget);
  const deck = new Deck(panel, app);
  deck.strip = (text, ...buttons) => strip(panel, Widget, text, ...buttons);
  deck.ended.connect(() => kept.end());
  deck.start(cell);
  panel.slamlabDeck = deck; // for tests
  addAudience(deck);
  addPresenter(deck);
  deck.ink = addInk(deck); // the handout waits for it
}
