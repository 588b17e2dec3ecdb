// Keys of the deck, remote controls among them: what each does is said by the help.

import { toggleOverview } from "./overview.js";
import { foldOrUnfold, interrupt, restart, runAll, runCell, unlock } from "./running.js";

const SIZES = { least: 0.7, most: 2 };

// By key: {does, action}.
export function keysOf(deck) {
  const keys = new Map();
  const add = (names, does, action) => names.forEach((key) => keys.set(key, { does, action }));
  add(["PageDown", "ArrowRight", " ", "Enter"], "next", () => deck.next());
  add(["PageUp", "ArrowLeft", "Shift+ "], "back", () => deck.back());
  add(["F5", "Home"], "from the beginning", () => deck.go(0));
  add(["Shift+F5"], "this slide from its beginning", () => deck.goToSlide(deck.slide));
  add(["End"], "last slide", () => deck.go(deck.stops.length - 1));
  add([".", "b"], "blank, and back", () => deck.layer.classList.toggle("slamlab-blank"));
  add(["o"], "overview: arrows or a number, and Enter", () => toggleOverview(deck));
  add(["c"], "code: folded or whole", () => foldOrUnfold(deck));
  add(["Ctrl+Enter", "Shift+Enter"], "run this cell", () => runCell(deck));
  add(["r"], "run all cells up to here", () => runAll(deck));
  add(["s"], "stop what runs", () => interrupt(deck));
  add(["R"], "restart the kernel, and run all cells, those up to here first (press it twice)", () => restart(deck));
  add(["e"], "unlock this cell's code, to change it", () => unlock(deck));
  add(["n"], "slide number", () => deck.bar.toggle("number"));
  add(["t"], "timer", () => deck.bar.toggle("timer"));
  add(["f"], "full screen", () => fullScreen());
  add(["+", "="], "larger", () => resize(deck, 1.1));
  add(["-"], "smaller", () => resize(deck, 1 / 1.1));
  add(["0"], "usual size", () => resize(deck));
  add(["?", "h"], "help", () => deck.bar.help());
  add(["Escape"], "out", () => leave(deck));
  return keys;
}

// All slides by a factor, or at their usual size; it is told why the one that is shown stays as it is.
function resize(deck, factor) {
  const { size, scale } = deck;
  deck.size = factor ? Math.min(SIZES.most, Math.max(SIZES.least, size * factor)) : 1;
  deck.again();
  const larger = factor > 1;
  if (!factor || (larger ? deck.scale > scale : deck.scale < scale)) deck.notice("");
  else if (deck.size === size) deck.notice(`Slides can be no ${larger ? "larger" : "smaller"}.`);
  else if (larger) deck.notice("This slide is full and does not grow; others are larger now.");
  else deck.notice("This slide is small to fit and does not shrink; others are smaller now.");
}

function fullScreen() {
  const done = document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen();
  done.catch(() => {}); // some screens have none
}

// Escape closes what is open, and only then the deck.
function leave(deck) {
  if (deck.locking?.()) return;
  if (deck.layer.classList.contains("slamlab-blank")) return deck.layer.classList.remove("slamlab-blank");
  const open = deck.layer.querySelector("[data-slamlab-closes]");
  open?.dispatchEvent(new Event("slamlab-closed")); // who opened it may have more to put away
  if (open) return open.remove();
  deck.end();
}
