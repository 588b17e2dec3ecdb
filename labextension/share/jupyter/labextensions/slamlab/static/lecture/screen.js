// A slide in the presenter's window: laid out as on the large screen and made smaller as a whole.

import { element } from "../element.js";

// Scripts of a slide run in the deck alone; here its looks are enough.
const EMPTY = '<!doctype html><html lang="en"><head><title>slide</title></head><body></body></html>';

export class Screen {
  constructor(place, name) {
    Object.assign(this, { place, size: [960, 540] });
    this.frame = element("iframe");
    this.frame.sandbox = "allow-same-origin";
    this.frame.title = name;
    this.frame.inert = true;
    this.words = element("p");
    this.ready = new Promise((done) => { this.frame.addEventListener("load", done, { once: true }); });
    this.frame.srcdoc = EMPTY;
    place.append(this.frame, this.words);
    new ResizeObserver(() => this.#fit()).observe(document.documentElement);
  }

  // Pictures are of a window of this size.
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

  async show(picture, words = "") {
    await this.ready;
    if (picture !== this.picture) this.frame.contentDocument.body.innerHTML = picture;
    this.picture = picture;
    this.say(words);
  }

  say(words) {
    this.words.textContent = words;
    this.words.hidden = !words;
  }

  #fit() {
    const [width, height] = this.size;
    const room = this.place.parentElement.clientWidth;
    const high = 0.52 * window.innerHeight;
    const scale = Math.min(room / width, high / height);
    Object.assign(this.place.style, { width: `${width * scale}px`, height: `${height * scale}px` });
    Object.assign(this.frame.style, { width: `${width}px`, height: `${height}px`, transform: `scale(${scale})` });
  }
}
