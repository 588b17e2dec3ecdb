// Audience of a lecture: phones show the current slide and answer polls. The audience server
// (classroom.audience) serves them; this page sends it the current slide, and receives only counts.

import { button, element } from "../element.js";
import { questionIn } from "../questions.js";
import { drawBars, LETTERS, many } from "./poll_bars.js";
import { copyOf, seen } from "./slide_html.js";
import { isShown } from "./slides.js";

const PAUSE = 500; // [ms] minimum between two slides sent
const COUNTING = 1000; // [ms] between two requests of the counts
const KEEP_ALIVE = 30000; // [ms] between two keep-alive requests

const UNREACHABLE = "Phones cannot reach this address, so it has no QR code. For a class, connect this machine to the network of "
  + "the phones, end the class here, and open it to phones on this network.";

const starting = (host) => `print(__import__("json").dumps(__import__("classroom.audience").audience.start(${
  JSON.stringify(location.origin)}, host=${JSON.stringify(host)})))`;

// Whether a JupyterHub serves this page: phones then use its address.
const onHub = () => JSON.parse(document.getElementById("jupyter-config-data")?.textContent ?? "{}").hubPrefix !== undefined;

// The question of a cell: {id, unit, text: element, items: elements or null}; null if it has none.
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
    this.server = null; // addresses and code of the server
    this.question = null; // the current question, with its choices' texts
    this.timers = new Set();
    this.sent = Promise.resolve(); // slides are sent one after another
    this.panel = element("section", "slamlab-class");
    this.panel.setAttribute("aria-label", "The class");
    this.panel.dataset.slamlabCloses = ""; // Escape closes it
    this.strip = element("div", "slamlab-poll");
    this.strip.setAttribute("role", "group");
    this.strip.setAttribute("aria-label", "Poll");
    this.bars = element("section", "slamlab-bars");
    this.bars.setAttribute("aria-label", "Answers of the class");
    this.status = element("span");
    this.status.setAttribute("role", "status");
    deck.button("class", "Show the slides on the class's phones, and ask questions (a)", () => this.toggle());
    deck.key("a", "the class: address, code, phones", () => this.toggle());
    deck.key("q", "poll: ask the question, close the poll and show the bars, remove it", () => this.advance());
    deck.changed.connect(() => this.changed());
    deck.ended.connect(() => this.leave());
    this.reconnect();
  }

  // ---- the process --------------------------------------------------------------------------------

  async start(host) {
    this.panel.replaceChildren(element("p", "", "Starting … If a cell is still running, this waits for the cell."));
    try {
      this.server = JSON.parse(await this.deck.run(starting(host)));
      await this.alive();
    } catch (error) {
      this.server = null;
      this.offer(`The server did not start: ${error.message ?? error}`);
      return;
    }
    this.begin();
    this.showConnection();
  }

  begin() {
    this.every(KEEP_ALIVE, () => this.alive());
    this.every(COUNTING, () => this.panel.isConnected && this.alive()); // the panel shows the number of phones
    this.address = 0;
    this.changed();
  }

  async request(method, path, content) {
    const answer = await fetch(this.server.control + path, {
      method,
      headers: { Authorization: `Bearer ${this.server.key}`, "Content-Type": "application/json" },
      body: content && JSON.stringify(content),
    });
    const received = await answer.json();
    if (!answer.ok) throw new Error(received.error);
    return received;
  }

  // Send a request; show errors in the strip.
  async send(method, path, content) {
    try {
      return await this.request(method, path, content);
    } catch (error) {
      this.status.textContent = error instanceof TypeError
        ? "The audience server does not respond. Press a, end the class, and open it again." : String(error.message);
      this.showStrip();
      if (!this.status.isConnected) this.strip.append(this.status);
      return null;
    }
  }

  async alive() {
    const count = this.panel.querySelector(".slamlab-class-here");
    try {
      const { phones } = await this.request("GET", "/alive");
      if (count) count.textContent = `${many(phones, "phone")} connected.`;
    } catch (error) {
      this.panel.querySelector(".slamlab-qr")?.remove();
      if (count) count.textContent = "The audience server does not answer: nobody can connect. End the class and open it again.";
      throw error;
    }
  }

  every(milliseconds, action) {
    const timer = setInterval(() => Promise.resolve(action()).catch(() => {}), milliseconds);
    this.timers.add(timer);
    return timer;
  }

  end() {
    if (this.server) this.request("POST", "/end").catch(() => {});
    this.close();
  }

  close() {
    for (const timer of this.timers) clearInterval(timer);
    this.timers.clear();
    clearTimeout(this.sending);
    this.server = this.question = this.sending = null;
    for (const shown of [this.panel, this.strip, this.bars]) shown.remove();
    this.setStatus();
  }

  // The slides are left, perhaps only for a moment: when they return, phones need no new code. Otherwise the
  // server ends by itself.
  leave() {
    const { server, deck } = this;
    if (this.question) this.done();
    this.close();
    if (!server) return;
    const endLecture = () => { this.server = server; this.end(); deck.panel.slamlabClass.take(); };
    const shown = deck.strip("The class is still open, and phones still show the last slide. ", button("End it for the class", endLecture));
    deck.panel.slamlabClass = { server, take() { shown.dispose(); delete deck.panel.slamlabClass; } };
  }

  reconnect() {
    const left = this.deck.panel.slamlabClass;
    if (!left) return;
    this.server = left.server;
    left.take();
    this.begin();
  }

  // ---- the panel: how to connect ------------------------------------------------------------------

  toggle() {
    if (this.panel.isConnected) {
      this.panel.remove();
      return;
    }
    this.deck.layer.append(this.panel);
    if (this.server) this.showConnection();
    else this.offer("");
    this.panel.querySelector("button")?.focus();
  }

  offer(problem) {
    this.panel.replaceChildren(
      element("h2", "", "The class"),
      element("p", "", "Phones can show the current slide and earlier ones, and answer questions. Answers are anonymous, "
        + "and nothing is stored after the lecture."),
      element("p", "", "The server starts when you open the class. Phones cannot access the notebook, its files or its kernel."),
      ...(onHub() ? [button("open to phones", () => this.start("127.0.0.1"))] : [
        button("open to phones on this network", () => this.start("0.0.0.0")),
        button("open on this machine only, for a test", () => this.start("127.0.0.1")),
      ]),
      button("close", () => this.toggle()),
      element("p", "", problem),
    );
  }

  showConnection() {
    const { addresses, code } = this.server;
    const { address, qr } = addresses[this.address % addresses.length];
    const local = /^(https?:\/\/)?(127\.|localhost)/.test(address); // a phone would look for it on itself
    const picture = element("div", local ? "slamlab-class-local" : "slamlab-qr", local ? UNREACHABLE : "");
    if (!local) {
      picture.setAttribute("role", "img");
      picture.setAttribute("aria-label", `QR code of ${address}`);
      picture.append(document.importNode(new DOMParser().parseFromString(qr, "image/svg+xml").documentElement, true));
    }
    const instructions = element("div", "",
      element("p", "", local ? "For a test, open on this machine" : "Scan the code, or open"),
      element("p", "slamlab-class-address", address),
      element("p", "", "and enter the code"),
      element("p", "slamlab-class-code", `${code.slice(0, 4)} ${code.slice(4)}`),
      element("p", "slamlab-class-here"));
    const buttons = [button("hide", () => this.toggle())];
    if (addresses.length > 1) {
      buttons.push(button("another address of this machine", () => { this.address += 1; this.showConnection(); }));
    }
    buttons.push(button("end it for the class", () => { this.end(); }));
    this.panel.replaceChildren(element("h2", "", "The class"), element("div", "slamlab-class-way", picture, instructions),
      element("div", "slamlab-hands", ...buttons));
    this.alive().catch(() => {});
  }

  // ---- the slide ----------------------------------------------------------------------------------

  changed() {
    if (!this.server) return;
    if (this.bars.isConnected && this.beside !== this.deck.slide) this.makeRoom();
    this.drawStrip();
    this.sending ??= setTimeout(() => {
      this.sending = null;
      this.sent = this.sent.then(() => this.sendSlide()).catch(console.error);
    }, PAUSE);
  }

  // A long slide has several pages: a page is identified by its first cell.
  get place() { return this.deck.panel.content.widgets.indexOf(this.cells()[0]); }

  async sendSlide() {
    const slide = this.place, place = this.deck.slide + 1;
    const html = (await Promise.all(this.cells().map((cell) => this.copy(cell.node)))).join("\n");
    // if the slide changed meanwhile, another copy follows
    if (this.server && slide >= 0 && slide === this.place) await this.send("PUT", "/slide", { slide, place, html });
  }

  copy(part) {
    return copyOf(part, (editor) => this.cells().find((cell) => cell.node.contains(editor))?.model.sharedModel.getSource() ?? "");
  }

  cells() {
    // notes are never sent, even if they are visible by mistake
    const { page, panel } = this.deck;
    return panel.content.widgets.filter((cell) => page.contains(cell.node) && seen(cell.node) && isShown(cell));
  }

  // ---- a question ---------------------------------------------------------------------------------

  get asked() { return this.cells().map(questionOf).findLast(Boolean); }

  drawStrip() {
    if (this.question) return;
    const question = this.asked;
    this.setStatus(question ? "Press q to ask the class." : "");
    this.status.textContent = "";
    if (!question) this.strip.remove();
    else if (question.id !== this.offered || !this.strip.isConnected) {
      this.fillStrip(button("ask the class", () => this.advance()));
      this.offered = question.id; // drawn once, so that its button keeps the focus
    }
  }

  fillStrip(...parts) {
    this.offered = null;
    this.strip.replaceChildren(...parts, this.status);
    this.showStrip();
  }

  // Inserted only once, so that a field in it keeps the focus.
  showStrip() {
    if (!this.strip.isConnected) this.deck.bar.node.append(this.strip);
  }

  // Status of the class in the presenter window.
  setStatus(text = "") {
    if (this.deck.classStatus === text) return;
    this.deck.classStatus = text;
    this.deck.classChanged.emit(this.deck);
  }

  // The next step of a poll: ask, close, remove.
  advance() {
    if (!this.server) this.deck.notice("The class is not open. Press a to open it.");
    else if (this.question) this.question.over ? this.done() : this.closePoll();
    else if (this.asked) this.open(this.asked);
    else this.deck.notice("There is no question on this slide.");
  }

  async open(question) {
    const html = await this.copy(question.text);
    const words = question.items && await Promise.all(question.items.map((item) => this.copy(item)));
    const lettered = /^<strong>[A-H]<\/strong>\s*/;
    const choices = words && words.map((one) => one.replace(lettered, ""));
    // the choices are buttons, and are removed from the text
    const text = choices ? html.slice(0, html.lastIndexOf("<ul")) : html;
    if (!await this.send("PUT", "/poll", { question: question.id, text, choices, unit: question.unit })) return;
    const plain = question.items?.map((item) => item.textContent.slice(1).trim());
    this.question = { choices: plain ?? null, unit: question.unit };
    this.counting = this.every(COUNTING, () => this.count());
    this.drawControls();
    this.count();
  }

  async count() {
    const counts = await this.send("GET", "/poll");
    if (!counts || !this.question) return;
    this.status.textContent = `${many(counts.answers, "answer")}, ${many(counts.phones, "phone")}`;
    const each = this.question.choices ? `: ${counts.counts.map((count, n) => `${LETTERS[n]} ${count}`).join(", ")}` : "";
    this.setStatus(`${this.status.textContent}${each}. Press q to ${this.question.over ? "remove the poll" : "close the poll and show the bars"}.`);
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
    if (!await this.send("POST", "/poll/close") || !this.question) return;
    this.question.over = true;
    this.show(true);
    if (!this.hands?.isConnected) this.drawControls(); // the lecturer may be counting hands
    this.count();
  }

  show(on) {
    if (on) this.deck.layer.append(this.bars);
    else this.bars.remove();
    if (on) this.makeRoom();
    else this.deck.refresh();
    this.label();
  }

  // Lay out this slide beside the bars, but not the next one, of which the presenter has a preview.
  makeRoom() {
    this.beside = this.deck.slide;
    this.deck.refresh(false);
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
      if (!await this.send("PUT", "/hands", { hands }) || !this.question) return;
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
    this.show(false);
    this.question = null;
    this.send("DELETE", "/poll");
    this.drawStrip();
  }
}

// Add an audience to a deck.
export function addAudience(deck) {
  return new Audience(deck);
}
