// HTML elements of a page, as all widgets make them. No network request is made.

const TEXT = { font: "13px system-ui, sans-serif", color: "var(--jp-ui-font-color1, #333)" };

function element(tag, style, more = {}) {
  const made = Object.assign(document.createElement(tag), more);
  Object.assign(made.style, style);
  return made;
}
