// What `slamlab handout` asks: every page of the deck, as shown at its last stop, as a leaf of one
// document that the browser prints. Text stays text, ink stays lines; a canvas becomes a picture.

const drawn = () => new Promise((resolve) => { requestAnimationFrame(resolve); });

// Put a leaf for every page of the deck in place of all that is shown; how many there are.
export async function leaves(panel, { notes, ink }) {
  const deck = panel.slamlabDeck, book = document.createElement("main");
  book.className = "slamlab-book";
  if (ink) await inkShown(deck);
  for (deck.go(0); ; deck.next()) {
    const { slide, shown } = deck, next = deck.stops[deck.at + 1];
    if (next?.slide === slide && shown.cells.includes(next.cell)) continue; // more comes to this page
    await drawn();
    await drawn(); // what changes its size is laid out anew
    const leaf = leafOf(deck);
    if (notes && next?.slide !== slide) leaf.append(...notesOf(deck, slide));
    book.append(leaf);
    if (!next) break;
  }
  const size = { width: window.innerWidth, height: window.innerHeight };
  deck.end();
  // the theme's sheets hang in the body, too
  for (const one of [...document.body.children]) if (!["LINK", "STYLE"].includes(one.tagName)) one.remove();
  document.body.append(book);
  document.head.append(style(size, notes));
  await Promise.all([...book.querySelectorAll("img")].map((one) => one.decode().catch(() => {})));
  return book.children.length;
}

// Strokes come from a file, a while after the deck; whether they came.
async function inkShown(deck) {
  for (let wait = 0; wait < 600 && !deck.layer.querySelector(".slamlab-stroke"); wait++) await drawn();
}

function leafOf(deck) {
  let slide = deck.page.cloneNode(false);
  slide.append(...deck.shown.cells.map((index) => copyOf(deck.notebook.widgets[index].node)));
  for (let room = deck.page.parentElement; deck.panel.node.contains(room); room = room.parentElement) {
    const around = room.cloneNode(false);
    around.append(slide);
    slide = around;
  }
  slide.removeAttribute("popover");
  const ink = deck.layer.querySelector(".slamlab-ink"), layer = deck.layer.cloneNode(false);
  if (ink) layer.append(ink.cloneNode(true));
  slide.append(layer);
  const leaf = document.createElement("section");
  leaf.append(slide);
  return leaf;
}

// A copy of a canvas is empty: it becomes a picture.
function copyOf(cell) {
  const copy = cell.cloneNode(true), copies = [...copy.querySelectorAll("canvas")];
  cell.querySelectorAll("canvas").forEach((canvas, k) => {
    const picture = Object.assign(new Image(), { src: canvas.toDataURL() });
    picture.style.cssText = `${canvas.style.cssText}; width: ${canvas.clientWidth}px; height: ${canvas.clientHeight}px`;
    copies[k].replaceWith(picture);
  });
  return copy;
}

// The speaker's notes that stand between a slide and the next one.
function notesOf(deck, slide) {
  const from = deck.slides[slide].cells[0], to = deck.slides[slide + 1]?.cells[0] ?? Infinity;
  return deck.notebook.widgets
    .filter(({ model }, index) => index >= from && index < to && model.getMetadata("slideshow")?.slide_type === "notes")
    .map(({ node }) => {
      const note = document.createElement("aside");
      note.append(node.querySelector(".jp-RenderedMarkdown").cloneNode(true));
      return note;
    });
}

function style({ width, height }, notes) {
  const sheet = document.createElement("style");
  const [w, h] = [`${width}px !important`, `${height}px !important`];
  sheet.textContent = `
    @page { size: ${width}px ${notes ? Math.round(width * Math.SQRT2) : height}px; margin: 0; }
    html, body { overflow: visible !important; height: auto !important; position: static !important; background: #ffffff; }
    .slamlab-book section { break-after: page; }
    .slamlab-book section:last-child { break-after: auto; }
    .slamlab-book .slamlab-deck, .slamlab-book .slamlab-deck > .jp-Notebook { position: relative !important; width: ${w}; height: ${h}; display: block; }
    .slamlab-book .slamlab-layer { position: absolute; }
    .slamlab-book aside { padding: 24px 72px; --jp-content-font-size1: 22px; font-size: 22px; }`;
  return sheet;
}
