// Time plots (panels of curves over time), below the map.

const PANEL = 92; // height of a panel of curves [px]

// title to curves, in order
function panels(list) {
  const found = new Map();
  for (const layer of list.filter(({ kind }) => kind == "curve")) {
    found.set(layer.panel, [...(found.get(layer.panel) ?? []), layer]);
  }
  return found;
}

// curves over time, the panel's upper edge at top
function panel(g, camera, title, curves, top, theme) {
  const [w] = camera.inner(), h = PANEL - 26, left = MARGIN.left;
  const box = [Infinity, -Infinity, 0, -Infinity];
  for (const { rows } of curves) {
    for (let i = 0; i < rows.length; i += 2) widen(box, rows[i], rows[i + 1]);
  }
  // fewer than two values give no range
  const begin = Number.isFinite(box[0]) ? box[0] : 0;
  const [t0, t1, low, high] = box[0] < box[1] ? box : [begin, begin + 1, 0, 1];
  const px = (t) => left + (t - t0) / (t1 - t0) * w;
  const py = (v) => top + h - (v - low) / ((high - low) || 1) * h;
  g.strokeStyle = theme.axis;
  g.lineWidth = 1;
  g.strokeRect(left + 0.5, top + 0.5, w - 1, h - 1);
  g.fillStyle = theme.ink;
  g.textBaseline = "middle";
  g.textAlign = "right";
  g.fillText(String(+high.toPrecision(2)), left - 5, top + 6);
  g.fillText(String(+low.toPrecision(2)), left - 5, top + h - 5);
  g.textBaseline = "top";
  g.fillText(`${t1.toFixed(0)} s`, left + w, top + h + 4);
  g.textAlign = "left";
  g.fillText(`${t0.toFixed(0)} s`, left, top + h + 4);
  g.textAlign = "center";
  g.fillText(title, left + w / 2, top + h + 4);
  g.lineWidth = 1.5;
  for (const { rows, colour } of curves) {
    g.strokeStyle = colour;
    g.beginPath();
    for (let i = 0; i < rows.length; i += 2) {
      if (Number.isFinite(rows[i + 1])) g.lineTo(px(rows[i]), py(rows[i + 1]));
    }
    g.stroke();
  }
}
