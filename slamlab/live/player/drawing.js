// Drawing (rendering) of layers on a canvas: grid, point cloud, track, covariance ellipses, legend.

const FONT = "12px system-ui, sans-serif", LINE = 18; // [px]

function grid(g, camera, theme) {
  const [w, h] = camera.inner();
  const raw = 50 / camera.scale, power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((n) => n * power).find((s) => s >= raw);
  const digits = Math.max(0, -Math.floor(Math.log10(step)));
  g.font = FONT;
  g.lineWidth = 1;
  const line = (at, horizontal) => {
    g.strokeStyle = Math.abs(at) < step / 2 ? theme.axis : theme.grid;
    g.beginPath();
    if (horizontal) {
      const y = Math.round(camera.py(at)) + 0.5;
      g.moveTo(MARGIN.left, y);
      g.lineTo(MARGIN.left + w, y);
    } else {
      const x = Math.round(camera.px(at)) + 0.5;
      g.moveTo(x, camera.top);
      g.lineTo(x, camera.top + h);
    }
    g.stroke();
  };
  const ticks = (low, high) => {
    const found = [];
    for (let n = Math.ceil(low / step); n * step <= high; n++) found.push(n * step);
    return found;
  };
  g.fillStyle = theme.ink;
  g.textBaseline = "top";
  g.textAlign = "center";
  for (const x of ticks(camera.wx(MARGIN.left), camera.wx(MARGIN.left + w))) {
    line(x, false);
    g.fillText(x.toFixed(digits), camera.px(x), camera.top + h + 4);
  }
  g.fillText("x [m]", MARGIN.left + w / 2, camera.top + h + 19);
  g.textBaseline = "middle";
  g.textAlign = "right";
  for (const y of ticks(camera.wy(camera.top + h), camera.wy(camera.top))) {
    line(y, true);
    g.fillText(y.toFixed(digits), MARGIN.left - 5, camera.py(y));
  }
  g.save();
  g.translate(9, camera.top + h / 2);
  g.rotate(-Math.PI / 2);
  g.textAlign = "center";
  g.fillText("y [m]", 0, 0);
  g.restore();
}

// point cloud, rasterised into pixels: a few ms for 100 000 points
function pointCloud(image, camera, ratio, layer) {
  const pixels = new Uint32Array(image.data.buffer), { width, height } = image;
  const rgb = parseInt(layer.colour.slice(1), 16);
  const value = ((255 << 24) | ((rgb & 255) << 16) | (rgb & 0xff00) | (rgb >> 16)) >>> 0;
  const size = Math.max(1, Math.round(ratio * (layer.rows.length > 4000 ? 1.5 : 2.5)));
  const scale = camera.scale * ratio, half = size / 2 - 0.5;
  const [mx, my] = camera.middle(), rows = layer.rows;
  const ox = mx * ratio - camera.x * scale - half, oy = my * ratio + camera.y * scale - half;
  for (let i = 0; i < rows.length; i += 2) {
    const x = Math.round(ox + rows[i] * scale), y = Math.round(oy - rows[i + 1] * scale);
    if (!(x >= 0 && y >= 0 && x + size <= width && y + size <= height)) continue;
    for (let v = y; v < y + size; v++) pixels.fill(value, v * width + x, v * width + x + size);
  }
}

const FEW_POINTS = 300; // up to this number points are drawn as discs

const DRAW = {
  points(g, camera, { rows, colour }) {
    g.fillStyle = colour;
    for (let i = 0; i < rows.length; i += 2) disc(g, camera.px(rows[i]), camera.py(rows[i + 1]), 3);
  },
  segments(g, camera, { rows, colour }) {
    g.strokeStyle = colour;
    g.lineWidth = 2;
    g.beginPath();
    for (let i = 0; i < rows.length; i += 4) {
      g.moveTo(camera.px(rows[i]), camera.py(rows[i + 1]));
      g.lineTo(camera.px(rows[i + 2]), camera.py(rows[i + 3]));
    }
    g.stroke();
  },
  poses(g, camera, { rows, colour }, radius) {
    g.strokeStyle = colour;
    g.lineWidth = 1.5;
    g.lineJoin = "round";
    g.beginPath();
    for (let i = 0; i < rows.length; i += 3) g.lineTo(camera.px(rows[i]), camera.py(rows[i + 1]));
    g.stroke();
    if (rows.length < 3) return;
    const [x, y, theta] = rows.subarray(rows.length - 3);
    const px = camera.px(x), py = camera.py(y), r = Math.max(radius * camera.scale, 8);
    g.lineWidth = 2.5;
    g.fillStyle = colour + "30";
    g.beginPath();
    g.arc(px, py, r, 0, 2 * Math.PI);
    g.fill();
    g.stroke();
    g.beginPath();
    g.moveTo(px, py);
    g.lineTo(px + 1.5 * r * Math.cos(theta), py - 1.5 * r * Math.sin(theta));
    g.stroke();
  },
  ellipses(g, camera, { rows, colour }) {
    g.strokeStyle = colour;
    g.lineWidth = 1.5;
    for (let i = 0; i < rows.length; i += 5) {
      const [x, y, a, b, angle] = rows.subarray(i, i + 5);
      g.beginPath();
      g.ellipse(camera.px(x), camera.py(y), a * camera.scale, b * camera.scale, -angle, 0, 2 * Math.PI);
      g.stroke();
    }
  },
  boxes(g, camera, { rows, colour }) {
    g.strokeStyle = colour;
    g.lineWidth = 1.5;
    for (let i = 0; i < rows.length; i += 4) {
      const [x0, x1, y0, y1] = rows.subarray(i, i + 4);
      g.strokeRect(camera.px(x0), camera.py(y1), (x1 - x0) * camera.scale, (y1 - y0) * camera.scale);
    }
  },
  samples(g, camera, { rows, colour }) {
    g.fillStyle = colour + "99";
    for (let i = 0; i < rows.length; i += 3) {
      const area = 2 + 6 * rows[i + 2];
      disc(g, camera.px(rows[i]), camera.py(rows[i + 1]), Math.sqrt(area / 2));
    }
  },
};

function disc(g, x, y, r) {
  g.beginPath();
  g.arc(x, y, r, 0, 2 * Math.PI);
  g.fill();
}

// one entry for each name and colour, with the markers of all its kinds; in rows above the picture.
// IN_LEGENDS maps names to labels (slamlab/views/colours.py)
function legend(g, camera, list) {
  const entries = new Map();
  for (const { name, colour, kind } of list) {
    const key = name + colour;
    if (!entries.has(key)) entries.set(key, { label: IN_LEGENDS.get(name) ?? name, colour, kinds: new Set() });
    const entry = entries.get(key);
    entry.kinds.add(kind);
    if (kind == "ellipses" && name != "walls") entry.label = `${IN_LEGENDS.get(name) ?? name} (95 % ellipse)`;
  }
  g.font = FONT;
  let x = MARGIN.left, y = 13;
  for (const entry of entries.values()) {
    const wide = 36 + g.measureText(entry.label).width + 16;
    if (x > MARGIN.left && x + wide > camera.width) [x, y] = [MARGIN.left, y + LINE];
    Object.assign(entry, { x, y });
    x += wide;
  }
  camera.top = y + 12;
  return [...entries.values()];
}

function mark(g, { label, colour, kinds, x, y }, theme) {
  g.strokeStyle = g.fillStyle = colour;
  g.lineWidth = 2;
  g.beginPath();
  if (["poses", "segments", "curve"].some((kind) => kinds.has(kind))) {
    g.moveTo(x + 2, y);
    g.lineTo(x + 28, y);
  }
  if (kinds.has("ellipses")) {
    g.moveTo(x + 26, y);
    g.ellipse(x + 15, y, 11, 6, 0, 0, 2 * Math.PI);
  }
  if (kinds.has("boxes")) g.rect(x + 5, y - 5, 20, 10);
  g.stroke();
  if (kinds.has("points") || kinds.has("samples")) disc(g, x + 15, y, 3.5);
  g.fillStyle = theme.ink;
  g.textAlign = "left";
  g.textBaseline = "middle";
  g.fillText(label, x + 34, y);
}

// aim(camera) sets the camera, after the height of the legend is known
function draw(canvas, camera, layers, theme, aim) {
  const ratio = window.devicePixelRatio || 1, shown = withColours(layers.visible, theme);
  const below = panels(shown), full = camera.height + PANEL * below.size;
  const wide = Math.round(camera.width * ratio), high = Math.round(full * ratio);
  if (canvas.width != wide || canvas.height != high) {
    Object.assign(canvas, { width: wide, height: high });
  }
  const g = canvas.getContext("2d");
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  g.fillStyle = theme.paper;
  g.fillRect(0, 0, camera.width, full);
  const entries = legend(g, camera, withColours(layers.named ?? layers.visible.filter(({ rows }) => rows.length), theme));
  aim(camera);
  grid(g, camera, theme);
  const [w, h] = camera.inner();
  const many = ({ kind, rows }) => kind == "points" && rows.length > 2 * FEW_POINTS;
  const clouds = shown.filter(many);
  g.save();
  g.beginPath();
  g.rect(MARGIN.left, camera.top, w, h);
  g.clip();
  let painted = false;
  const paint = () => {
    painted = true;
    const image = new ImageData(wide, high);
    for (const layer of clouds) pointCloud(image, camera, ratio, layer);
    const sheet = new OffscreenCanvas(wide, high);
    sheet.getContext("2d").putImageData(image, 0, 0);
    g.drawImage(sheet, 0, 0, camera.width, full);
  };
  for (const layer of shown) {
    if (!many(layer)) DRAW[layer.kind]?.(g, camera, layer, layers.header.radius);
    else if (!painted) paint(); // all clouds at once, at the first one's place in the order
  }
  g.restore();
  g.strokeStyle = theme.axis;
  g.lineWidth = 1;
  g.strokeRect(MARGIN.left + 0.5, camera.top + 0.5, w - 1, h - 1);
  for (const entry of entries) mark(g, entry, theme);
  let top = camera.height + 4;
  for (const [title, curves] of below) {
    panel(g, camera, title, curves, top, theme);
    top += PANEL;
  }
}

const withColours = (list, { paper }) =>
  list.map((layer) => ({ ...layer, colour: legible(layer.colour, paper) }));
