// HTML elements of a page, as everything that draws makes them. No network request is made.

function element(tag, style, more = {}) {
  const made = Object.assign(document.createElement(tag), more);
  Object.assign(made.style, style);
  return made;
}
