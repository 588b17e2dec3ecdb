// Ink is kept in a file beside its notebook, NAME.ink.json, never in the notebook.

import { isStroke } from "./strokes.js";

const PAUSE = 1000; // ms after the last stroke
const VERSION = 1;

let last = Promise.resolve(); // reading waits for writing: a deck may be started again at once

export class InkFile {
  constructor(contents, notebook, tell) {
    Object.assign(this, { contents, tell });
    this.path = `${notebook.replace(/\.ipynb$/, "")}.ink.json`;
  }

  // The strokes that are kept; none if there is no file. A damaged file is put aside: undefined.
  async read() {
    await last;
    const folder = this.path.split("/").slice(0, -1).join("/");
    const listed = (await this.contents.get(folder, { content: true })).content;
    if (!listed.some(({ path }) => path === this.path)) return []; // asking for none would be an error
    for (const pause of [0, PAUSE]) { // another window may be writing it
      await new Promise((done) => { setTimeout(done, pause); });
      const strokes = strokesIn(await this.#text());
      if (strokes) return strokes;
    }
    const aside = this.#free(listed.map(({ path }) => path));
    await this.contents.rename(this.path, aside);
    this.tell(`The file of the ink was damaged: it is kept as ${aside.split("/").at(-1)}, and a new one begins.`);
    return undefined;
  }

  // Keep strokes, a while after the last change; what goes wrong is told and tried again at the next.
  keep(strokes) {
    this.waiting = strokes;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.flush(), PAUSE);
  }

  // Write now what is still to be written; one after another. The server writes in place and puts the
  // former file back if that fails; only a server that is killed while it writes leaves a torn one.
  // It renames onto no file that exists, so a new file under another name would leave a moment with none.
  flush() {
    clearTimeout(this.timer);
    last = last.then(async () => {
      const strokes = this.waiting;
      if (!strokes) return;
      this.waiting = undefined;
      try {
        await this.contents.save(this.path, { type: "file", format: "text", content: asText(strokes) });
      } catch (error) {
        this.waiting ??= strokes;
        this.tell(`The ink could not be saved (${error.message}); the next stroke tries again.`);
      }
    });
    return last;
  }

  // The text of the file; undefined if it is none.
  async #text() {
    try {
      return (await this.contents.get(this.path, { type: "file", format: "text", content: true })).content;
    } catch (error) {
      if (error.response?.status === 400) return undefined; // not UTF-8
      throw error;
    }
  }

  #free(taken) {
    const name = (number) => this.path.replace(/json$/, `damaged${number > 1 ? `-${number}` : ""}.json`);
    let number = 1;
    while (taken.includes(name(number))) number += 1;
    return name(number);
  }
}

// The strokes of a file's text; undefined if it is none of ours.
function strokesIn(text) {
  try {
    const { version, strokes } = JSON.parse(text);
    return version === VERSION && strokes.every(isStroke) ? strokes : undefined;
  } catch {
    return undefined;
  }
}

// A line a stroke: what changed is seen at a glance.
const asText = (strokes) => {
  const lines = strokes.map((stroke) => `  ${JSON.stringify(stroke)}`).join(",\n");
  return `{"version": ${VERSION}, "strokes": [\n${lines}\n]}\n`;
};
