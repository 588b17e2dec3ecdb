// Preview of a slide in the presenter window: the layout of the large screen, scaled down.

import { element } from "../element.js";

// Scripts of a slide run only in the deck, not in the preview.
const EMPTY = '<!doctype html><html lang="en"><head><title>slide</title></head><body></body></html>';

export class Screen {
  constructor(container, name) {
    Object.assign(this, { container, size: [960, 540] });
    this.frame = element("iframe");
    this.frame.sandbox = "allow-same-origin";
    this.frame.title = name;
    this.frame.inert = true;
    this.message = element("p");
    this.ready = new Promise((done) => { this.frame.addEventListener("load", done, { once: true }); });
    this.frame.srcdoc = EMPTY;
    container.append(this.frame, this.message);
    new ResizeObserver(() => this.#fit()).observe(document.documentElement);
  }

  // Set the window size of the pictures.
  resize(size) {
    if (String(size) === String(this.size)) return;
    this.size = size;
    this.#fit();
  }

  async style({ sheets, html, body }) {
    await this.ready;
    const made = this.frame.contentDocument;
    made.head.replaceChildren(...sheets.map((sheet) => {
      const tag = made.createElement(sheet.href ? "link" : "style");
      if (sheet.href) Object.assign(tag, { rel: "stylesheet", href: sheet.href });
      else tag.textContent = sheet.text;
      return tag;
    }));
    for (const [name, value] of html) made.documentElement.setAttribute(name, value);
    for (const [name, value] of body) made.body.setAttribute(name, value);
  }

  async show(picture, message = "") {
    await this.ready;
    if (picture !== this.picture) this.frame.contentDocument.body.innerHTML = picture;
    this.picture = picture;
    this.showMessage(message);
  }

  showMessage(message) {
    this.message.textContent = message;
    this.message.hidden = !message;
  }

  #fit() {
    const [width, height] = this.size;
    const room = this.container.parentElement.clientWidth;
    const high = 0.52 * window.innerHeight;
    const scale = Math.min(room / width, high / height);
    Object.assign(this.container.style, { width: `${width * scale}px`, height: `${height * scale}px` });
    Object.assign(this.frame.style, { width: `${width}px`, height: `${height}px`, transform: `scale(${scale})` });
  }
}
