// A slide fills the screen: its page is zoomed, laid out in one column or two, or parted into pages.

import { stepsOf } from "./stops.js";

export const PAGE = { width: 960, height: 540 }; // pixels of a page that is neither zoomed nor shrunk
const SHRINK = [1, 0.94, 0.88, 0.82, 0.76]; // below three quarters letters are too small for a hall
const SMALL = [0.7, 0.6, 0.5, 0.4, 0.3]; // for one cell that is too tall: better small than cut off
// one column, or text beside the one thing that is to be seen
const COLUMNS = ["", "minmax(0, 1fr) minmax(0, 1fr)", "minmax(0, 2fr) minmax(0, 3fr)"];
const LETTERS = 0.75; // a figure's own letters may shrink to this part of their size
const LARGEST = 4; // times a figure grows
const FIGURE = "img.slamlab-figure";

// The zoom at which a page of the usual size fills the screen.
export function zoomOf(size) {
  return Math.min(window.innerWidth / PAGE.width, window.innerHeight / PAGE.height) * size;
}

const isPicture = (cell) => Boolean(cell.node.querySelector(".jp-OutputArea-output img, canvas, .jupyter-widgets"));

// Fit the cells of a slide into pages; `show(cells)` shows just these, `show(cells, lines, step)` of a
// derivation as many lines at this step. Layouts cost time: the largest letters are tried first, which
// mostly fit, then the smallest, then those between.
// Returns [{cells, shrink, columns, figure, lines}].
export function pagesOf(page, notebook, slide, zoom, show) {
  const wayAt = (cells, shrink, lines, step) => {
    show(cells, lines, step);
    const shown = cells.map((index) => notebook.widgets[index]);
    const beside = shown.length > 1 && shown.filter(isPicture).length === 1; // two would lie on each other
    const ways = (beside ? COLUMNS : COLUMNS.slice(0, 1))
      .map((columns) => grown(page, notebook, { cells, shrink, columns, figure: LETTERS / shrink }, zoom))
      .filter(Boolean);
    return ways.length ? ways.reduce((best, way) => (way.wide > best.wide ? way : best)) : undefined;
  };
  const pages = [];
  for (let rest = [...slide]; rest.length;) {
    const way = largest(wayAt, rest) ?? part(wayAt, rest, page, notebook, show, zoom);
    pages.push(way);
    rest = rest.slice(way.cells.length);
  }
  return pages;
}

// The way with the largest letters, none below three quarters.
function largest(wayAt, cells) {
  const [first, ...others] = SHRINK;
  const low = others.pop();
  const found = wayAt(cells, first);
  if (found) return found;
  let best = wayAt(cells, low);
  let between = best ? others : [];
  while (between.length) {
    const middle = Math.floor(between.length / 2);
    const way = wayAt(cells, between[middle]);
    best = way ?? best;
    between = way ? between.slice(0, middle) : between.slice(middle + 1);
  }
  return best;
}

// As many cells as fit on a page of their own; one that is too tall is made small.
function part(wayAt, rest, page, notebook, show, zoom) {
  show(rest);
  layOut(page, notebook, { cells: rest, shrink: SHRINK.at(-1), columns: "", figure: 1 }, zoom);
  let room = page.clientHeight;
  let count = rest.findIndex((index) => (room -= notebook.widgets[index].node.offsetHeight) < 0);
  count = Math.max(1, count);
  let way = largest(wayAt, rest.slice(0, count));
  for (let more = way; more && count + 1 < rest.length;) { // two columns may hold more
    more = wayAt(rest.slice(0, ++count), SHRINK.at(-1));
    way = more ?? way;
  }
  while (!way && --count) way = largest(wayAt, rest.slice(0, count));
  const tall = rest.slice(0, 1);
  way ??= last(wayAt, tall, notebook);
  for (const shrink of way ? [] : SMALL) way ??= wayAt(tall, shrink);
  return way ?? { cells: tall, shrink: SMALL.at(-1), columns: "", figure: 1 };
}

// For a derivation that is too long: as many of its last lines as fit at every step.
function last(wayAt, cells, notebook) {
  const steps = stepsOf(notebook.widgets[cells[0]]);
  for (let lines = steps - 1; lines > 0; lines--) {
    const positions = Array.from({ length: steps - lines + 1 }, (_, k) => lines + k);
    const ways = positions.map((step) => wayAt(cells, SHRINK.at(-1), lines, step));
    if (ways.every(Boolean)) return { ...ways[0], lines };
  }
}

// A way with its figure as large as it can be, and how wide that is; undefined if it does not fit.
function grown(page, notebook, way, zoom) {
  layOut(page, notebook, way, zoom);
  if (!fits(page)) return undefined;
  const figures = inSight(page, FIGURE);
  let least = way.figure, most = figures.length ? LARGEST : least;
  while (most - least > 0.1) {
    const middle = (least + most) / 2;
    page.style.setProperty("--slamlab-figure", middle);
    if (fits(page)) least = middle;
    else most = middle;
  }
  page.style.setProperty("--slamlab-figure", least);
  const wide = Math.max(0, ...figures.map((one) => one.getBoundingClientRect().width));
  return { ...way, figure: least, wide };
}

// Give the page its size and zoom, and the cells their columns.
export function layOut(page, notebook, { cells, shrink, columns, figure }, zoom) {
  const scale = zoom * shrink;
  page.style.setProperty("zoom", scale);
  page.style.setProperty("--slamlab-width", `${window.innerWidth / scale}px`);
  page.style.setProperty("--slamlab-height", `${window.innerHeight / scale}px`);
  page.style.setProperty("--slamlab-figure", figure);
  page.style.setProperty("--slamlab-columns", columns);
  page.classList.toggle("slamlab-columns", Boolean(columns));
  for (const index of cells) {
    const cell = notebook.widgets[index];
    cell.node.classList.toggle("slamlab-right", Boolean(columns) && isPicture(cell));
  }
}

const isWhole = (one) => one.scrollWidth <= one.clientWidth + 1;

// wide formulas and tables scroll in a notebook; on a slide nobody can
const WIDE = ".jp-OutputArea-output, .jp-RenderedMarkdown, .cm-scroller";

// The cells of the slide on a page.
export const cellsOn = (page) => [...page.children].filter((one) => one.matches(".jp-Cell:not(.slamlab-off)"));

// What fits a selector on a slide: all other cells of the notebook, which may be many, are not looked through.
const inSight = (page, selector) => cellsOn(page).flatMap((cell) => [...cell.querySelectorAll(selector)]);

// Whether nothing of a page is cut off.
export function fits(page) {
  return page.scrollHeight <= page.clientHeight + 1 && isWhole(page) && inSight(page, WIDE).every(isWhole)
    && inSight(page, FIGURE).every((one) => isWhole(one.parentElement));
}
