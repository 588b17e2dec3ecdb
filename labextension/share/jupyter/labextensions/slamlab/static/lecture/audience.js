// The class in the lecture: its phones see the slide as it stands, and are asked. A process beside the kernel
// (slamlab.audience) listens for them; this page sends it the slide that is shown, and gets counts alone.

import { button, element } from "../element.js";
import { questionIn } from "../questions.js";
import { drawBars, LETTERS, many } from "./poll_bars.js";
import { copyOf, seen } from "./shown_slide.js";
import { isShown } from "./stops.js";

const PAUSE = 500; // [ms] between two slides sent, at least
const COUNTING = 1000; // [ms] between two looks at the counts
const LIVING = 30000; // [ms] between two signs of life

const starting = (host) => `print(__import__("json").dumps(__import__("slamlab.audience").audience.start(${
  JSON.stringify(location.origin)}, host=${JSON.stringify(host)})))`;

// The question of a cell that asks one: {id, unit, text: element, items: elements or null}; else null.
function questionOf(cell) {
  const question = questionIn(cell.model.sharedModel.getSource());
  const text = cell.node.querySelector(".jp-OutputArea-output.jp-RenderedMarkdown");
  if (!question || !text || !seen(text)) return null;
  const items = [...text.querySelectorAll("ul:last-of-type > li")];
  const lettered = items.length > 1 && items.every((item, n) => item.firstElementChild?.textContent === LETTERS[n]);
  return { ...question, text, items: lettered ? items : null };
}

class Audience {
  constructor(deck) {
    this.deck = deck;
    this.told = null; // where the process is
    this.question = null; // the one that is open, with its choices' texts
    this.timers = new Set();
    this.sent = Promise.resolve(); // slides go out one after another
    this.panel = element("section", "slamlab-class");
    this.panel.setAttribute("aria-label", "The class");
    this.panel.dataset.slamlabCloses = ""; // Escape closes it
    this.strip = element("div", "slamlab-poll");
    this.strip.setAttribute("role", "group");
    this.strip.setAttribute("aria-label", "A question to the class");
    this.bars = element("section", "slamlab-bars");
    this.bars.setAttribute("aria-label", "What the class answers");
    this.status = element("span");
    this.status.setAttribute("role", "status");
    deck.button("class", "let the class see the slide on their phones, and ask them", () => this.toggle());
    deck.key("a", "the class: address, code, phones", () => this.toggle());
    deck.key("q", "the class's question: ask it, close it with bars, put it away", () => this.goOn());
    deck.changed.connect(() => this.changed());
    deck.ended.connect(() => this.leave());
    this.comeBack();
  }

  // ---- the process --------------------------------------------------------------------------------

  async start(host) {
    this.panel.replaceChildren(element("p", "", "Starting …"));
    try {
      this.told = JSON.parse(await this.deck.run(starting(host)));
      await this.alive();
    } catch (error) {
      this.told = null;
      this.offer(`It did not start: ${error.message ?? error}`);
      return;
    }
    this.begin();
    this.showWay();
  }

  begin() {
    this.every(LIVING, () => this.alive());
    this.every(COUNTING, () => this.panel.isConnected && this.alive()); // somebody waits for phones to come in
    this.address = 0;
    this.changed();
  }

  async ask(method, path, said) {
    const answer = await fetch(this.told.control + path, {
      method,
      headers: { Authorization: `Bearer ${this.told.key}`, "Content-Type": "application/json" },
      body: said && JSON.stringify(said),
    });
    const told = await answer.json();
    if (!answer.ok) throw new Error(told.error);
    return told;
  }

  // What is asked, with what goes wrong said in the strip.
  async tell(method, path, said) {
    try {
      return await this.ask(method, path, said);
    } catch (error) {
      this.status.textContent = error instanceof TypeError
        ? "The class's process does not answer. Press a, end it, and open it again." : String(error.message);
      this.showStrip();
      if (!this.status.isConnected) this.strip.append(this.status);
      return null;
    }
  }

  async alive() {
    const told = await this.ask("GET", "/alive");
    this.here = told.phones;
    const count = this.panel.querySelector(".slamlab-class-here");
    if (count) count.textContent = `${many(told.phones, "phone")} here.`;
  }

  every(milliseconds, deed) {
    const timer = setInterval(() => Promise.resolve(deed()).catch(() => {}), milliseconds);
    this.timers.add(timer);
    return timer;
  }

  end() {
    if (this.told) this.ask("POST", "/end").catch(() => {});
    this.putAway();
  }

  putAway() {
    for (const timer of this.timers) clearInterval(timer);
    this.timers.clear();
    clearTimeout(this.sending);
    this.told = this.question = this.sending = null;
    for (const shown of [this.panel, this.strip, this.bars]) shown.remove();
    this.say();
  }

  // The deck is left, perhaps for a moment only: phones need no new code when it comes back. The process ends
  // by itself where it does not.
  leave() {
    const { told, deck } = this;
    if (this.question) this.done();
    this.putAway();
    if (!told) return;
    const over = () => { this.told = told; this.end(); deck.panel.slamlabClass.take(); };
    const shown = deck.strip("The class is still open: phones keep the last slide. ", button("End it for the class", over));
    deck.panel.slamlabClass = { told, take() { shown.dispose(); delete deck.panel.slamlabClass; } };
  }

  comeBack() {
    const left = this.deck.panel.slamlabClass;
    if (!left) return;
    this.told = left.told;
    left.take();
    this.begin();
  }

  // ---- the panel: how to come in ------------------------------------------------------------------

  toggle() {
    if (this.panel.isConnected) {
      this.panel.remove();
      return;
    }
    this.deck.layer.append(this.panel);
    if (this.told) this.showWay();
    else this.offer("");
    this.panel.querySelector("button")?.focus();
  }

  offer(problem) {
    this.panel.replaceChildren(
      element("h2", "", "The class"),
      element("p", "", "Phones can see the slide that is shown, look back at earlier ones, and answer questions. They give no "
        + "name, and nothing is kept after the lecture."),
      element("p", "", "Nothing listens until you open it. The notebook, its files and its kernel cannot be reached from there."),
      button("open it to phones on this network", () => this.start("0.0.0.0")),
      button("open it on this machine alone, to try it", () => this.start("127.0.0.1")),
      button("close", () => this.toggle()),
      element("p", "", problem),
    );
  }

  showWay() {
    const { addresses, code } = this.told;
    const { address, qr } = addresses[this.address % addresses.length];
    const picture = element("div", "slamlab-qr");
    picture.setAttribute("role", "img");
    picture.setAttribute("aria-label", `QR code of ${address}`);
    picture.append(document.importNode(new DOMParser().parseFromString(qr, "image/svg+xml").documentElement, true));
    const way = element("div", "",
      element("p", "", "Scan this, or open"),
      element("p", "slamlab-class-address", `http://${address}`),
      element("p", "", "and type"),
      element("p", "slamlab-class-code", `${code.slice(0, 4)} ${code.slice(4)}`),
      element("p", "slamlab-class-here"));
    const buttons = [button("hide", () => this.toggle())];
    if (addresses.length > 1) {
      buttons.push(button("another address of this machine", () => { this.address += 1; this.showWay(); }));
    }
    buttons.push(button("end it for the class", () => { this.end(); }));
    this.panel.replaceChildren(element("h2", "", "The class"), element("div", "slamlab-class-way", picture, way),
      element("div", "slamlab-hands", ...buttons));
    this.alive().catch(() => {});
  }

  // ---- the slide ----------------------------------------------------------------------------------

  changed() {
    if (!this.told) return;
    this.drawStrip();
    this.sending ??= setTimeout(() => {
      this.sending = null;
      this.sent = this.sent.then(() => this.send()).catch(console.error);
    }, PAUSE);
  }

  // A long slide has several pages: what is shown is named by its first cell.
  get place() { return this.deck.panel.content.widgets.indexOf(this.cells()[0]); }

  async send() {
    const slide = this.place, place = this.deck.slide + 1;
    const html = (await Promise.all(this.cells().map((cell) => this.copy(cell.node)))).join("\n");
    // gone on while it was copied: the change has ordered another copy
    if (this.told && slide >= 0 && slide === this.place) await this.tell("PUT", "/slide", { slide, place, html });
  }

  copy(part) {
    return copyOf(part, (editor) => this.cells().find((cell) => cell.node.contains(editor))?.model.sharedModel.getSource() ?? "");
  }

  cells() {
    // were notes in sight by mistake, they would still be no business of the class
    const { page, panel } = this.deck;
    return panel.content.widgets.filter((cell) => page.contains(cell.node) && seen(cell.node) && isShown(cell));
  }

  // ---- a question ---------------------------------------------------------------------------------

  get asked() { return this.cells().map(questionOf).findLast(Boolean); }

  drawStrip() {
    if (this.question) return;
    const question = this.asked;
    this.say(question ? "q asks the class." : "");
    this.status.textContent = "";
    if (!question) this.strip.remove();
    else if (question.id !== this.offered || !this.strip.isConnected) {
      this.fillStrip(button("ask the class", () => this.goOn()));
      this.offered = question.id; // drawn once: its button may have the focus when a figure comes late
    }
  }

  fillStrip(...parts) {
    this.offered = null;
    this.strip.replaceChildren(...parts, this.status);
    this.showStrip();
  }

  // Put anew into the page, it would take the focus from who types in it.
  showStrip() {
    if (!this.strip.isConnected) this.deck.bar.node.append(this.strip);
  }

  // What the presenter's window says of the class.
  say(words = "") {
    if (this.deck.ofClass === words) return;
    this.deck.ofClass = words;
    this.deck.classChanged.emit(this.deck);
  }

  // The next step of a question, by a key: it is asked, closed, put away.
  goOn() {
    if (!this.told) this.deck.notice("The class is not open: a opens it.");
    else if (this.question) this.question.over ? this.done() : this.closePoll();
    else if (this.asked) this.open(this.asked);
    else this.deck.notice("There is no question on this slide.");
  }

  async open(question) {
    const html = await this.copy(question.text);
    const words = question.items && await Promise.all(question.items.map((item) => this.copy(item)));
    const lettered = /^<strong>[A-H]<\/strong>\s*/;
    const choices = words && words.map((one) => one.replace(lettered, ""));
    // the choices are the buttons: they need not stand in the text, too
    const text = choices ? html.slice(0, html.lastIndexOf("<ul")) : html;
    if (!await this.tell("PUT", "/poll", { question: question.id, text, choices, unit: question.unit })) return;
    const plain = question.items?.map((item) => item.textContent.slice(1).trim());
    this.question = { choices: plain ?? null, unit: question.unit };
    this.counting = this.every(COUNTING, () => this.count());
    this.drawControls();
    this.count();
  }

  async count() {
    const counts = await this.tell("GET", "/poll");
    if (!counts || !this.question) return;
    this.status.textContent = `${many(counts.answers, "answer")}, ${many(counts.phones, "phone")}`;
    const each = this.question.choices ? `: ${counts.counts.map((count, n) => `${LETTERS[n]} ${count}`).join(", ")}` : "";
    this.say(`${this.status.textContent}${each}. q ${this.question.over ? "puts it away" : "closes the poll and shows the bars"}.`);
    drawBars(this.bars, this.question, counts);
  }

  drawControls() {
    const bars = button("", () => { this.show(!this.bars.isConnected); });
    this.label = () => { bars.textContent = this.bars.isConnected ? "hide bars" : "show bars"; };
    const hands = this.question.choices ? [button("show of hands", () => this.drawHands())] : [];
    const last = this.question.over
      ? button("done", () => this.done())
      : button("close the poll", () => this.closePoll());
    this.fillStrip(bars, ...hands, last);
    this.label();
  }

  async closePoll() {
    if (!await this.tell("POST", "/poll/close") || !this.question) return;
    this.question.over = true;
    this.show(true);
    if (!this.hands?.isConnected) this.drawControls(); // who counts hands by now goes on
    this.count();
  }

  show(on) {
    if (on) this.deck.layer.append(this.bars);
    else this.bars.remove();
    this.label();
  }

  drawHands() {
    const fields = this.question.choices.map((_, n) => {
      const field = element("input");
      Object.assign(field, { type: "number", min: 0, max: 10000, step: 1, value: 0 });
      return [element("label", "", `${LETTERS[n]} `, field), field];
    });
    const form = element("form", "slamlab-hands", ...fields.map(([label]) => label));
    const count = element("button", "", "count them");
    form.append(count, button("back", () => this.drawControls()));
    form.onsubmit = async (event) => {
      event.preventDefault();
      const hands = fields.map(([, field]) => Math.round(Number(field.value) || 0));
      if (!await this.tell("PUT", "/hands", { hands }) || !this.question) return;
      if (form.isConnected) this.drawControls();
      this.count();
    };
    this.hands = form;
    this.fillStrip(form);
    fields[0][1].focus();
  }

  done() {
    clearInterval(this.counting);
    this.timers.delete(this.counting);
    this.question = null;
    this.bars.remove();
    this.tell("DELETE", "/poll");
    this.drawStrip();
  }
}

// Give a deck its class.
export function addAudience(deck) {
  return new Audience(deck);
}
