// Ink file beside the notebook: NAME.ink.json. The server writes files in place, and leaves a damaged file
// if it is killed meanwhile. So the ink is written first to a backup, NAME.ink.spare.json, and one of the
// two files is always valid.

import { isStroke } from "./strokes.js";

const PAUSE = 1000; // [ms] after the last stroke
const VERSION = 1;

let last = Promise.resolve(); // reading waits for writing, in case a deck is restarted at once

export class InkFile {
  constructor(contents, notebook, notify) {
    Object.assign(this, { contents, notify });
    const name = notebook.replace(/\.ipynb$/, "");
    Object.assign(this, { path: `${name}.ink.json`, spare: `${name}.ink.spare.json` });
  }

  // Read the strokes; [] if there is no file. A damaged file without a valid backup is renamed, and the
  // result is undefined.
  async read() {
    await last;
    const folder = this.path.split("/").slice(0, -1).join("/");
    const listed = (await this.contents.get(folder, { content: true })).content;
    if (!listed.some(({ path }) => path === this.path)) return []; // requesting a missing file would be an error
    for (const pause of [0, PAUSE]) { // another window may be writing it
      await new Promise((done) => { setTimeout(done, pause); });
      const strokes = strokesIn(await this.#text(this.path));
      if (strokes) return strokes;
    }
    const spared = listed.some(({ path }) => path === this.spare) && strokesIn(await this.#text(this.spare));
    if (spared) {
      await this.#write(this.path, spared); // before the backup is overwritten
      return spared;
    }
    const aside = this.#free(listed.map(({ path }) => path));
    await this.contents.rename(this.path, aside);
    this.notify(`The ink file was damaged. It is kept as ${aside.split("/").at(-1)}, and a new file is started.`);
    return undefined;
  }

  // Save strokes shortly after the last change; after an error the next change tries again.
  keep(strokes) {
    this.waiting = strokes;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.flush(), PAUSE);
  }

  // Write pending strokes now, one write after another.
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
        this.notify(`The ink could not be saved (${error.message}). Saving is retried after the next stroke.`);
      }
    });
    return last;
  }

  #write(path, strokes) {
    return this.contents.save(path, { type: "file", format: "text", content: asText(strokes) });
  }

  // Text of a file; undefined if it is not text.
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

// Strokes in a file's text; undefined if it is invalid.
function strokesIn(text) {
  try {
    const { version, strokes } = JSON.parse(text);
    return version === VERSION && strokes.every(isStroke) ? strokes : undefined;
  } catch {
    return undefined;
  }
}

// One line for each stroke, for readable diffs.
const asText = (strokes) => {
  const lines = strokes.map((stroke) => `  ${JSON.stringify(stroke)}`).join(",\n");
  return `{"version": ${VERSION}, "strokes": [\n${lines}\n]}\n`;
};
