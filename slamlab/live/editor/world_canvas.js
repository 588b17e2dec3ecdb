// World editor in the browser: points are handles, dragged (drag and drop) or moved by the arrow
// keys. A change is drawn at once and sent to the kernel, which answers with a new scan.

const SNAP = 0.05, FINE_SNAP = 0.01; // grid spacing [m]; with Shift
const MAX_HANDLES = 200; // more would cover the world
const EDIT_PAUSE = 1000; // [ms] between two keys that count as two changes for undo
const ARROWS = { ArrowUp: [0, 1], ArrowDown: [0, -1], ArrowLeft: [-1, 0], ArrowRight: [1, 0] };
const HINT = "Drag a point, or select it with Tab and move it with the arrow keys; "
  + `grid ${SNAP} m, finer with Shift; Ctrl+Z: undo`;

const snapped = (value, step) => Number((Math.round(value / step) * step).toFixed(6)) + 0;

// points of a world and what they belong to; ends at the same position are one point
function points({ walls, circles }) {
  const found = new Map();
  walls.forEach((wall, row) => [0, 2].forEach((at) => {
    const key = `${wall[at]} ${wall[at + 1]}`;
    if (!found.has(key)) found.set(key, []);
    found.get(key).push({ kind: "walls", row, at });
  }));
  const centres = circles.map((_, row) => [{ kind: "circles", row, at: 0 }]);
  return [...found.values(), ...centres];
}

function nameOf(ends) {
  const numbers = ends.map(({ row }) => row + 1).join(", ");
  if (ends[0].kind == "circles") return `centre of circle ${numbers}`;
  return ends.length > 1 ? `corner of walls ${numbers}` : `end of wall ${numbers}`;
}

function positionOf(world, [{ kind, row, at }]) {
  return world[kind][row].slice(at, at + 2);
}

// the world with a point moved, or null if a wall would have no length
function moved(world, ends, [x, y], edit) {
  const next = { walls: world.walls.map((row) => [...row]), circles: [...world.circles], edit };
  for (const { kind, row, at } of ends) {
    next[kind][row] = [...next[kind][row]];
    next[kind][row].splice(at, 2, x, y);
  }
  const whole = ([x1, y1, x2, y2]) => x1 != x2 || y1 != y2;
  return next.walls.every(whole) ? next : null;
}

function layersOf(model, { walls, circles }) {
  const { walls: grey, scan, robot } = model.get("colours");
  const rings = circles.map(([x, y, r]) => [x, y, r, r, 0]);
  const bytes = model.get("scan");
  const points = new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
  const layer = (kind, name, colour, width, rows) =>
    ({ kind, name, colour, width, rows: Float32Array.from(rows) });
  return Object.assign(new Layers(), {
    header: { radius: model.get("radius") },
    list: [
      layer("segments", "walls", grey, 4, walls.flat()),
      layer("ellipses", "walls", grey, 5, rings.flat()),
      layer("points", "scan", scan, 2, points),
      layer("poses", "robot", robot, 3, [0, 0, 0]),
    ].filter(({ rows }) => rows.length),
  });
}

function render({ model, el }) {
  const width = model.get("width"), height = model.get("height");
  const canvas = element("canvas", {});
  const sheet = element("div", {}, { className: "slamlab-world-canvas" });
  const status = element("div", {});
  const root = element("div", { width: `${width}px`, maxWidth: "100%" });
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", model.get("alt"));
  sheet.setAttribute("role", "group");
  sheet.setAttribute("aria-label", "Movable points");
  status.setAttribute("role", "status");
  status.className = "slamlab-world-canvas-status";
  sheet.append(canvas);
  root.append(sheet, status);
  el.append(root);

  const camera = new Camera(width, height);
  let world = model.get("world"), handles = [], dragged = null, due = false, theme;

  const paint = () => {
    due = false;
    camera.width = canvas.clientWidth || width;
    camera.height = Math.round(camera.width * height / width);
    const layers = layersOf(model, world);
    draw(canvas, camera, layers, theme, () => {
      // the view stays fixed during a drag
      if (!dragged) camera.follow(layers.bounds(), 0);
    });
    for (const { button, ends } of handles) {
      const [x, y] = positionOf(world, ends), name = nameOf(ends);
      Object.assign(button.style, { left: `${camera.px(x)}px`, top: `${camera.py(y)}px` });
      button.title = `${name}: x ${x}, y ${y} m`;
      button.setAttribute("aria-label", button.title);
    }
  };
  const repaint = () => {
    if (!due) requestAnimationFrame(paint);
    due = true;
  };

  const applyTheme = () => {
    theme = jupyterTheme();
    status.style.color = theme.ink;
    repaint();
  };

  const showPosition = ({ ends }) => {
    const [x, y] = positionOf(world, ends);
    status.textContent = `${nameOf(ends)}: x ${x}, y ${y} m`;
  };
  const put = (handle, at, edit) => {
    const next = moved(world, handle.ends, at, edit);
    if (!next) return;
    world = next;
    model.set("world", world);
    model.save_changes(); // it waits until the kernel has handled the last change
    showPosition(handle);
    repaint();
  };

  // one handle for each point; points moved to the same position are merged
  const arrange = () => {
    const now = points(world), key = (ends) => ends.map(({ kind, row, at }) => `${kind}${row}.${at}`).join();
    if (now.length > MAX_HANDLES) now.length = 0;
    status.textContent = now.length ? HINT : "Too many points to drag: edit the rows.";
    if (now.map(key).join(";") != handles.map(({ ends }) => key(ends)).join(";")) {
      handles.forEach(({ button }) => button.remove());
      handles = now.map(handle);
    }
    repaint();
  };

  const handle = (ends) => {
    const button = element("button", {}, { className: "slamlab-handle", type: "button" });
    // otherwise the notebook would handle the arrow keys
    button.dataset.lmSuppressShortcuts = "true";
    const made = { button, ends };
    let edit = 0, last = 0;
    button.addEventListener("pointerdown", (event) => {
      if (event.button) return;
      event.preventDefault(); // no selection of text; the focus has to be set explicitly
      button.focus({ preventScroll: true });
      button.setPointerCapture(event.pointerId);
      [dragged, edit] = [made, Date.now()];
    });
    button.addEventListener("pointermove", (event) => {
      if (dragged != made) return;
      const step = event.shiftKey ? FINE_SNAP : SNAP;
      const [left, top] = onCanvas(canvas, event);
      const x = camera.wx(left), y = camera.wy(top);
      put(made, [snapped(x, step), snapped(y, step)], edit);
    });
    for (const end of ["pointerup", "pointercancel"]) {
      button.addEventListener(end, () => {
        dragged = null;
        repaint();
      });
    }
    button.addEventListener("keydown", (event) => {
      if (!(event.key in ARROWS) || event.ctrlKey || event.altKey || event.metaKey) return;
      event.preventDefault();
      event.stopPropagation();
      const now = Date.now(), step = event.shiftKey ? FINE_SNAP : SNAP;
      if (now - last > EDIT_PAUSE) edit = now;
      last = now;
      const at = positionOf(world, ends).map((value, axis) => {
        const direction = ARROWS[event.key][axis];
        return direction ? snapped(value + direction * step, step) : value;
      });
      put(made, at, edit);
    });
    button.addEventListener("focus", () => showPosition(made));
    // after the focus has moved
    button.addEventListener("blur", () => setTimeout(settle));
    sheet.append(button);
    return made;
  };
  const settle = () => {
    if (!sheet.contains(document.activeElement)) arrange();
  };

  const worldChanged = () => {
    if (model.get("world") === world) return;
    world = model.get("world");
    arrange();
  };
  root.addEventListener("keydown", (event) => {
    if (event.key != "z" || !(event.ctrlKey || event.metaKey)) return;
    event.preventDefault();
    event.stopPropagation();
    model.send({ kind: "undo" });
  });
  model.on("change:world", worldChanged);
  model.on("change:scan", repaint);
  const resized = new ResizeObserver(repaint);
  resized.observe(canvas);
  const forget = onJupyterTheme(applyTheme);
  applyTheme();
  arrange();
  return () => {
    forget();
    model.off("change:world", worldChanged);
    model.off("change:scan", repaint);
    resized.disconnect();
  };
}

export default { render };
