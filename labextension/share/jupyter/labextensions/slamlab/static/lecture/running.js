// Cells that are run, folded or changed on their slide, without losing the place.

import { foldCode, lockCode, unlockCode } from "./code.js";

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
  const ran = await actions.runCells(deck.notebook, cells, deck.panel.sessionContext);
  deck.again();
  deck.notice(ran ? "" : "The code stopped with an error.");
}

export async function runCell(deck) {
  const cell = codeCell(deck);
  if (!cell) return;
  await runThese(deck, [cell], "running …");
}

export async function runAll(deck) {
  const cells = deck.notebook.widgets.slice(0, deck.cell + 1).filter(({ model }) => model.type === "code");
  await runThese(deck, cells, "running all cells up to here …");
}

// Fold the code to its telling line, or show the whole of it.
export function foldOrUnfold(deck) {
  const cell = codeCell(deck);
  if (!cell) return;
  cell.node.classList.toggle("slamlab-folded");
  deck.again();
}

// Open the code of a cell for changes; Escape locks it again.
export function unlock(deck) {
  const cell = codeCell(deck);
  if (!cell) return;
  deck.locking?.(); // one at a time
  unlockCode(cell);
  deck.locking = () => {
    deck.locking = undefined;
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
