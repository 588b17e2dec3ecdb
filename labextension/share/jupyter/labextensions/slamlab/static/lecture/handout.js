// Handout, called by `slamlab handout`: every page of the deck at its last stop, as a leaf of one
// document that the browser prints. Text and ink stay vector graphics; a canvas becomes a picture.

import { element } from "../element.js";
import { settled } from "./rendering.js";
import { notesOf, pictureOf } from "./slide_snapshot.js";

const WAITS = /^Run this cell (for its controls|to answer)\.$/; // not printed
const STROKE = ".slamlab-stroke:not(.slamlab-unseen)";

// Replace the document by leaves, one for every page; returns the number of slides and of leaves, whether the ink file was
// read, and the number of strokes without a leaf.
export async function leaves(panel, { notes }) {
  const deck = panel.slamlabDeck, { title } = deck.slides[0], slides = deck.slides.length, book = element("main", "slamlab-book");
  const inkRead = await deck.ink.loaded;
  for (deck.go(0); ; deck.next()) {
    const { slide, shown } = deck, next = deck.stops[deck.at + 1];
    if (next?.slide === slide && shown.cells.includes(next.cell)) continue; // not the last stop of this page
    await settled();
    const notesOfSlide = notes && next?.slide !== slide ? notesOf(deck, slide) : [];
    book.append(element("section", "", pictureOf(deck, deck.at), element("footer", "", `${slide + 1}`),
      ...notesOfSlide.map((note) => element("aside", "", note))));
    if (!next) break;
  }
  for (const output of book.querySelectorAll(".jp-OutputArea-output")) {
    if (WAITS.test(output.textContent.trim())) output.style.visibility = "hidden"; // keeps its space, so that ink stays in place
  }
  const size = { width: window.innerWidth, height: window.innerHeight };
  deck.end();
  // keep the theme's style sheets in the body
  for (const one of [...document.body.children]) if (!["LINK", "STYLE"].includes(one.tagName)) one.remove();
  document.body.append(book);
  document.head.append(style(size, notes));
  await Promise.all([...book.querySelectorAll("img")].map((one) => one.decode().catch(() => {})));
  document.title = title; // of the PDF; JupyterLab would name the file
  const inked = new Set([...book.querySelectorAll(STROKE)].map((one) => one.dataset.stroke));
  return { slides, leaves: book.children.length, inkRead, lost: deck.ink.strokes.length - inked.size };
}

function style({ width, height }, notes) {
  const [w, h] = [`${width}px !important`, `${height}px !important`];
  return element("style", "", `
    @page { size: ${width}px ${notes ? Math.round(width * Math.SQRT2) : height}px; margin: 0; }
    html, body { overflow: visible !important; height: auto !important; position: static !important; }
    html, body, body.jp-ThemedContainer { background: #ffffff !important; }
    .slamlab-book section { position: relative; ${notes ? "break-inside: avoid; border-bottom: 1px solid #9e9e9e" : "break-after: page"}; }
    .slamlab-book footer { position: absolute; right: 14px; top: ${height - 30}px; font: 14px/20px sans-serif; color: #333333; }
    .slamlab-book section:last-child { break-after: auto; }
    .slamlab-book .slamlab-deck, .slamlab-book .slamlab-deck > .jp-Notebook { position: relative !important; width: ${w}; height: ${h}; display: block; }
    .slamlab-book .slamlab-layer { position: absolute; }
    .slamlab-book aside { padding: 24px 72px; --jp-content-font-size1: 22px; font-size: 22px; }`);
}
