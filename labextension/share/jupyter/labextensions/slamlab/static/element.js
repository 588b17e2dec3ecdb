// Elements of a page, each made in a line.

// An element with a class ("" for none) and its children, elements or text.
export function element(tag, className = "", ...children) {
  const made = document.createElement(tag);
  if (className) made.className = className;
  made.append(...children);
  return made;
}

// A button; its title is its name, too, where the label is no word.
export function button(label, action, title = "") {
  const made = element("button", "", label);
  made.type = "button";
  if (title) {
    made.title = title;
    made.setAttribute("aria-label", title);
  }
  made.addEventListener("click", () => { action(); });
  return made;
}

// Pressed by a mouse, a button would keep the space bar, which is the slides'.
export function giveBackFocus(within) {
  within.addEventListener("click", ({ detail, target }) => { if (detail) target.closest("button")?.blur(); });
}
