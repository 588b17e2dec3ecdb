// Fit a slide to the screen: zoom, one or two columns, several pages.

import { questionIn } from "../questions.js";
import { stepsOf } from "./slides.js";

export const PAGE = { width: 960, height: 540 }; // [px] of a page at zoom 1
const SHRINK = [1, 0.94, 0.88, 0.82, 0.76]; // smaller text is illegible in a lecture hall
const SMALL = [0.7, 0.6, 0.5, 0.4, 0.3]; // for one cell that is too tall: small, but not cut off
// one column, or text beside a picture; in the order of the cells, so that later text is never left of earlier
const COLUMNS = ["", "minmax(0, 1fr) minmax(0, 1fr)", "minmax(0, 2fr) minmax(0, 3fr)"];
const PICTURE_FIRST = [...COLUMNS.slice(0, 2), "minmax(0, 3fr) minmax(0, 2fr)"];
const LETTERS = 0.75; // minimum scale of a figure's text
const LARGEST = 4; // maximum scale of a figure
const FIGURE = "img.slamlab-figure, .slamlab-live";
export const PRINTED = ".jp-OutputArea-output pre";

// Zoom at which a page of the default size fills the screen.
export function zoomOf(size) {
  return Math.min(window.innerWidth / PAGE.width, window.innerHeight / PAGE.height) * size;
}

const isPicture = (cell) => Boolean(cell.node.querySelector(".jp-OutputArea-output img, canvas, .jupyter-widgets"))
  && !questionIn(cell.model.sharedModel.getSource());

// Fit the cells of a slide into pages; `show(cells)` shows only these, `show(cells, lines, step)` a number
// of lines of a derivation at a step. Layouts are slow: the largest size is tried first, which mostly
// fits, then the smallest, then those between.
// Returns [{cells, shrink, columns, figure, lines}].
export function pagesOf(page, notebook, slide, zoom, show) {
  const layoutAt = (cells, shrink, lines, step) => {
    show(cells, lines, step);
    const shown = cells.map((index) => notebook.widgets[index]);
    const place = shown.findIndex(isPicture);
    const beside = shown.length > 1 && shown.filter(isPicture).length === 1 // two would overlap
      && [0, shown.length - 1].includes(place);
    const layouts = (!beside ? COLUMNS.slice(0, 1) : place ? COLUMNS : PICTURE_FIRST)
      .map((columns) => grown(page, notebook, { cells, shrink, columns, figure: LETTERS / shrink }, zoom))
      .filter(Boolean);
    return layouts.length ? layouts.reduce((best, layout) => (layout.wide > best.wide ? layout : best)) : undefined;
  };
  const pages = [];
  for (let rest = [...slide]; rest.length;) {
    const layout = largest(layoutAt, rest) ?? part(layoutAt, rest, page, notebook, show, zoom);
    pages.push(layout);
    rest = rest.slice(layout.cells.length);
  }
  return pages;
}

// The layout with the largest text, at least three quarters.
function largest(layoutAt, cells) {
  const [first, ...others] = SHRINK;
  const low = others.pop();
  const found = layoutAt(cells, first);
  if (found) return found;
  let best = layoutAt(cells, low);
  let between = best ? others : [];
  while (between.length) {
    const middle = Math.floor(between.length / 2);
    const layout = layoutAt(cells, between[middle]);
    best = layout ?? best;
    between = layout ? between.slice(0, middle) : between.slice(middle + 1);
  }
  return best;
}

// As many cells as fit on a page; a cell that is too tall is shrunk.
function part(layoutAt, rest, page, notebook, show, zoom) {
  show(rest);
  layOut(page, notebook, { cells: rest, shrink: SHRINK.at(-1), columns: "", figure: 1 }, zoom);
  let room = page.clientHeight;
  let count = rest.findIndex((index) => (room -= notebook.widgets[index].node.offsetHeight) < 0);
  count = Math.max(1, count);
  let layout = largest(layoutAt, rest.slice(0, count));
  for (let more = layout; more && count + 1 < rest.length;) { // two columns may hold more
    more = layoutAt(rest.slice(0, ++count), SHRINK.at(-1));
    layout = more ?? layout;
  }
  while (!layout && --count) layout = largest(layoutAt, rest.slice(0, count));
  const tall = rest.slice(0, 1);
  layout ??= last(layoutAt, tall, notebook);
  for (const shrink of layout ? [] : SMALL) layout ??= layoutAt(tall, shrink);
  return layout ?? { cells: tall, shrink: SMALL.at(-1), columns: "", figure: 1 };
}

// For a derivation that is too long: the number of last lines that fit at every step.
function last(layoutAt, cells, notebook) {
  const steps = stepsOf(notebook.widgets[cells[0]]);
  for (let lines = steps - 1; lines > 0; lines--) {
    const positions = Array.from({ length: steps - lines + 1 }, (_, k) => lines + k);
    const layouts = positions.map((step) => layoutAt(cells, SHRINK.at(-1), lines, step));
    if (layouts.every(Boolean)) return { ...layouts[0], lines };
  }
}

// A layout with the largest possible figure, and the figure's width; undefined if it does not fit.
function grown(page, notebook, layout, zoom) {
  layOut(page, notebook, layout, zoom);
  if (!fits(page)) return undefined;
  const figures = inSight(page, FIGURE);
  let least = layout.figure, most = figures.length ? LARGEST : least;
  while (most - least > 0.1) {
    const middle = (least + most) / 2;
    page.style.setProperty("--slamlab-figure", middle);
    if (fits(page)) least = middle;
    else most = middle;
  }
  page.style.setProperty("--slamlab-figure", least);
  const wide = Math.max(0, ...figures.map((one) => one.getBoundingClientRect().width));
  return { ...layout, figure: least, wide };
}

// Apply size and zoom to the page, and columns to the cells.
export function layOut(page, notebook, { cells, shrink, columns, figure }, zoom) {
  const scale = zoom * shrink;
  page.style.setProperty("zoom", scale);
  page.style.setProperty("--slamlab-width", `${window.innerWidth / scale}px`);
  page.style.setProperty("--slamlab-height", `${window.innerHeight / scale}px`);
  page.style.setProperty("--slamlab-figure", figure);
  page.style.setProperty("--slamlab-columns", columns);
  page.classList.toggle("slamlab-columns", Boolean(columns));
  inSight(page, PRINTED).forEach((one) => shrinkPrinted(one, shrink));
  const first = isPicture(notebook.widgets[cells[0]]);
  for (const index of cells) {
    const cell = notebook.widgets[index];
    const picture = isPicture(cell);
    cell.node.classList.toggle("slamlab-picture", Boolean(columns) && picture);
    cell.node.classList.toggle("slamlab-right", Boolean(columns) && picture === !first);
  }
}

// Width of printed lines that do not break, relative to the slide's.
export function printedWidth(one) {
  one.style.whiteSpace = "pre";
  const wide = one.scrollWidth / one.clientWidth;
  one.style.whiteSpace = "";
  return wide;
}

// Make printed lines smaller if this keeps them whole.
function shrinkPrinted(one, shrink) {
  one.style.removeProperty("--slamlab-printed");
  const scale = 0.99 / printedWidth(one);
  if (scale < 0.99 && scale * shrink >= LETTERS) one.style.setProperty("--slamlab-printed", scale);
}

const isWhole = (one) => one.scrollWidth <= one.clientWidth + 1;

// wide formulas and tables scroll in a notebook, but not on a slide
const WIDE = ".jp-OutputArea-output, .jp-RenderedMarkdown, .cm-scroller";

// The text beside a picture that comes first: it is shown with it, so that half of the slide is not empty.
export const textBeside = (notebook, { cells, columns }) => columns && isPicture(notebook.widgets[cells[0]]) ? [cells[1]] : [];

// The cells of the slide on a page.
export const cellsOn = (page) => [...page.children].filter((one) => one.matches(".jp-Cell:not(.slamlab-off)"));

// Elements of a slide that match a selector; other cells are not searched.
const inSight = (page, selector) => cellsOn(page).flatMap((cell) => [...cell.querySelectorAll(selector)]);

// Whether a page fits the screen without clipping.
export function fits(page) {
  return page.scrollHeight <= page.clientHeight + 1 && isWhole(page) && inSight(page, WIDE).every(isWhole)
    && inSight(page, FIGURE).every((one) => isWhole(one.parentElement));
}
