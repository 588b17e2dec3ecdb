// Film: a recording of frames, decoded. slamlab/live/films/film_file.py describes the format.

const FILM_FORMAT = "slamlab film", FILM_VERSION = 1;
const NO_NUMBER = -32768; // stands for non-finite values
const DAMAGED = "The film is damaged or incomplete. Copy or record the film again.";
const LINE_END = 10;
const WIDTHS = { points: 2, segments: 4, boxes: 4, poses: 3, ellipses: 5, samples: 3, curve: 2 };

// error in a film, with a message for the reader
class FilmError extends Error {}

class Film {
  // header, declared layers, frames {header, numbers}
  constructor(header, named, frames) {
    Object.assign(this, { header, frames, last: frames.length - 1 });
    this.layers = Object.assign(new Layers(), { named });
    this.at = -1;
    this.box = wholeBox(frames);
  }

  // bytes of the file
  static async read(bytes) {
    if (typeof DecompressionStream == "undefined") {
      throw new FilmError("This browser is too old to play films. Use Chromium 80, Firefox 113, Safari 16.4 "
        + "or later.");
    }
    let data;
    try {
      const plain = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
      data = new Uint8Array(await new Response(plain).arrayBuffer());
    } catch {
      throw new FilmError(DAMAGED);
    }
    try {
      return decodeFilm(data);
    } catch (error) {
      // any error that a damaged file may cause
      throw error instanceof FilmError ? error : new FilmError(DAMAGED);
    }
  }

  // show a frame, from 0; to seek backwards, start from the first
  seek(number) {
    if (number < this.at) [this.layers.list, this.at] = [[], -1];
    while (this.at < number) {
      const { header, numbers } = this.frames[++this.at];
      this.layers.receive(header, numbers);
    }
  }
}

function decodeFilm(data) {
  let at = 0;
  const line = () => {
    const end = data.indexOf(LINE_END, at);
    if (end < 0) throw new FilmError(DAMAGED);
    const text = new TextDecoder("utf-8", { fatal: true }).decode(data.subarray(at, end));
    at = end + 1;
    return JSON.parse(text);
  };
  const header = filmHeader(line);
  const declared = [], frames = [], most = []; // largest number of values of each layer
  let before = new Map();
  while (at < data.length) {
    const { status, layers = [], rows } = line();
    if (!layers.every(isLayer)) throw new FilmError(DAMAGED);
    declared.push(...layers);
    const entries = rows.map(([id, keep, follow]) => {
      const { kind, name, colour, panel, steps } = declared[id];
      const whole = [keep, follow].every((n) => Number.isInteger(n) && n >= 0);
      if (!whole || keep > (before.get(id) ?? 0)) throw new FilmError(DAMAGED);
      return { key: id, kind, name, colour, panel, width: steps.length, steps, keep, follow };
    });
    before = new Map(entries.map(({ key, keep, follow }) => [key, keep + follow]));
    if (before.size < entries.length) throw new FilmError(DAMAGED);
    for (const { key, width } of entries) {
      most[key] = Math.max(most[key] ?? 0, width * before.get(key));
    }
    const size = entries.reduce((sum, { width, follow }) => sum + width * follow, 0);
    if (at + 2 * size > data.length) throw new FilmError(DAMAGED);
    const numbers = new Float32Array(size);
    let start = 0;
    for (const { width, follow, steps } of entries) {
      const count = width * follow;
      undifferenced(data.subarray(at, at + 2 * count), numbers.subarray(start, start + count), steps);
      at += 2 * count;
      start += count;
    }
    const shown = { number: frames.length, run: 0, radius: header.radius, status, layers: entries };
    frames.push({ header: shown, numbers });
  }
  // one buffer for each layer: replaying only copies
  const buffers = most.map((count) => new Float32Array(count));
  for (const { header } of frames) for (const entry of header.layers) entry.room = buffers[entry.key];
  if (!frames.length) throw new FilmError("The film has no frames.");
  return new Film(header, declared, frames);
}

const isLayer = ({ kind, colour, steps }) => steps.length == WIDTHS[kind]
  && steps.every((step) => step > 0 && step < Infinity) && /^#[0-9a-f]{6}$/i.test(colour);

function filmHeader(line) {
  let header;
  try {
    header = line();
  } catch {
    header = null;
  }
  if (header?.format != FILM_FORMAT) throw new FilmError("This is not a film recorded by slamlab.");
  if (header.version != FILM_VERSION) {
    throw new FilmError(`The film has version ${header.version}, but this player requires version `
      + `${FILM_VERSION}. Create the page again with the slamlab that recorded the film.`);
  }
  const { title, alt, size, radius } = header;
  const texts = [title, alt].every((text) => typeof text == "string");
  const valid = texts && size?.length == 2 && [...size, radius + 1].every((number) => number > 0);
  if (!valid) throw new FilmError(DAMAGED);
  return header;
}

// rows from the differences down their columns: all low bytes, then all high bytes
function undifferenced(bytes, rows, steps) {
  const width = steps.length, count = rows.length, follow = count / width;
  for (let column = 0, at = 0; column < width; column++) {
    let whole = 0;
    for (let row = 0; row < follow; row++, at++) {
      whole = ((whole + (bytes[at] | (bytes[count + at] << 8))) << 16) >> 16;
      rows[row * width + column] = whole == NO_NUMBER ? NaN : whole * steps[column];
    }
  }
}

// bounding box of all frames: the camera of a film does not move
function wholeBox(frames) {
  const box = nowhere();
  for (const { header, numbers } of frames) {
    let at = 0;
    for (const { kind, width, follow } of header.layers) {
      surround(box, kind, width, numbers.subarray(at, at += width * follow));
    }
  }
  return somewhere(box);
}
