// Page of a phone in the lecture: current slide, earlier slides, votes. The server sanitises all content, and
// the Content-Security-Policy forbids scripts in it.

const at = (id) => document.getElementById(id);
const sleep = (ms) => new Promise((done) => { setTimeout(done, ms); });
const NOTHING_KNOWN = 999999999;
const slides = new Map(); // slide's number to {version, place, html}
let state = null;
let selected = null; // an earlier slide that is shown; null for the current one
let drawn = "";

const notify = (text) => { if (at("message").textContent !== text) at("message").textContent = text; };

function made(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

// ---- login ----------------------------------------------------------------------------------------

const send = (path, content) => fetch(path, {
  method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(content),
});

async function logIn(key) {
  for (;;) {
    const answer = await send("login", { key }).catch(() => null);
    if (answer?.ok) return true;
    if (answer && answer.status !== 429) return false;
    notify(answer ? "Many phones are joining. Please wait …" : "No connection. Trying again …");
    await sleep(2000 + 2000 * Math.random());
  }
}

function askForCode(message) {
  notify(message);
  at("entry").hidden = false;
  if (!document.activeElement.closest("section, nav")) at("code").focus(); // keep the focus of a reader of earlier slides
  return new Promise((done) => {
    at("entry").onsubmit = (event) => {
      event.preventDefault();
      at("entry").hidden = true;
      done(at("code").value);
    };
  });
}

async function join() {
  let key = location.hash.slice(1);
  history.replaceState(null, "", location.pathname); // remove the key from the address
  if (!key && (await fetch(`state/${NOTHING_KNOWN}`).catch(() => null))?.ok) return; // this phone has a cookie
  if (!key) key = await askForCode("Enter the code to join.");
  while (!await logIn(key)) key = await askForCode("The code is wrong. Try again.");
}

// ---- the slide ------------------------------------------------------------------------------------

async function slide(number, version) {
  const known = slides.get(number);
  if (known?.version >= version) return known;
  const answer = await fetch(`slide/${number}`).catch(() => null);
  if (!answer?.ok) return known;
  slides.set(number, await answer.json());
  return slides.get(number);
}

function frame(wide) {
  const around = made("div", { class: "scroll" });
  wide.replaceWith(around);
  around.append(wide);
}

function readable(article) {
  for (const picture of article.querySelectorAll("img:not([alt])")) picture.alt = "figure";
  article.querySelectorAll("pre, table, math[display=block]").forEach(frame);
  // inline formulas that do not fit get a scrolling frame
  for (const formula of article.querySelectorAll("math")) {
    if (!formula.closest(".scroll") && formula.getBoundingClientRect().width > article.clientWidth) frame(formula);
  }
}

// make wide content reachable by the keyboard
function reachable() {
  for (const around of document.querySelectorAll(".scroll")) {
    if (around.scrollWidth > around.clientWidth) around.tabIndex = 0;
    else around.removeAttribute("tabindex");
  }
}

// Draw the slide; whether it could be loaded.
async function drawSlide() {
  const numbers = Object.keys(state.slides).map(Number);
  const number = selected ?? state.shown;
  const which = numbers.indexOf(number);
  at("shown").hidden = at("navigation").hidden = which < 0;
  if (which < 0) return true;
  at("previous").disabled = which === 0;
  at("next").disabled = which === numbers.length - 1;
  at("current").disabled = selected === null;
  const found = await slide(number, state.slides[number]);
  if (!(found?.version >= state.slides[number])) return false;
  if ((selected ?? state.shown) !== number) return true; // the slide changed meanwhile
  // numbers as on the lecturer's screen
  at("which").textContent = `${number === state.shown ? "Current" : "Earlier"} slide: ${found.place}`;
  const drawing = `${number} ${found.version}`;
  if (drawn === drawing) return true;
  if (drawn.split(" ")[0] !== String(number)) scrollTo(0, 0);
  drawn = drawing;
  at("slide").innerHTML = found.html;
  readable(at("slide"));
  reachable();
  return true;
}

async function update() {
  if (!await drawSlide()) notify("The slide could not be loaded. Try again.");
}

function step(by) {
  const numbers = Object.keys(state.slides).map(Number);
  const number = numbers[numbers.indexOf(selected ?? state.shown) + by];
  if (number !== undefined) selected = number === state.shown ? null : number;
  update();
}

// ---- the poll -------------------------------------------------------------------------------------

async function vote(answer) {
  const poll = state.poll;
  const sent = await send("vote", { poll: poll.number, answer }).catch(() => null);
  if (sent?.ok) {
    poll.mine = (await sent.json()).mine;
    at("voted").textContent = "Your answer was received. You can change it until the poll closes.";
  } else {
    at("voted").textContent = sent?.status === 409
      ? "The poll is closed." : "Your answer was not received. Send it again.";
  }
  for (const button of document.querySelectorAll("[aria-pressed]")) {
    button.setAttribute("aria-pressed", String(Number(button.value) === poll.mine));
  }
}

function choices(poll) {
  const buttons = poll.choices.map((html, n) => {
    const words = made("span");
    words.innerHTML = html;
    const pressed = String(poll.mine === n);
    const button = made("button", { type: "button", value: n, "aria-pressed": pressed },
      made("strong", {}, "ABCDEFGH"[n]), words);
    button.onclick = () => vote(n);
    return button;
  });
  return made("div", { class: "choices" }, ...buttons);
}

function field(poll) {
  const input = made("input", { id: "number", inputmode: "decimal", autocomplete: "off", required: "" });
  input.value = poll.mine ?? "";
  const label = made("label", { for: "number" }, `Your number${poll.unit ? ` [${poll.unit}]` : ""}`);
  const form = made("form", {}, label, input, made("button", {}, "send"));
  form.onsubmit = (event) => {
    event.preventDefault();
    const text = input.value.trim().replace(",", ".").replace("−", "-");
    if (text && Number.isFinite(Number(text))) vote(Number(text));
    else at("voted").textContent = "Enter a number, such as 1.5.";
  };
  return form;
}

function row(name, words, count, share) {
  const filled = made("div");
  filled.style.width = `${100 * share}%`;
  const text = made("div", { class: "row" }, made("strong", {}, name), words, made("span", {}, String(count)));
  return made("li", {}, text, made("div", { class: "bar", "aria-hidden": "true" }, filled));
}

function results({ choices: asked, result, unit }) {
  const rows = asked
    ? asked.map((html, n) => {
      const words = made("span");
      words.innerHTML = html;
      return ["ABCDEFGH"[n], words, result.counts[n]];
    })
    : result.bars.map(({ from, to, count }) => {
      const range = [from, to].map((edge) => Number(edge.toPrecision(6)));
      const text = range[0] === range[1] ? `${range[0]}` : `${range[0]} to ${range[1]}`;
      return ["", made("span", {}, `${text} ${unit}`), count];
    });
  return made("ul", { class: "results" }, ...rows.map((all) => row(...all, all[2] / Math.max(1, result.answers))));
}

function drawPoll() {
  const { poll } = state;
  at("poll").hidden = !poll;
  // redraw only after a change; hands may be counted after the poll is closed
  const asked = poll ? `${poll.number} ${poll.open} ${JSON.stringify(poll.result)}` : "";
  if (at("poll").dataset.asked === asked) return;
  at("poll").dataset.asked = asked;
  at("voted").textContent = "";
  if (!poll) return;
  at("asked").textContent = poll.open ? "Question" : "Answers of the class";
  at("question").innerHTML = poll.text;
  readable(at("question"));
  at("answers").replaceChildren(!poll.open ? results(poll) : poll.choices ? choices(poll) : field(poll));
  if (poll.open) at("voted").textContent = poll.mine === null ? "Answers are anonymous." : "Your answer was received.";
  else at("voted").textContent = poll.result.answers === 1 ? "One answer." : `${poll.result.answers} answers.`;
  reachable();
  at("poll").scrollIntoView({ block: "nearest" });
}

// ---- updates --------------------------------------------------------------------------------------

async function follow() {
  let known = NOTHING_KNOWN;
  let failed = 0;
  for (;;) {
    const answer = await fetch(`state/${known}`).catch(() => null);
    if (answer?.status === 403) return "again"; // another lecture, or cookies are disabled
    if (!answer?.ok) {
      failed += 1;
      notify(failed < 12 ? "No connection. Trying again …"
        : "No connection: the lecture has ended, or this phone has left the network.");
      await sleep(Math.min(1000 * failed, 10000) + 1000 * Math.random());
      continue;
    }
    failed = 0;
    const received = await answer.json();
    if (received.over) {
      notify("The lecture has ended. This page keeps its content until you close it.");
      at("poll").hidden = at("navigation").hidden = true;
      return "over";
    }
    state = received;
    notify(received.shown === null ? "Connected. The first slide will appear soon." : "Connected.");
    drawPoll();
    if (await drawSlide()) {
      known = received.version;
    } else {
      known = NOTHING_KNOWN; // the slide was lost: load everything again
      await sleep(1000);
    }
  }
}

at("previous").onclick = () => step(-1);
at("next").onclick = () => step(1);
at("current").onclick = () => { selected = null; update(); };
addEventListener("resize", reachable);

for (;;) {
  await join(); // an existing cookie is kept
  if (await follow() === "over") break;
}
