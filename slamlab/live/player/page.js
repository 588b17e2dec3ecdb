// HTML elements. The player makes no network requests.

function element(tag, style, more = {}) {
  const made = Object.assign(document.createElement(tag), more);
  Object.assign(made.style, style);
  return made;
}
