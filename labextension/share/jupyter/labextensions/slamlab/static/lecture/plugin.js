// Plugin: start a lecture by a toolbar button, the command palette, or ?lecture=1 in the address.

import { button, element } from "../element.js";
import { addAudience } from "./audience.js";
import { Deck } from "./deck.js";
import { addInk } from "./ink.js";
import { addPresenter } from "./presenter_link.js";
import { protect } from "./notebook_protection.js";
import { useActions } from "./execution.js";
import { isShown } from "./slides.js";
import { strip } from "./banner.js";

const COMMAND = "slamlab:lecture";
// the notebook whose lecture the address asks for; JupyterLab changes the address later
const asked = new URLSearchParams(window.location.search).has("lecture") && decodeURIComponent(window.location.pathname);

export function lecturePlugin({ INotebookTracker, NotebookActions, ICommandPalette, Widget }) {
  return {
    id: "slamlab:lecture",
    description: "Shows a notebook as live slides.",
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
      let waiting = Boolean(asked);
      const attend = (panel) => {
        panel.toolbar.insertItem(10, "slamlab-lecture", startButton(Widget, app));
        if (!waiting || !asked.endsWith(`/${panel.context.localPath}`)) return;
        waiting = false; // other notebooks may be restored before it, and shown
        app.restored.then(() => { app.shell.activateById(panel.id); start(panel, 0); });
      };
      tracker.forEach(attend);
      tracker.widgetAdded.connect((_, panel) => attend(panel));
    },
  };
}

function startButton(Widget, app) {
  const start = element("button", "jp-ToolbarButtonComponent slamlab-lecture-start", "Lecture");
  start.title = "Show this notebook as slides, from this cell";
  start.addEventListener("click", () => app.commands.execute(COMMAND));
  return new Widget({ node: element("div", "jp-ToolbarButton", start) });
}

let current; // the deck that is shown; only one has the keys

async function lecture(panel, app, Widget, cell, claiming = { ifAvailable: true }) {
  await panel.context.ready;
  await panel.revealed;
  if (current?.panel === panel) return;
  const warn = (text, ...buttons) => {
    const banner = strip(panel, Widget, text, ...buttons.map(([label, action]) =>
      button(label, () => { banner.dispose(); action?.(); })));
    banner.node.querySelector("button").focus();
  };
  if (!panel.content.widgets.some(isShown)) {
    warn("There is nothing to show: every cell of this notebook is a note or is skipped. ", ["OK"]);
    return;
  }
  current?.end();
  const deck = current = new Deck(panel, app);
  const name = `slamlab-lecture:${panel.context.path}`;
  const moved = () => { deck.end(); warn("The slides of this lesson are now shown in another window. ", ["OK"]); };
  const release = await claim(name, claiming, moved);
  if (current !== deck) return release?.(); // another notebook was asked for meanwhile
  if (!release) {
    current = undefined;
    const takeOver = () => { lecture(panel, app, Widget, cell, { steal: true }).catch(console.error); };
    warn("The slides of this lesson are shown in another window. ", ["Show them here", takeOver], ["Cancel"]);
    return;
  }
  const protection = protect(panel, Widget);
  deck.restoreCell = (one) => protection.restoreCell(one);
  deck.strip = (text, ...buttons) => strip(panel, Widget, text, ...buttons);
  deck.ended.connect(() => {
    if (current === deck) current = undefined;
    release();
    protection.end();
  });
  panel.disposed.connect(() => deck.end());
  deck.start(cell);
  panel.slamlabDeck = deck; // for tests
  addAudience(deck);
  addPresenter(deck);
  deck.ink = addInk(deck); // the handout waits for it
}

// Claim the slides of a notebook for this window: a function that gives them back, or null if another window
// has them. `taken` is called when another window takes them.
function claim(name, options, taken) {
  const { locks } = navigator; // only at secure addresses
  return new Promise((resolve) => {
    if (!locks) resolve(() => {});
    locks?.request(name, options, (lock) => {
      if (!lock) return resolve(null);
      return new Promise((release) => { resolve(release); });
    }).catch(taken);
  });
}
