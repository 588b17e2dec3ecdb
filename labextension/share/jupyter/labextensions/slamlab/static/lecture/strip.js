// A strip above a notebook that says something, with buttons that answer it.

import { element } from "../element.js";

// Show a strip; the widget is disposed to take it away.
export function strip(panel, Widget, text, ...buttons) {
  const node = element("div", "slamlab-strip", text, ...buttons);
  node.setAttribute("role", "alert");
  const shown = new Widget({ node });
  panel.contentHeader.addWidget(shown);
  return shown;
}
