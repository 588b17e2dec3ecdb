// Layers of frames (decoded incrementally), and the camera: world to pixels, zoom, pan.

const MARGIN = { left: 46, right: 10, bottom: 34 }; // [px]; above stands the legend

class Layers {
  constructor() {
    this.list = [];
    this.header = null;
    this.hidden = new Set(); // names of layers that the reader has hidden
  }

  get visible() {
    return this.list.filter(({ name }) => !this.hidden.has(name));
  }

  // decode a frame: keep old rows, add new ones from its numbers
  receive(header, numbers) {
    const before = new Map(this.list.map((layer) => [layer.key, layer]));
    let at = 0;
    this.list = header.layers.map((entry) => {
      const had = before.get(entry.key);
      const store = had ?? { data: entry.room ?? new Float32Array(0) };
      const start = entry.keep * entry.width, end = start + entry.follow * entry.width;
      if (store.data.length < end) {
        // with spare capacity: most layers get a few rows each frame
        const grown = new Float32Array(2 * end);
        grown.set(store.data.subarray(0, start));
        store.data = grown;
      }
      store.data.set(numbers.subarray(at, at + end - start), start);
      at += end - start;
      return { ...entry, data: store.data, rows: store.data.subarray(0, end) };
    });
    this.header = header;
  }

  bounds() {
    const box = nowhere();
    for (const { kind, width, rows } of this.visible) surround(box, kind, width, rows);
    return somewhere(box);
  }
}

// numbers of a message, copied so that they are aligned
function floats(view) {
  return new Float32Array(view.buffer.slice(view.byteOffset, view.byteOffset + view.byteLength));
}

const nowhere = () => [Infinity, -Infinity, Infinity, -Infinity];
const somewhere = (box) => (box[0] <= box[1] ? box : [-1, 1, -1, 1]);

// widen a box by a layer's rows
function surround(box, kind, width, rows) {
  if (kind == "curve") return;
  for (let i = 0; i < rows.length; i += width) {
    if (kind == "segments") {
      widen(box, rows[i], rows[i + 1]);
      widen(box, rows[i + 2], rows[i + 3]);
    } else if (kind == "boxes") {
      widen(box, rows[i], rows[i + 2]);
      widen(box, rows[i + 1], rows[i + 3]);
    } else {
      widen(box, rows[i], rows[i + 1]);
    }
  }
}

function widen(box, x, y) {
  if (!Number.isFinite(x) || !Number.isFinite(y)) return;
  if (x < box[0]) box[0] = x;
  if (x > box[1]) box[1] = x;
  if (y < box[2]) box[2] = y;
  if (y > box[3]) box[3] = y;
}

// position of a pointer in the canvas' own pixels, and the scale of the page
function onCanvas(canvas, event) {
  const box = canvas.getBoundingClientRect();
  const enlarged = box.width / canvas.clientWidth || 1;
  return [(event.clientX - box.left) / enlarged, (event.clientY - box.top) / enlarged, enlarged];
}

// view transform from metres to pixels
class Camera {
  constructor(width, height) {
    Object.assign(this, { width, height, top: 25, x: 0, y: 0, scale: 50, fitted: true, run: null });
  }

  inner() {
    return [this.width - MARGIN.left - MARGIN.right, this.height - this.top - MARGIN.bottom];
  }

  middle() {
    const [w, h] = this.inner();
    return [MARGIN.left + w / 2, this.top + h / 2];
  }

  px(x) { return this.middle()[0] + (x - this.x) * this.scale; }
  py(y) { return this.middle()[1] - (y - this.y) * this.scale; }
  wx(px) { return this.x + (px - this.middle()[0]) / this.scale; }
  wy(py) { return this.y - (py - this.middle()[1]) / this.scale; }

  fit([x0, x1, y0, y1]) {
    const [w, h] = this.inner();
    this.x = (x0 + x1) / 2;
    this.y = (y0 + y1) / 2;
    this.scale = Math.min(w / Math.max(x1 - x0, 1), h / Math.max(y1 - y0, 1)) / 1.12;
  }

  // follow a growing map in steps, not with every frame
  follow(box, run) {
    const [w, h] = this.inner(), fresh = run !== this.run;
    this.run = run;
    if (!this.fitted && !fresh) return;
    const half = [w / 2 / this.scale, h / 2 / this.scale];
    const outside = box[0] < this.x - half[0] || box[1] > this.x + half[0]
      || box[2] < this.y - half[1] || box[3] > this.y + half[1];
    if (fresh || outside) {
      this.fitted = true;
      this.fit(box);
      if (!fresh) this.scale *= 0.92;
    }
  }

  zoom(factor, px, py) {
    const x = this.wx(px), y = this.wy(py);
    this.scale = Math.min(Math.max(this.scale * factor, 0.01), 1e5);
    this.x += x - this.wx(px);
    this.y += y - this.wy(py);
    this.fitted = false;
  }

  pan(dx, dy) {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
    this.fitted = false;
  }
}
