// Snapshot of a stop as elements that are independent of the notebook, for the presenter window and the
// handout.

import { layOut } from "./fit.js";
import { reveal } from "./slides.js";

const inert = document.implementation.createHTMLDocument(""); // in which images are not loaded

// A copy of an element of the page, its canvases as images.
export function copied(element) {
  const copy = inert.importNode(element, true);
  const drawn = [...element.querySelectorAll("canvas")];
  copy.querySelectorAll("canvas").forEach((canvas, k) => {
    const image = inert.createElement("img");
    for (const { name, value } of canvas.attributes) image.setAttribute(name, value);
    const { clientWidth: width, clientHeight: height } = drawn[k]; // style sheets size a canvas, not an image
    if (width) Object.assign(image.style, { width: `${width}px`, height: `${height}px` });
    try {
      image.src = drawn[k].toDataURL();
    } catch {
      image.alt = "a picture that cannot be copied"; // it contains an image of another host
    }
    canvas.replaceWith(image);
  });
  return copy;
}

// A copy of a cell, which slides.js and fit.js treat as they treat the cell.
function copyOf(cell) {
  const node = copied(cell.node);
  return { node, model: cell.model, outputArea: { node: node.querySelector(".jp-OutputArea") ?? node } };
}

// Snapshot of a stop of a deck, by its number, with copies of the page's ancestors; undefined if the stop
// does not exist or its slide is not laid out.
export function pictureOf(deck, number) {
  const stop = deck.stops[number];
  const pages = deck.layouts.get(stop?.slide);
  if (!pages) return undefined;
  const shown = pages.findLast(({ cells }) => cells[0] <= stop.cell) ?? pages[0];
  const widgets = []; // only of this page, at their indices
  for (const index of shown.cells) widgets[index] = copyOf(deck.notebook.widgets[index]);
  reveal({ widgets }, stop, shown.cells, shown.lines);
  let tree = inert.importNode(deck.page, false);
  for (const index of shown.cells) tree.append(widgets[index].node);
  layOut(tree, { widgets }, shown, deck.zoom);
  for (let outer = deck.page; outer !== deck.panel.node;) {
    outer = outer.parentElement;
    const around = inert.importNode(outer, false);
    around.append(tree);
    tree = around;
  }
  tree.removeAttribute("popover"); // otherwise it would be hidden
  if (number === deck.at) tree.append(overlay(deck));
  return tree;
}

// Ink over the slide.
function overlay(deck) {
  const layer = inert.importNode(deck.layer, false);
  layer.append(...[...deck.layer.querySelectorAll(":scope > svg")].map(copied));
  return layer;
}

// Copies of a slide's notes.
export function notesOf({ notebook, slides }, slide) {
  return slides[slide].notes
    .map((index) => notebook.widgets[index].node.querySelector(".jp-RenderedMarkdown"))
    .filter(Boolean) // not rendered yet
    .map(copied);
}

// Styles of this page and attributes of its theme: {sheets: [{href} or {text}], html, body}.
export function stylesOf() {
  const sheets = [...document.styleSheets, ...document.adoptedStyleSheets]
    .filter((sheet) => !sheet.disabled)
    .map((sheet) => sheet.href ? { href: sheet.href } : { text: rules(sheet), id: sheet.ownerNode?.id });
  const attributes = (element) => [...element.attributes].map(({ name, value }) => [name, value]);
  return { sheets, html: attributes(document.documentElement), body: attributes(document.body) };
}

// Rules may be added by scripts, as for formulas: then the element's text does not contain them.
const rules = (sheet) => [...sheet.cssRules].map(({ cssText }) => cssText).join("\n");

// Changes whenever the styles change (approximately).
export function stylesSignature() {
  const sheets = [...document.styleSheets, ...document.adoptedStyleSheets];
  const count = (sheet) => sheet.href ? sheet.href : sheet.cssRules.length;
  return [...sheets.map(count), document.body.dataset.jpThemeName].join();
}
