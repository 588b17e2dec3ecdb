// HTML elements.

// An element with a class ("" for none) and its children, elements or text.
export function element(tag, className = "", ...children) {
  const made = document.createElement(tag);
  if (className) made.className = className;
  made.append(...children);
  return made;
}

// A button; its title is also its accessible name.
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

// Remove the focus of a button after a mouse click, so that the space bar controls the slides.
export function giveBackFocus(within) {
  within.addEventListener("click", ({ detail, target }) => { if (detail) target.closest("button")?.blur(); });
}
