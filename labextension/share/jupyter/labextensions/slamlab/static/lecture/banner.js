// Banner above a notebook: a message with buttons.

import { element } from "../element.js";

// Show a banner; dispose the widget to remove it.
export function strip(panel, Widget, text, ...buttons) {
  const node = element("div", "slamlab-strip", text, ...buttons);
  node.setAttribute("role", "alert");
  const shown = new Widget({ node });
  panel.contentHeader.addWidget(shown);
  return shown;
}
