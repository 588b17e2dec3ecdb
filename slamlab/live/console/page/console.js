// Page of a live run: a WebSocket is the channel of a live feed; buttons, keys, typed commands.
// While it drives and is visible, the page renews the drive lock; otherwise the robot stops.

const RENEWAL = 250; // [ms]
const NAIVE = "naive";
const at = (id) => document.getElementById(id);
const report = (text) => { if (at("message").textContent !== text) at("message").textContent = text; };
const dark = matchMedia("(prefers-color-scheme: dark)");
const theme = () => (dark.matches ? DARK : LIGHT);

// exchange the token for a cookie, and remove it from the address
async function logIn() {
  const key = location.hash.slice(1);
  history.replaceState(null, "", location.pathname);
  if (!key) return true; // a reloaded page has its cookie
  const request = { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify({ key }) };
  return (await fetch("login", request).catch(() => null))?.ok;
}

let feedOfPage = null;

function connect() {
  const socket = new WebSocket(new URL("socket", location.href.replace(/^http/, "ws")));
  socket.binaryType = "arraybuffer";
  const send = (message) => socket.readyState == WebSocket.OPEN && socket.send(JSON.stringify(message));
  const feed = feedOfPage = new LiveFeed(send);
  let state = null;
  feed.layers.header = { status: "", run: null, radius: 0, number: 0, behind: 0 };
  socket.addEventListener("message", ({ data }) => {
    if (typeof data == "string") {
      const content = JSON.parse(data);
      if (content.kind == "answer") answer(content);
      else state = show(content, state, feed);
      return;
    }
    const size = new DataView(data).getUint32(0, true);
    feed.receive(JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, size))), new Uint8Array(data, 4 + size));
  });
  socket.addEventListener("close", ({ reason }) => {
    for (const control of at("panel").querySelectorAll("button, input, select")) control.disabled = true;
    const lost = "The connection is lost. Reload this page; if that fails, the program has ended.";
    const refused = "Access denied, or the program has ended. Open the address that the program printed.";
    report(reason || (state ? lost : refused));
  });
  setInterval(() => {
    if (state?.driver == "you" && document.visibilityState == "visible") send({ kind: "renew" });
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
  at("map").title = `Save the map to ${now.map}`;
  at("film").hidden = now.film === null;
  at("film").textContent = now.film ? "● filming" : "○ film paused";
  if (before?.driver && !now.driver) at("driver").dataset.ended = 1 + Number(at("driver").dataset.ended ?? 0);
  at("driver").textContent = now.driver && `${now.driver} ${now.driver == "you" ? "are driving" : "is driving"}`;
  report(now.message || "connected");
  return now;
}

// set up the page from the first state
function begin({ title, size: [width, height], speeds }, feed) {
  document.title = `${title} – SLAM live`;
  at("panel").hidden = false;
  at("speed").replaceChildren(...speeds.map((speed) => new Option(speed)));
  const alt = `Live map, x across, y up: ${title}. The line below the picture shows the status.`;
  const picture = feed.show({ width, height, title, alt }, theme());
  at("view").style.maxWidth = `max(320px, (100vh - 250px) * ${width / height})`; // the line for commands stays in sight
  at("view").replaceChildren(picture.root);
  dark.addEventListener("change", () => picture.applyTheme(theme()));
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

logIn().then((accepted) => (accepted ? connect() : report(accepted === false ? "The token is wrong. Open the address that the program printed." : "The program has ended.")));
