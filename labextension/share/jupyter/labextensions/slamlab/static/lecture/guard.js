// While the deck is shown no key, click or saving reaches the notebook, but for its controls.

const CONTROL = ".jp-OutputArea-output input, .jp-OutputArea-output button, .jp-OutputArea-output select, "
  + ".jp-OutputArea-output [role=slider], .jp-OutputArea-output canvas, .jp-OutputArea-output [tabindex], "
  + ".jp-OutputArea-output summary, .jp-OutputArea-output a, .slamlab-layer *";
const POINTED = `${CONTROL}, .jp-OutputArea-output .jupyter-widgets`; // a slider's track takes no key
const EDITOR = ".slamlab-unlocked .cm-content";
// what remotes send, and what runs a cell: no control and no editor has use for it
const ALWAYS = new Set(["PageDown", "PageUp", "F5", "Shift+F5", "Escape", "Ctrl+Enter", "Shift+Enter"]);
const SHORT = new Set([".", "i", "p"]); // remotes and tools, but while one types
const NO_LETTERS = ".jp-OutputArea-output :is(button, [role=slider])"; // those that were dragged or pressed keep the focus
const BROWSER = new Set(["F11", "F12", "Tab"]); // what the deck leaves to the browser

// A key as deck.keys names it.
export const nameOf = (event) => {
  const shift = event.shiftKey && (event.key === " " || event.key.length > 1) ? "Shift+" : ""; // a sign has its own
  return `${event.ctrlKey || event.metaKey ? "Ctrl+" : ""}${shift}${event.key}`;
};

// Guard a deck; the result ends it.
export function guard(deck) {
  const { panel } = deck;
  const stop = (event) => { event.stopImmediatePropagation(); event.preventDefault(); };
  const suppressed = document.body.dataset.lmSuppressShortcuts;
  document.body.dataset.lmSuppressShortcuts = "true";

  const keydown = (event) => {
    const name = nameOf(event);
    const focus = event.target instanceof Element ? event.target : document.body;
    if (focus.closest(EDITOR)) {
      if (ALWAYS.has(name)) act(name, event);
      return;
    }
    const typing = focus.matches("input:not([type=range]), textarea, select, [contenteditable=true]");
    const own = ALWAYS.has(name) || (SHORT.has(name) && !typing) // no control has use for these
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

  // clicks beside controls select, fold or edit cells in a notebook
  const pointer = (event) => {
    if (!panel.node.contains(event.target)) return;
    if (event.type === "pointerdown") deck.touched = event.target.closest(".jp-Cell") ?? deck.touched;
    if (event.target.closest(`${POINTED}, ${EDITOR}`)) return;
    if (event.type === "pointerdown") document.activeElement?.closest(CONTROL)?.blur(); // its keys are the deck's again
    stop(event);
  };
  const inside = (event) => {
    if (!event.target.closest?.(EDITOR)) stop(event);
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
