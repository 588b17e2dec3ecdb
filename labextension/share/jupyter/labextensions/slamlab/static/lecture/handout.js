// What `slamlab handout` asks: every page of the deck, as shown at its last stop, as a leaf of one
// document that the browser prints. Text stays text, ink stays lines; a canvas becomes a picture.

import { element } from "../element.js";
import { settled } from "./frames.js";
import { notesOf, pictureOf } from "./picture.js";

const WAITS = /^Run this cell (for its controls|to answer)\.$/; // paper has none
const STROKE = ".slamlab-stroke:not(.slamlab-unseen)";

// Put a leaf for every page of the deck in place of all that is shown: how many there are, whether the
// file of the ink was read, and how many of its strokes are on no leaf.
export async function leaves(panel, { notes }) {
  const deck = panel.slamlabDeck, book = element("main", "slamlab-book");
  const inkRead = await deck.ink.loaded;
  for (deck.go(0); ; deck.next()) {
    const { slide, shown } = deck, next = deck.stops[deck.at + 1];
    if (next?.slide === slide && shown.cells.includes(next.cell)) continue; // more comes to this page
    await settled();
    const said = notes && next?.slide !== slide ? notesOf(deck, slide) : [];
    book.append(element("section", "", pictureOf(deck, deck.at), ...said.map((note) => element("aside", "", note))));
    if (!next) break;
  }
  for (const output of book.querySelectorAll(".jp-OutputArea-output")) {
    if (WAITS.test(output.textContent.trim())) output.style.visibility = "hidden"; // its room is kept: ink stays in place
  }
  const size = { width: window.innerWidth, height: window.innerHeight };
  deck.end();
  // the theme's sheets hang in the body, too
  for (const one of [...document.body.children]) if (!["LINK", "STYLE"].includes(one.tagName)) one.remove();
  document.body.append(book);
  document.head.append(style(size, notes));
  await Promise.all([...book.querySelectorAll("img")].map((one) => one.decode().catch(() => {})));
  const inked = new Set([...book.querySelectorAll(STROKE)].map((one) => one.dataset.stroke));
  return { leaves: book.children.length, inkRead, lost: deck.ink.strokes.length - inked.size };
}

function style({ width, height }, notes) {
  const [w, h] = [`${width}px !important`, `${height}px !important`];
  return element("style", "", `
    @page { size: ${width}px ${notes ? Math.round(width * Math.SQRT2) : height}px; margin: 0; }
    html, body { overflow: visible !important; height: auto !important; position: static !important; }
    html, body, body.jp-ThemedContainer { background: #ffffff !important; }
    .slamlab-book section { ${notes ? "break-inside: avoid; border-bottom: 1px solid #9e9e9e" : "break-after: page"}; }
    .slamlab-book section:last-child { break-after: auto; }
    .slamlab-book .slamlab-deck, .slamlab-book .slamlab-deck > .jp-Notebook { position: relative !important; width: ${w}; height: ${h}; display: block; }
    .slamlab-book .slamlab-layer { position: absolute; }
    .slamlab-book aside { padding: 24px 72px; --jp-content-font-size1: 22px; font-size: 22px; }`);
}
