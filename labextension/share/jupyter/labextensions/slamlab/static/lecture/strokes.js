// Strokes of ink: {id, tool, colour, width, anchor, points: [[x, y, pressure]]}, in units of their anchor.

const SVG = "http://www.w3.org/2000/svg";
const LEVELS = 8; // levels of pressure

export function svg(tag, attributes = {}) {
  const made = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  return made;
}

const rounded = (number) => Math.round(10 * number) / 10;

// A stroke from points of the window, relative to an anchor's position.
export function strokeOf({ tool, colour, width }, anchor, { x, y, scale }, points) {
  return {
    id: crypto.randomUUID(),
    tool,
    colour,
    width: rounded(width / scale),
    anchor,
    points: points.map(([px, py, pressure]) => [rounded((px - x) / scale), rounded((py - y) / scale), rounded(pressure)]),
  };
}

// A stroke as a group of paths: one, or one for each run of the same pressure.
export function drawn({ id, tool, colour, width, points }) {
  const group = svg("g", { class: `slamlab-stroke slamlab-${tool}`, "data-stroke": id, "data-colour": colour });
  for (const run of runs(points)) {
    const thick = tool === "pen" ? 2 * width * run.pressure : width;
    group.append(svg("path", { d: pathOf(run.points), "stroke-width": rounded(thick) || width }));
  }
  return group;
}

function runs(points) {
  const found = [];
  for (const [x, y, pressure] of points) {
    const level = Math.max(1, Math.round(LEVELS * pressure)) / LEVELS;
    const last = found.at(-1);
    if (last) last.points.push([x, y]); // the next run begins where this one ends
    if (last?.pressure !== level) found.push({ pressure: level, points: [[x, y]] });
  }
  return found.filter((run) => run.points.length > 1 || found.length === 1);
}

// A smooth path: quadratic curves between midpoints with the points as control points; one point is a dot.
export function pathOf(points) {
  const [[x, y], ...rest] = points;
  if (!rest.length) return `M${x} ${y}h0`;
  const curves = rest.slice(0, -1).map(([px, py], k) => {
    const [qx, qy] = rest[k + 1];
    return `Q${px} ${py} ${rounded((px + qx) / 2)} ${rounded((py + qy) / 2)}`;
  });
  return `M${x} ${y}${curves.join("")}L${rest.at(-1)[0]} ${rest.at(-1)[1]}`;
}

// Whether a stroke passes a point of the window within some pixels.
export function passes({ points, width }, { x, y, scale }, [px, py], reach) {
  const at = [(px - x) / scale, (py - y) / scale];
  const near = reach / scale + width / 2;
  return points.some((point, k) => distance(at, points[k - 1] ?? point, point) <= near);
}

function distance([px, py], [ax, ay], [bx, by]) {
  const along = (bx - ax) ** 2 + (by - ay) ** 2;
  const t = along ? Math.min(1, Math.max(0, ((px - ax) * (bx - ax) + (py - ay) * (by - ay)) / along)) : 0;
  return Math.hypot(px - ax - t * (bx - ax), py - ay - t * (by - ay));
}

// Whether data of a file is a stroke.
export function isStroke(one) {
  const { id, tool, colour, width, anchor, points } = one ?? {};
  return [id, tool, colour, anchor?.cell].every((text) => typeof text === "string")
    && ["picture", "text"].includes(anchor.kind) && Number.isInteger(anchor.nth) && width > 0
    && Array.isArray(points) && points.length > 0
    && points.every((point) => Array.isArray(point) && point.length === 3 && point.every(Number.isFinite));
}
