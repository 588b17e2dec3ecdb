// Input guard: while slides are shown, keys and clicks reach only controls, not the notebook.

const CONTROL = ".jp-OutputArea-output input, .jp-OutputArea-output button, .jp-OutputArea-output select, "
  + ".jp-OutputArea-output [role=slider], .jp-OutputArea-output canvas, .jp-OutputArea-output [tabindex], "
  + ".jp-OutputArea-output summary, .jp-OutputArea-output a, .slamlab-layer *";
const POINTED = `${CONTROL}, .jp-OutputArea-output .jupyter-widgets`; // a slider's track has no keys
const EDITOR = ".slamlab-unlocked .cm-content";
// keys of remotes, and keys that run a cell, which no control or editor uses
const ALWAYS = new Set(["PageDown", "PageUp", "F5", "Shift+F5", "Escape", "Ctrl+Enter", "Shift+Enter"]);
const SHORT = new Set([".", "i", "p"]); // remotes and tools, except while typing
const NO_LETTERS = ".jp-OutputArea-output :is(button, [role=slider])"; // they keep the focus after a drag or click
const DIALOG = ".jp-Dialog"; // of JupyterLab, above the slides
const BROWSER = new Set(["F11", "F12", "Tab"]); // keys that the browser handles

// A key as deck.keys names it.
export const nameOf = (event) => {
  const shift = event.shiftKey && (event.key === " " || event.key.length > 1) ? "Shift+" : ""; // not for printable characters
  return `${event.ctrlKey || event.metaKey ? "Ctrl+" : ""}${shift}${event.key}`;
};

// Guard a deck; returns a function that ends it.
export function guard(deck) {
  const { panel } = deck;
  const stop = (event) => { event.stopImmediatePropagation(); event.preventDefault(); };
  const suppressed = document.body.dataset.lmSuppressShortcuts;
  document.body.dataset.lmSuppressShortcuts = "true";

  const keydown = (event) => {
    if (!panel.isVisible || event.target.closest?.(DIALOG)) return;
    const name = nameOf(event);
    const focus = event.target instanceof Element ? event.target : document.body;
    if (focus.closest(EDITOR)) {
      if (ALWAYS.has(name)) act(name, event);
      return;
    }
    const typing = focus.matches("input:not([type=range]), textarea, select, [contenteditable=true]");
    const own = ALWAYS.has(name) || (SHORT.has(name) && !typing) // not used by controls
      || (focus.matches(NO_LETTERS) && /^[^ ]$/.test(name));
    if (focus.closest(CONTROL) && !own) return;
    if (act(name, event)) return;
    event.stopImmediatePropagation();
    if (!BROWSER.has(event.key) && !event.altKey) event.preventDefault();
  };
  const act = (name, event) => {
    const found = deck.keys.get(name);
    if (!found) return false;
    stop(event);
    found.action();
    return true;
  };

  // clicks beside controls would select, fold or edit cells
  const pointer = (event) => {
    if (!panel.node.contains(event.target)) return;
    if (event.type === "pointerdown") deck.touched = event.target.closest(".jp-Cell") ?? deck.touched;
    if (event.target.closest(`${POINTED}, ${EDITOR}`)) return;
    if (event.type === "pointerdown") document.activeElement?.closest(CONTROL)?.blur(); // the deck gets its keys again
    stop(event);
  };
  const inside = (event) => {
    if (panel.isVisible && !event.target.closest?.(`${EDITOR}, ${DIALOG}`)) stop(event);
  };
  const listened = [
    [window, "keydown", keydown],
    ...["mousedown", "mouseup", "click", "dblclick", "pointerdown"].map((type) => [window, type, pointer]),
    ...["contextmenu", "dragstart", "drop", "paste", "cut"].map((type) => [window, type, inside]),
  ];
  for (const [where, type, listener] of listened) where.addEventListener(type, listener, true);

  return () => {
    for (const [where, type, listener] of listened) where.removeEventListener(type, listener, true);
    if (suppressed === undefined) delete document.body.dataset.lmSuppressShortcuts;
    else document.body.dataset.lmSuppressShortcuts = suppressed;
  };
}
