// Execution, folding and editing of cells on a slide.

import { foldCode, lockCode, unlockCode } from "./code.js";

const SECOND_PRESS = 4000; // [ms] within which a second press counts

let actions; // NotebookActions of the application

export function useActions(NotebookActions) { actions = NotebookActions; }

// The target code cell: the one last touched if it is visible, otherwise the last one shown. A notice
// reports if there is none.
function codeCell(deck) {
  const seen = deck.notebook.widgets.filter(({ node, model }) => model.type === "code"
    && !node.classList.contains("slamlab-off") && !node.classList.contains("slamlab-later"));
  if (!seen.length) deck.notice("There is no code on this slide.");
  return seen.find(({ node }) => node === deck.touched) ?? seen.at(-1);
}

async function runThese(deck, cells, message) {
  if (deck.health.stopped) return deck.notice("");
  deck.failed = undefined;
  deck.notice(message, Infinity);
  deck.health.runs();
  const typing = deck.unlocked?.editor.hasFocus();
  const focusMoved = () => document.activeElement?.matches(".slamlab-layer *, .jp-OutputArea-output *"); // to a control
  const keepTyping = () => { if (typing && !focusMoved()) deck.unlocked?.editor.focus(); }; // so that typed letters are not keys of the deck
  const running = actions.runCells(deck.notebook, cells, deck.panel.sessionContext).catch(() => false); // a restarting kernel does not answer
  keepTyping();
  const ran = await Promise.race([running, deck.health.gone()]);
  deck.refresh();
  keepTyping();
  deck.notice("");
  if (!ran && !deck.health.trouble) reportError(deck, cells);
  return ran;
}

// Name the error, and the slide if it is another one, with the keys that help.
function reportError(deck, cells) {
  const errorOf = ({ model }) => model.outputs.toJSON().find((output) => output.output_type === "error");
  const cell = cells.find((one) => errorOf(one) && !one.model.getMetadata("tags")?.includes("raises-exception"));
  if (!cell) return deck.notice("The code stopped with an error.");
  const { ename, evalue } = errorOf(cell);
  const slide = deck.slideOf(cell);
  const where = slide === deck.slide ? "The code" : `Slide ${slide + 1}`;
  const help = slide !== deck.slide ? " Press g to go there, or u to restore that cell alone."
    : ename === "NameError" ? " Press r to run all cells up to here." : "";
  deck.failed = cell;
  deck.notice(`${where} stopped with an error: ${ename}${evalue && `: ${evalue.slice(0, 60)}`}.${help}`, Infinity);
}

export function goToError(deck) {
  if (deck.failed) deck.goToSlide(deck.slideOf(deck.failed));
  else deck.notice("No cell has failed.");
}

// Restore the code of the cell that failed, or of the current cell, as it was before the lecture.
export function restore(deck) {
  const cell = deck.failed ?? codeCell(deck);
  if (!cell) return;
  deck.failed = undefined;
  deck.locking?.();
  deck.notice(deck.restoreCell(cell) ? "The cell is restored. Press r to run all cells up to here."
    : "This cell was not changed in the lecture.");
  deck.refresh();
}

export async function runCell(deck) {
  const cell = codeCell(deck);
  if (!cell) return;
  await runThese(deck, [cell], "running …");
}

const codeOf = (deck, from, to) => deck.notebook.widgets.slice(from, to).filter(({ model }) => model.type === "code");

export async function runAll(deck) {
  return runThese(deck, codeOf(deck, 0, deck.cell + 1), "running all cells up to here …");
}

// Interrupt the kernel.
export async function interrupt({ panel }) {
  await panel.sessionContext.session?.kernel?.interrupt();
}

// Restart the kernel and run all cells, first those up to here; needs a second press, because results are lost.
export async function restart(deck) {
  if (!deck.restarting) {
    deck.restarting = setTimeout(() => { deck.restarting = undefined; }, SECOND_PRESS);
    deck.notice("Press R again to restart the kernel, discard all results, and run all cells.");
    return;
  }
  clearTimeout(deck.restarting);
  deck.restarting = undefined;
  deck.notice("restarting …", Infinity);
  if (!await deck.health.mend(freshKernel(deck.panel.sessionContext))) return deck.notice("");
  const follow = codeOf(deck, deck.cell + 1);
  if (await runAll(deck) && follow.length) await runThese(deck, follow, "running the cells that follow …");
}

// Restart the kernel, or start one if there is none; whether there is one then.
async function freshKernel(context) {
  await context.sessionManager.refreshRunning(); // a new server does not know the old kernel
  if (context.session?.kernel) await context.restartKernel();
  else await context.changeKernel({ name: context.prevKernelName });
  await context.session?.kernel?.info;
  return Boolean(context.session?.kernel);
}

// Fold the code to its summary line, or show it in full.
export function foldOrUnfold(deck) {
  const cell = codeCell(deck);
  if (!cell) return;
  cell.node.classList.toggle("slamlab-folded");
  deck.refresh();
}

// Unlock the code of a cell; Escape or leaving the slide locks it again.
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
    deck.refresh();
    return true;
  };
  deck.notice("Press Ctrl+Enter to run the cell, or Esc to lock it. You can restore the lesson at the end.");
  deck.refresh();
}
