// Ink is kept in a file beside its notebook, NAME.ink.json, never in the notebook. The server writes a file
// in place: killed while it writes, it leaves a torn one. So what is kept is written first to a spare,
// NAME.ink.spare.json, and one of the two is whole at any time.

import { isStroke } from "./strokes.js";

const PAUSE = 1000; // ms after the last stroke
const VERSION = 1;

let last = Promise.resolve(); // reading waits for writing: a deck may be started again at once

export class InkFile {
  constructor(contents, notebook, tell) {
    Object.assign(this, { contents, tell });
    const name = notebook.replace(/\.ipynb$/, "");
    Object.assign(this, { path: `${name}.ink.json`, spare: `${name}.ink.spare.json` });
  }

  // The strokes that are kept; none if there is no file. A damaged file is put aside, undefined, unless its
  // spare is whole.
  async read() {
    await last;
    const folder = this.path.split("/").slice(0, -1).join("/");
    const listed = (await this.contents.get(folder, { content: true })).content;
    if (!listed.some(({ path }) => path === this.path)) return []; // asking for none would be an error
    for (const pause of [0, PAUSE]) { // another window may be writing it
      await new Promise((done) => { setTimeout(done, pause); });
      const strokes = strokesIn(await this.#text(this.path));
      if (strokes) return strokes;
    }
    const spared = listed.some(({ path }) => path === this.spare) && strokesIn(await this.#text(this.spare));
    if (spared) {
      await this.#write(this.path, spared); // before the spare is written again
      return spared;
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

  // Write now what is still to be written; one after another.
  flush() {
    clearTimeout(this.timer);
    last = last.then(async () => {
      const strokes = this.waiting;
      if (!strokes) return;
      this.waiting = undefined;
      try {
        for (const path of [this.spare, this.path]) await this.#write(path, strokes);
      } catch (error) {
        this.waiting ??= strokes;
        this.tell(`The ink could not be saved (${error.message}); the next stroke tries again.`);
      }
    });
    return last;
  }

  #write(path, strokes) {
    return this.contents.save(path, { type: "file", format: "text", content: asText(strokes) });
  }

  // The text of a file; undefined if it is none.
  async #text(path) {
    try {
      return (await this.contents.get(path, { type: "file", format: "text", content: true })).content;
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
