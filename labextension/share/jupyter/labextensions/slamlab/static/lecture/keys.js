// Keys of the deck, including those of remote controls, with descriptions for the help.

import { toggleOverview } from "./overview.js";
import { foldOrUnfold, goToError, interrupt, restart, restore, runAll, runCell, unlock } from "./execution.js";

const SIZES = { least: 0.7, most: 2 };

// By key: {does, action}.
export function keysOf(deck) {
  const keys = new Map();
  const add = (names, does, action) => names.forEach((key) => keys.set(key, { does, action }));
  add(["PageDown", "ArrowRight", " ", "Enter"], "next", () => deck.next());
  add(["PageUp", "ArrowLeft", "Shift+ "], "back", () => deck.back());
  add(["F5", "Home"], "first slide", () => deck.go(0));
  add(["Shift+F5"], "this slide from its beginning", () => deck.goToSlide(deck.slide));
  add(["End"], "last slide", () => deck.go(deck.stops.length - 1));
  add([".", "b"], "black screen, and back", () => deck.layer.classList.toggle("slamlab-blank"));
  add(["o"], "overview: arrow keys or a number, then Enter", () => toggleOverview(deck));
  add(["c"], "fold or unfold the code", () => foldOrUnfold(deck));
  add(["Ctrl+Enter", "Shift+Enter"], "run this cell", () => runCell(deck));
  add(["r"], "run all cells up to here", () => runAll(deck));
  add(["s"], "stop the running cell", () => interrupt(deck));
  add(["R"], "press twice: restart the kernel and run all cells", () => restart(deck));
  add(["e"], "unlock this cell's code for changes", () => unlock(deck));
  add(["u"], "restore the cell that failed, or this one", () => restore(deck));
  add(["g"], "go to the cell that failed", () => goToError(deck));
  add(["n"], "slide number", () => deck.bar.toggle("number"));
  add(["t"], "timer", () => deck.bar.toggle("timer"));
  add(["f"], "full screen", () => fullScreen());
  add(["+", "="], "larger", () => resize(deck, 1.1));
  add(["-"], "smaller", () => resize(deck, 1 / 1.1));
  add(["0"], "default size", () => resize(deck));
  add(["?", "h"], "help", () => deck.bar.help());
  add(["Escape"], "close any open dialog, then the slides", () => leave(deck));
  return keys;
}

// Resize all slides by a factor, or to the default size; explain why the current one does not change.
function resize(deck, factor) {
  const { size, scale } = deck;
  deck.size = factor ? Math.min(SIZES.most, Math.max(SIZES.least, size * factor)) : 1;
  deck.refresh();
  const larger = factor > 1;
  if (!factor || (larger ? deck.scale > scale : deck.scale < scale)) deck.notice("");
  else if (deck.size === size) deck.notice(`Slides cannot be ${larger ? "larger" : "smaller"}.`);
  else if (larger) deck.notice("This slide is full and does not grow. Other slides are larger now.");
  else deck.notice("This slide is already shrunk to fit. Other slides are smaller now.");
}

function fullScreen() {
  const done = document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen();
  done.catch(() => {}); // not available everywhere
}

// Escape closes open dialogs first, then the deck.
function leave(deck) {
  if (deck.locking?.()) return;
  if (deck.layer.classList.contains("slamlab-blank")) return deck.layer.classList.remove("slamlab-blank");
  const open = deck.layer.querySelector("[data-slamlab-closes]");
  open?.dispatchEvent(new Event("slamlab-closed")); // its owner may have more to close
  if (open) return open.remove();
  deck.end();
}
