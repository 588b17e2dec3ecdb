// Player of a film: play, pause, seek, step; by mouse, touch and keyboard.

const RATE = 10; // frames a second
const SPEEDS = [0.5, 1, 2, 5];
const HINT = "Space: play or pause; ← →: previous or next frame; Home, End: first or last frame";

class FilmPlayer {
  // theme as of a Picture; with `alone`, the keys work wherever the focus is
  constructor(film, theme, { alone = false } = {}) {
    const { title, alt, size: [width, height] } = film.header;
    this.film = film;
    const box = () => film.box, aim = (camera) => camera.fitted && camera.fit(film.box);
    this.picture = new Picture({ width, height, title, alt }, film.layers, theme, aim, box);
    this.root = this.picture.root;
    this.addControls();
    this.picture.onPainted = () => { this.root.dataset.frame = film.at; };
    (alone ? document : this.root).addEventListener("keydown", (event) => this.pressed(event));
    this.playing = false;
    // before it is played, a film shows its last frame
    this.show(film.last);
    this.pause();
  }

  addControls() {
    this.button = element("button", { minWidth: "6em" }, { type: "button", title: HINT });
    this.scrubber = element("input", { flex: "1", minWidth: "0" },
      { type: "range", min: 0, max: this.film.last, step: 1, title: HINT });
    this.scrubber.setAttribute("aria-label", "frame");
    this.speed = element("select", {});
    this.speed.setAttribute("aria-label", "speed");
    for (const speed of SPEEDS) this.speed.append(new Option(`${speed} ×`, speed, speed == 1, speed == 1));
    this.button.addEventListener("click", () => (this.playing ? this.pause() : this.play()));
    this.scrubber.addEventListener("input", () => this.goTo(Number(this.scrubber.value)));
    this.speed.addEventListener("change", () => this.playing && this.play());
    const controls = element("div", {}, { className: "slamlab-under" });
    controls.append(this.button, this.scrubber, this.speed);
    this.picture.canvas.after(controls); // above the status line, because its height may change
  }

  show(frame) {
    this.film.seek(Math.min(Math.max(frame, 0), this.film.last));
    this.scrubber.value = this.film.at;
    this.scrubber.setAttribute("aria-valuetext", this.film.layers.header.status);
    this.picture.repaint();
  }

  goTo(frame) {
    this.pause();
    this.show(frame);
  }

  // play from the current frame, or from the start after the end
  play() {
    const from = this.film.at == this.film.last ? 0 : this.film.at, began = performance.now();
    const mine = this.playing = Symbol(); // only the latest call continues
    this.button.textContent = "❚❚ pause";
    const rate = RATE * Number(this.speed.value) / 1000;
    const tick = (now) => {
      if (this.playing !== mine) return;
      const frame = from + Math.max(Math.floor((now - began) * rate), 0);
      if (frame != this.film.at) this.show(frame);
      if (this.film.at == this.film.last) this.pause();
      else requestAnimationFrame(tick);
    };
    this.show(from);
    requestAnimationFrame(tick);
  }

  pause() {
    this.playing = false;
    this.button.textContent = "▶ play";
  }

  // play when it becomes visible, unless the reader prefers reduced motion
  playWhenSeen() {
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) return;
    const watcher = new IntersectionObserver((seen) => {
      if (!seen.some((one) => one.isIntersecting)) return;
      watcher.disconnect();
      this.play();
    });
    watcher.observe(this.root);
  }

  pressed(event) {
    const { key, target } = event;
    if (event.ctrlKey || event.altKey || event.metaKey || target == this.speed) return;
    if (key == " " && target.tagName == "BUTTON") return; // the button handles it
    const to = { ArrowLeft: this.film.at - 1, ArrowRight: this.film.at + 1, Home: 0, End: this.film.last };
    if (key == " ") this.button.click();
    else if (key in to) this.goTo(to[key]);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }
}

// play a film in an element of the page; show errors there
async function showFilm(place, bytes, theme, how) {
  try {
    const player = new FilmPlayer(await Film.read(bytes), theme, how);
    place.replaceChildren(player.root);
    player.playWhenSeen();
    return player;
  } catch (error) {
    const expected = error instanceof FilmError;
    const message = element("p", {}, {
      textContent: expected ? error.message : `The film cannot be played here: ${error.message}`,
    });
    message.setAttribute("role", "alert");
    place.replaceChildren(message);
    if (!expected) throw error;
    return null;
  }
}
