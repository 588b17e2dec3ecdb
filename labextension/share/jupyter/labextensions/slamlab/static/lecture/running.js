// Cells that are run, folded or changed on their slide, without losing the place.

import { foldCode, lockCode, unlockCode } from "./code.js";

const SECOND_PRESS = 4000; // [ms] in which it is one

let actions; // NotebookActions, which the container hands over

export function useActions(NotebookActions) { actions = NotebookActions; }

// The code cell that is meant: the one touched last if it is in sight, else the last one shown; it is
// told where there is none.
function codeCell(deck) {
  const seen = deck.notebook.widgets.filter(({ node, model }) => model.type === "code"
    && !node.classList.contains("slamlab-off") && !node.classList.contains("slamlab-later"));
  if (!seen.length) deck.notice("There is no code on this slide.");
  return seen.find(({ node }) => node === deck.touched) ?? seen.at(-1);
}

async function runThese(deck, cells, words) {
  deck.notice(words, Infinity);
  const typing = deck.unlocked?.editor.hasFocus();
  const goneOn = () => document.activeElement?.matches(".slamlab-layer *, .jp-OutputArea-output *"); // to a control
  const typeOn = () => { if (typing && !goneOn()) deck.unlocked?.editor.focus(); }; // no letter of it is a key of the deck
  const running = actions.runCells(deck.notebook, cells, deck.panel.sessionContext);
  typeOn();
  const ran = await running.catch(() => false); // a kernel that is restarted answers nothing
  deck.again();
  typeOn();
  deck.notice(ran ? "" : "The code stopped with an error.");
}

export async function runCell(deck) {
  const cell = codeCell(deck);
  if (!cell) return;
  await runThese(deck, [cell], "running …");
}

const codeOf = (deck, from, to) => deck.notebook.widgets.slice(from, to).filter(({ model }) => model.type === "code");

export async function runAll(deck) {
  await runThese(deck, codeOf(deck, 0, deck.cell + 1), "running all cells up to here …");
}

// Stop what the kernel computes.
export async function interrupt({ panel }) {
  await panel.sessionContext.session?.kernel?.interrupt();
}

// A new kernel and all cells, first those up to here: at the second press, as all that was computed is forgotten.
export async function restart(deck) {
  if (!deck.restarting) {
    deck.restarting = setTimeout(() => { deck.restarting = undefined; }, SECOND_PRESS);
    deck.notice("R once more restarts the kernel, which forgets all, and runs all cells.");
    return;
  }
  clearTimeout(deck.restarting);
  deck.restarting = undefined;
  deck.notice("restarting …", Infinity);
  await deck.panel.sessionContext.restartKernel();
  const follow = codeOf(deck, deck.cell + 1);
  await runAll(deck);
  if (follow.length) await runThese(deck, follow, "running what follows …");
}

// Fold the code to its telling line, or show the whole of it.
export function foldOrUnfold(deck) {
  const cell = codeCell(deck);
  if (!cell) return;
  cell.node.classList.toggle("slamlab-folded");
  deck.again();
}

// Open the code of a cell for changes; Escape locks it again, and so does leaving its slide.
export function unlock(deck) {
  const cell = codeCell(deck);
  if (!cell) return;
  deck.locking?.(); // one at a time
  unlockCode(cell);
  deck.unlocked = cell;
  const left = () => { if (cell.node.classList.contains("slamlab-off")) deck.locking?.(); };
  deck.changed.connect(left);
  deck.locking = () => {
    deck.locking = deck.unlocked = undefined;
    deck.changed.disconnect(left);
    foldCode(cell);
    lockCode(cell);
    deck.panel.node.focus();
    document.activeElement?.blur();
    deck.again();
    return true;
  };
  deck.notice("Ctrl+Enter runs it, Esc locks it; all is as it was once you restore the lesson.");
  deck.again();
}
