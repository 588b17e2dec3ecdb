// Canvas of the live view in the browser: keeps the rows that frames bring, draws them in equal
// scale, acknowledges each frame by its number when it is drawn (back-pressure), sends driving keys.

// keyboard driving (teleoperation): key to command
const KEYS = {
  ArrowUp: "forward", ArrowDown: "back", ArrowLeft: "left", ArrowRight: "right", " ": "stop",
};

export default () => {
  const layers = new Layers();
  const views = new Set();
  let drawn = 0, driving = false;

  return {
    initialize({ model }) {
      const { header, rows } = model.get("frame");
      layers.receive(header, rows);
      drawn = header.number; // came with the widget: nobody waits for an answer
      model.on("msg:custom", (header, buffers) => {
        if (header?.kind != "frame") return;
        layers.receive(header, buffers[0]);
        for (const view of views) view();
      });
    },

    render({ model, el }) {
      const head = element("div", { ...TEXT, fontWeight: "600", padding: "2px 0" });
      const bar = element("div", { ...TEXT, display: "flex", gap: "8px", marginTop: "4px" });
      const status = element("div", { flex: "1", padding: "4px 0" }, { className: "slamlab-status" });
      const fit = element("button", {
        font: "inherit", color: "inherit", background: "none", padding: "2px 10px", cursor: "pointer",
        border: "1px solid var(--jp-border-color1, #bbb)", borderRadius: "2px",
      }, { textContent: "fit", title: "show all (wheel and drag move the picture)" });
      const canvas = element("canvas", {
        display: "block", width: "100%", touchAction: "none", borderRadius: "3px", cursor: "grab",
      }, { tabIndex: 0 });
      const root = element("div", { maxWidth: `${model.get("width")}px` }, { className: "slamlab-live" });
      // the notebook would take the arrow keys for itself
      root.dataset.lmSuppressShortcuts = canvas.dataset.lmSuppressShortcuts = "true";
      head.textContent = model.get("title");
      canvas.setAttribute("role", "img");
      canvas.setAttribute("aria-label", model.get("alt"));
      bar.append(status, fit);
      root.append(head, canvas, bar);
      el.append(root);

      const camera = new Camera(model.get("width"), model.get("height"));
      let scheduled = false;
      const paint = () => {
        scheduled = false;
        const wide = canvas.clientWidth || model.get("width");
        camera.width = wide;
        camera.height = Math.round(wide * model.get("height") / model.get("width"));
        camera.follow(layers.bounds(), layers.header.run);
        draw(canvas, camera, layers);
        status.textContent = layers.header.status;
        const { number, behind } = layers.header;
        root.dataset.frame = number;
        root.dataset.behind = Math.max(behind, root.dataset.behind ?? 0);
        driving = false;
        if (number > drawn) {
          drawn = number;
          model.send({ kind: "drawn", number });
        }
      };
      const repaint = () => {
        if (!scheduled) requestAnimationFrame(paint);
        scheduled = true;
      };

      if (!views.size) {
        const near = ["localhost", "127.0.0.1", "[::1]"].includes(location.hostname);
        const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
        model.send({ kind: "ready", near, calm });
      }
      views.add(repaint);
      const resized = new ResizeObserver(repaint);
      resized.observe(canvas);
      canvas.addEventListener("wheel", (event) => {
        event.preventDefault();
        const [x, y] = onCanvas(canvas, event);
        camera.zoom(Math.exp(-0.0015 * event.deltaY), x, y);
        repaint();
      }, { passive: false });
      canvas.addEventListener("pointerdown", (event) => {
        canvas.focus({ preventScroll: true });
        canvas.setPointerCapture(event.pointerId);
        canvas.style.cursor = "grabbing";
      });
      canvas.addEventListener("pointerup", () => { canvas.style.cursor = "grab"; });
      canvas.addEventListener("pointermove", (event) => {
        if (!event.buttons) return;
        const [, , enlarged] = onCanvas(canvas, event);
        camera.pan(event.movementX / enlarged, event.movementY / enlarged);
        repaint();
      });
      const fitAll = () => {
        camera.fitted = true;
        camera.fit(layers.bounds());
        repaint();
      };
      canvas.addEventListener("dblclick", fitAll);
      fit.addEventListener("click", fitAll);
      canvas.addEventListener("keydown", (event) => {
        if (!(event.key in KEYS) || event.ctrlKey || event.altKey || event.metaKey) return;
        event.preventDefault();
        event.stopPropagation();
        // a key that is held repeats faster than a robot drives: one command a picture
        if (driving) return;
        driving = event.key != " ";
        model.send({ kind: "key", name: KEYS[event.key] });
      });

      repaint();
      return () => {
        views.delete(repaint);
        resized.disconnect();
        if (!views.size) model.send({ kind: "gone" });
      };
    },
  };
};
