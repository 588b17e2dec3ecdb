// Page of a live run: a WebSocket is the channel of a live feed; buttons, keys, lines that are typed.
// Who drives renews it four times a second, while the page is in sight; otherwise the robot stands.

const RENEWAL = 250; // [ms]
const NAIVE = "naive";
const at = (id) => document.getElementById(id);
const say = (text) => { if (at("said").textContent !== text) at("said").textContent = text; };
const dark = matchMedia("(prefers-color-scheme: dark)");
const theme = () => (dark.matches ? DARK : LIGHT);

// the token is changed into a cookie, and is in no bookmark
async function comeIn() {
  const key = location.hash.slice(1);
  history.replaceState(null, "", location.pathname);
  if (!key) return true; // a page that is loaded again has its cookie
  const asked = { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify({ key }) };
  return (await fetch("enter", asked).catch(() => null))?.ok;
}

let feedOfPage = null;

function connect() {
  const socket = new WebSocket(`ws://${location.host}/socket`);
  socket.binaryType = "arraybuffer";
  const send = (message) => socket.readyState == WebSocket.OPEN && socket.send(JSON.stringify(message));
  const feed = feedOfPage = new LiveFeed(send);
  let state = null;
  feed.layers.header = { status: "", run: null, radius: 0, number: 0, behind: 0 };
  socket.addEventListener("message", ({ data }) => {
    if (typeof data == "string") {
      const said = JSON.parse(data);
      if (said.kind == "answer") answer(said);
      else state = show(said, state, feed);
      return;
    }
    const size = new DataView(data).getUint32(0, true);
    feed.receive(JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, size))), new Uint8Array(data, 4 + size));
  });
  socket.addEventListener("close", ({ reason }) => {
    for (const control of at("desk").querySelectorAll("button, input, select")) control.disabled = true;
    const lost = "The connection is lost: load this page again. If that fails, the program has ended.";
    const refused = "Nobody is let in without the address that the program printed.";
    say(reason || (state ? lost : refused));
  });
  setInterval(() => {
    if (state?.drives == "you" && document.visibilityState == "visible") send({ kind: "renew" });
  }, RENEWAL);
  listen(send, feed);
}

function show(now, before, feed) {
  if (!before) begin(now, feed);
  at("run").textContent = now.running ? "❚❚ pause" : "▶ run";
  at("run").dataset.press = now.running ? "pause" : "run";
  at("driving").hidden = !now.drivable;
  at("speed").value = now.speed;
  at("map").hidden = now.map === null;
  at("map").title = `to ${now.map}`;
  at("film").hidden = now.film === null;
  at("film").textContent = now.film ? "● filming" : "○ film pauses";
  if (before?.drives && !now.drives) at("driver").dataset.ended = 1 + Number(at("driver").dataset.ended ?? 0);
  at("driver").textContent = now.drives && `${now.drives} ${now.drives == "you" ? "drive" : "drives"}`;
  say(now.said || "connected");
  return now;
}

// what is known only from the first word on
function begin({ title, size: [width, height], speeds }, feed) {
  document.title = `${title} – SLAM live`;
  at("desk").hidden = false;
  at("speed").replaceChildren(...speeds.map((speed) => new Option(speed)));
  const alt = `Live map, x across, y up: ${title}. The line below the picture says where it stands.`;
  const picture = feed.show({ width, height, title, alt }, theme());
  at("place").replaceChildren(picture.root);
  dark.addEventListener("change", () => picture.wear(theme()));
}

function answer({ text, refused }) {
  at("answer").value = text;
  at("answer").dataset.refused = refused;
}

function listen(send, feed) {
  document.addEventListener("click", ({ target }) => {
    const { press, line } = target.dataset;
    if (press) send({ kind: "press", name: press });
    if (line) send({ kind: "line", text: line });
  });
  at("typed").addEventListener("submit", (event) => {
    event.preventDefault();
    send({ kind: "line", text: at("line").value });
    at("line").value = "";
  });
  at("speed").addEventListener("change", () => send({ kind: "speed", value: Number(at("speed").value) }));
  at("naive").addEventListener("change", () => {
    if (at("naive").checked) feed.layers.hidden.delete(NAIVE);
    else feed.layers.hidden.add(NAIVE);
    for (const picture of feed.pictures) picture.repaint();
  });
}

comeIn().then((let_in) => (let_in ? connect() : say("This is not the token: open the address that the program printed.")));
