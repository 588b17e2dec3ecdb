// Anchors of ink: a picture or a block of text of a cell, so that ink moves with it when the layout of
// the slide changes.

const PICTURE = "img, canvas, .jp-RenderedSVG svg";
const TEXT = "h1, h2, h3, p, li, table, pre, mjx-container[display=true], .slamlab-telling, .jp-OutputArea-output";
const UNITS = 1000; // of a picture's width

const isSeen = (box) => box.width > 0 && box.height > 0;
const kinds = { picture: PICTURE, text: TEXT };

// The element of a slide nearest to a point of the window: {cell, kind, nth}; null if there is none.
export function anchorAt(deck, [x, y]) {
  let best = null, nearest = Infinity;
  for (const index of deck.shown.cells) {
    const { node, model } = deck.notebook.widgets[index];
    if (node.classList.contains("slamlab-later")) continue;
    for (const [kind, selector] of Object.entries(kinds)) {
      node.querySelectorAll(selector).forEach((element, nth) => {
        const box = element.getBoundingClientRect();
        if (!isSeen(box) || element.closest(".slamlab-later")) return;
        const away = Math.hypot(Math.max(box.left - x, 0, x - box.right), Math.max(box.top - y, 0, y - box.bottom));
        const near = away + 1e-7 * box.width * box.height; // if two contain the point, the smaller one
        if (near < nearest) [nearest, best] = [near, { cell: model.id, kind, nth }];
      });
    }
  }
  return best;
}

// Position of an anchor: {x, y, scale}, its corner in the window and pixels for a unit; null if it is hidden.
export function placeOf(deck, { cell, kind, nth }) {
  const index = deck.shown.cells.find((one) => deck.notebook.widgets[one].model.id === cell);
  if (index === undefined) return null;
  const { node } = deck.notebook.widgets[index];
  const element = node.querySelectorAll(kinds[kind])[nth];
  if (!element || element.closest(".slamlab-later")) return null;
  const box = element.getBoundingClientRect();
  if (!isSeen(box)) return null;
  // a picture is scaled as a whole; text has the scale of the page
  const scale = kind === "picture" ? box.width / UNITS : parseFloat(deck.page.style.zoom);
  return { x: box.left, y: box.top, scale };
}
