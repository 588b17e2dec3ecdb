// Live feed of a running SLAM: frames arrive over a channel, a widget's comm or a WebSocket. Each
// frame drawn is acknowledged by its number (back-pressure), and drive keys are sent.
//
// To the page: frames, each a header {kind: "frame", number, behind, run, status, radius, layers} and
// float32 numbers. From it: {kind: "ready", near, calm}, {kind: "drawn", number}, {kind: "key", name}
// and {kind: "gone"}.

// keyboard driving (teleoperation): key to command
const KEYS = {
  ArrowUp: "forward", ArrowDown: "back", ArrowLeft: "left", ArrowRight: "right", " ": "stop",
};

class LiveFeed {
  // send(message) puts a message on the channel
  constructor(send) {
    Object.assign(this, { send, layers: new Layers(), pictures: new Set(), drawn: 0 });
  }

  // a message of the channel; bytes as a DataView or Uint8Array
  receive(header, bytes) {
    this.layers.receive(header, floats(bytes));
    for (const picture of this.pictures) picture.repaint();
  }

  // make a picture of the feed, with size, title and alternative text as of Picture
  show(how, theme) {
    const { layers } = this;
    const box = () => layers.bounds(), aim = (camera) => camera.follow(box(), layers.header.run);
    const picture = new Picture(how, layers, theme, aim, box);
    let driving = false;
    picture.onPainted = () => {
      const { number, behind } = layers.header, { dataset } = picture.root;
      dataset.frame = number;
      dataset.behind = Math.max(behind, dataset.behind ?? 0);
      driving = false;
      if (number > this.drawn) {
        this.drawn = number;
        this.send({ kind: "drawn", number });
      }
    };
    picture.canvas.addEventListener("keydown", (event) => {
      if (!(event.key in KEYS) || event.ctrlKey || event.altKey || event.metaKey) return;
      event.preventDefault();
      event.stopPropagation();
      // a held key repeats faster than frames are drawn: one command a frame
      if (driving) return;
      driving = event.key != " ";
      this.send({ kind: "key", name: KEYS[event.key] });
    });
    if (!this.pictures.size) {
      const near = ["localhost", "127.0.0.1", "[::1]"].includes(location.hostname);
      const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
      this.send({ kind: "ready", near, calm });
    }
    this.pictures.add(picture);
    return picture;
  }

  leave(picture) {
    this.pictures.delete(picture);
    picture.close();
    if (!this.pictures.size) this.send({ kind: "gone" });
  }
}
