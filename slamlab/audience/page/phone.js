// A phone in the lecture: it follows the slide, looks back, and votes. What comes is text and pictures,
// sanitised where it was taken in; no script could run here anyway (Content-Security-Policy).

const at = (id) => document.getElementById(id);
const sleep = (ms) => new Promise((done) => { setTimeout(done, ms); });
const NOTHING_KNOWN = 999999999;
const seen = new Map(); // slide's number to {version, place, html}
let state = null;
let looking = null; // the slide looked back at; null follows the lecture
let drawn = "";

const say = (text) => { if (at("said").textContent !== text) at("said").textContent = text; };

function made(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

// ---- the way in -----------------------------------------------------------------------------------

const send = (path, said) => fetch(path, {
  method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(said),
});

async function enter(key) {
  for (;;) {
    const answer = await send("enter", { key }).catch(() => null);
    if (answer?.ok) return true;
    if (answer && answer.status !== 429) return false;
    say(answer ? "Many come in at once. One moment …" : "No connection. Trying again …");
    await sleep(2000 + 2000 * Math.random());
  }
}

function askForCode(why) {
  say(why);
  at("entry").hidden = false;
  if (!document.activeElement.closest("section, nav")) at("code").focus(); // who looks back is not called
  return new Promise((done) => {
    at("entry").onsubmit = (event) => {
      event.preventDefault();
      at("entry").hidden = true;
      done(at("code").value);
    };
  });
}

async function comeIn() {
  let key = location.hash.slice(1);
  history.replaceState(null, "", location.pathname); // the key is in no bookmark
  if (!key && (await fetch(`state/${NOTHING_KNOWN}`).catch(() => null))?.ok) return; // a cookie is here
  if (!key) key = await askForCode("The code lets you in.");
  while (!await enter(key)) key = await askForCode("This is not the code. Try again.");
}

// ---- the slide ------------------------------------------------------------------------------------

async function slide(number, version) {
  const known = seen.get(number);
  if (known?.version >= version) return known;
  const answer = await fetch(`slide/${number}`).catch(() => null);
  if (!answer?.ok) return known;
  seen.set(number, await answer.json());
  return seen.get(number);
}

function frame(wide) {
  const around = made("div", { class: "scroll" });
  wide.replaceWith(around);
  around.append(wide);
}

function readable(article) {
  for (const picture of article.querySelectorAll("img:not([alt])")) picture.alt = "a figure";
  article.querySelectorAll("pre, table, math[display=block]").forEach(frame);
  // formulas within a line get a frame where they do not fit
  for (const formula of article.querySelectorAll("math")) {
    if (!formula.closest(".scroll") && formula.getBoundingClientRect().width > article.clientWidth) frame(formula);
  }
}

// what is wider than the page can be reached by the keyboard
function reachable() {
  for (const around of document.querySelectorAll(".scroll")) {
    if (around.scrollWidth > around.clientWidth) around.tabIndex = 0;
    else around.removeAttribute("tabindex");
  }
}

// Draw the slide; whether it could be had.
async function drawSlide() {
  const numbers = Object.keys(state.slides).map(Number);
  const number = looking ?? state.shown;
  const which = numbers.indexOf(number);
  at("shown").hidden = at("looking").hidden = which < 0;
  if (which < 0) return true;
  at("earlier").disabled = which === 0;
  at("later").disabled = which === numbers.length - 1;
  at("now").disabled = looking === null;
  const found = await slide(number, state.slides[number]);
  if (!(found?.version >= state.slides[number])) return false;
  if ((looking ?? state.shown) !== number) return true; // gone on meanwhile
  // numbered as on the lecturer's screen
  at("which").textContent = `${number === state.shown ? "Shown now" : "Looking back"}: slide ${found.place}`;
  const drawing = `${number} ${found.version}`;
  if (drawn === drawing) return true;
  if (drawn.split(" ")[0] !== String(number)) scrollTo(0, 0);
  drawn = drawing;
  at("slide").innerHTML = found.html;
  readable(at("slide"));
  reachable();
  return true;
}

async function lookAt() {
  if (!await drawSlide()) say("This slide did not come. Try again.");
}

function step(by) {
  const numbers = Object.keys(state.slides).map(Number);
  const number = numbers[numbers.indexOf(looking ?? state.shown) + by];
  if (number !== undefined) looking = number === state.shown ? null : number;
  lookAt();
}

// ---- the poll -------------------------------------------------------------------------------------

async function vote(answer) {
  const poll = state.poll;
  const sent = await send("vote", { poll: poll.number, answer }).catch(() => null);
  if (sent?.ok) {
    poll.mine = (await sent.json()).mine;
    at("voted").textContent = "Your answer is in. You can change it until the poll closes.";
  } else {
    at("voted").textContent = sent?.status === 409
      ? "The poll is closed." : "Your answer did not arrive. Please send it again.";
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
    else at("voted").textContent = "Please type a number, such as 1.5.";
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
      const range = [from, to].map((edge) => Number(edge.toPrecision(3)));
      const text = range[0] === range[1] ? `${range[0]}` : `${range[0]} to ${range[1]}`;
      return ["", made("span", {}, `${text} ${unit}`), count];
    });
  const most = Math.max(1, ...rows.map(([, , count]) => count));
  return made("ul", { class: "results" }, ...rows.map((all) => row(...all, all[2] / most)));
}

function drawPoll() {
  const { poll } = state;
  at("poll").hidden = !poll;
  // a phone that is typing is not disturbed; hands may still be counted once it is closed
  const asked = poll ? `${poll.number} ${poll.open} ${JSON.stringify(poll.result)}` : "";
  if (at("poll").dataset.asked === asked) return;
  at("poll").dataset.asked = asked;
  at("voted").textContent = "";
  if (!poll) return;
  at("asked").textContent = poll.open ? "A question to you" : "What the class answered";
  at("question").innerHTML = poll.text;
  readable(at("question"));
  at("answers").replaceChildren(!poll.open ? results(poll) : poll.choices ? choices(poll) : field(poll));
  if (poll.open) at("voted").textContent = poll.mine === null ? "Nobody sees who answers what." : "Your answer is in.";
  else at("voted").textContent = poll.result.answers === 1 ? "One answer." : `${poll.result.answers} answers.`;
  reachable();
  at("poll").scrollIntoView({ block: "nearest" });
}

// ---- following ------------------------------------------------------------------------------------

async function follow() {
  let known = NOTHING_KNOWN;
  let failed = 0;
  for (;;) {
    const answer = await fetch(`state/${known}`).catch(() => null);
    if (answer?.status === 403) return "again"; // another lecture, or no cookie is kept here
    if (!answer?.ok) {
      failed += 1;
      say(failed < 12 ? "No connection. Trying again …"
        : "No connection any more: the lecture is over, or this phone has left its network.");
      await sleep(Math.min(1000 * failed, 10000) + 1000 * Math.random());
      continue;
    }
    failed = 0;
    const told = await answer.json();
    if (told.over) {
      say("The lecture is over. What you see stays until you close this page.");
      at("poll").hidden = at("looking").hidden = true;
      return "over";
    }
    state = told;
    say(told.shown === null ? "You are in. The first slide comes soon." : "You are in.");
    drawPoll();
    if (await drawSlide()) {
      known = told.version;
    } else {
      known = NOTHING_KNOWN; // the slide got lost on the way: all of it once more
      await sleep(1000);
    }
  }
}

at("earlier").onclick = () => step(-1);
at("later").onclick = () => step(1);
at("now").onclick = () => { looking = null; lookAt(); };
addEventListener("resize", reachable);

for (;;) {
  await comeIn(); // who has a cookie already keeps it
  if (await follow() === "over") break;
}
