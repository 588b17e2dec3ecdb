// Picture of layers on a page: title, canvas, status line. Wheel, drag and "fit" move the camera;
// the wheel scrolls the page unless the canvas has the focus or Ctrl is held, and so does a finger.

const MIN_HEIGHT = 300; // of the map on a narrow page, at most its width [px]
const MOVED_BY = "Show everything (Ctrl with the wheel zooms; dragging moves the picture; "
  + "after a click, the wheel alone zooms)";

class Picture {
  // layers to draw; aim(camera) sets the camera before drawing, box() is the region that "fit" shows
  constructor({ width, height, title, alt }, layers, theme, aim, box) {
    this.camera = new Camera(width, height);
    Object.assign(this, { size: [width, height], layers, aim, box, onPainted: () => {} });
    const head = element("div", {}, { className: "slamlab-head", textContent: title });
    const bar = element("div", {}, { className: "slamlab-under" });
    this.status = element("div", {}, { className: "slamlab-status" });
    const fit = element("button", {}, { type: "button", textContent: "fit", title: MOVED_BY });
    this.canvas = element("canvas", {}, { tabIndex: 0 });
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", alt);
    this.root = element("div", { maxWidth: `${width}px` }, { className: "slamlab-live" });
    bar.append(this.status, fit);
    this.root.append(head, this.canvas, bar);
    this.scheduled = false;
    fit.addEventListener("click", () => this.fitAll());
    this.listen(this.canvas);
    this.resized = new ResizeObserver(() => this.repaint());
    this.resized.observe(this.canvas);
    this.applyTheme(theme);
  }

  // apply a theme; the style sheet uses its colours
  applyTheme(theme) {
    this.theme = theme;
    for (const name in theme) this.root.style.setProperty(`--slamlab-${name}`, theme[name]);
    this.repaint();
  }

  repaint() {
    if (!this.scheduled) requestAnimationFrame(() => this.paint());
    this.scheduled = true;
  }

  paint() {
    this.scheduled = false;
    const [width, height] = this.size, wide = this.canvas.clientWidth || width;
    this.camera.width = wide;
    this.camera.height = Math.max(Math.round(wide * height / width), Math.min(wide, MIN_HEIGHT));
    draw(this.canvas, this.camera, this.layers, this.theme, this.aim);
    this.status.textContent = this.layers.header.status;
    this.onPainted();
  }

  fitAll() {
    this.camera.fitted = true;
    this.camera.fit(this.box());
    this.repaint();
  }

  listen(canvas) {
    canvas.addEventListener("wheel", (event) => {
      if (!event.ctrlKey && !canvas.matches(":focus")) return;
      event.preventDefault();
      const [x, y] = onCanvas(canvas, event);
      this.camera.zoom(Math.exp(-0.0015 * event.deltaY), x, y);
      this.repaint();
    }, { passive: false });
    canvas.addEventListener("pointerdown", (event) => {
      if (event.pointerType != "touch") canvas.focus({ preventScroll: true });
      canvas.setPointerCapture(event.pointerId);
      canvas.style.cursor = "grabbing";
    });
    // a tap, not a scroll
    canvas.addEventListener("click", () => canvas.focus({ preventScroll: true }));
    for (const end of ["pointerup", "pointercancel"]) {
      canvas.addEventListener(end, () => { canvas.style.cursor = ""; });
    }
    canvas.addEventListener("pointermove", (event) => {
      const scrolls = event.pointerType == "touch" && !canvas.matches(":focus");
      if (!event.buttons || scrolls) return;
      const [, , enlarged] = onCanvas(canvas, event);
      this.camera.pan(event.movementX / enlarged, event.movementY / enlarged);
      this.repaint();
    });
    canvas.addEventListener("dblclick", () => this.fitAll());
  }

  close() {
    this.resized.disconnect();
  }
}
