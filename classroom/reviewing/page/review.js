// Review of a class. Students' content is inserted as text (textContent), never as HTML.

const at = (id) => document.getElementById(id);
const notify = (text) => { at("message").textContent = text; };
const folded = (text) => text.normalize("NFKD").replace(/\p{M}/gu, "").toLowerCase(); // ü as u
const plain = (points) => String(Math.round(points * 1e6) / 1e6);
const STATES = {
  "": "all", nothing: "no submission", ungraded: "could not be graded", full: "all points", part: "some points",
  none: "no points", late: "late", hand: "changed by hand", undecided: "to be decided", asked: "regrade request",
};

let table = null; // as last received
let shown = []; // positions [row, column] that match the filters, in the table's order
let open = null; // position of the submission that is shown
let asking = 0; // number of the last request; earlier responses are ignored
const drafts = new Map(); // unsaved input, by position and field

function make(tag, given = {}, ...inside) {
  const { dataset, ...rest } = given;
  const element = Object.assign(document.createElement(tag), rest);
  Object.assign(element.dataset, dataset);
  element.append(...inside.filter((part) => part !== null && part !== undefined && part !== ""));
  return element;
}

async function ask(path, content) {
  const body = content && { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(content) };
  const answer = await fetch(path, body).catch(() => null);
  if (!answer) throw new Error("The program has ended or does not respond.");
  const view = await answer.json();
  if (!answer.ok) throw new Error(view.error);
  return view;
}

// exchange the token for a cookie, and remove it from the address
async function logIn() {
  const key = location.hash.slice(1);
  history.replaceState(null, "", location.pathname);
  if (key) await ask("login", { key });
  await loadTable();
  begin();
}

// ---- the table ----

async function loadTable() {
  table = await ask("table");
  at("course").textContent = table.course && `· ${table.course}`;
  at("main").hidden = false;
  notify(`Changes are recorded as made by ${table.who}.`);
}

function begin() {
  const option = (value, text) => make("option", { value, textContent: text });
  const sections = [...new Set(table.students.map((one) => one.section))].filter(Boolean).sort();
  at("section").replaceChildren(option("", "all"), ...sections.map((name) => option(name, name)));
  at("exercise").replaceChildren(option("", "all"), ...table.exercises.map(({ id, title }) => option(id, `${id} ${title}`)));
  at("state").replaceChildren(...Object.entries(STATES).map(([value, text]) => option(value, text)));
  draw();
}

function fits(cell) {
  const state = at("state").value;
  return (!state || cell.state == state || cell[state] === true) && (!at("flagged").checked || cell.flag === true);
}

function draw() {
  const columns = table.exercises.map((_, column) => column)
    .filter((column) => !at("exercise").value || table.exercises[column].id == at("exercise").value);
  const words = folded(at("who").value.trim()), section = at("section").value;
  const rows = table.students.map((_, row) => row).filter((row) => {
    const { id, name, section: mine } = table.students[row];
    return (!section || mine == section) && (!words || folded(`${name} ${id}`).includes(words))
      && columns.some((column) => fits(table.rows[row][column]));
  });
  shown = rows.flatMap((row) => columns.filter((column) => fits(table.rows[row][column])).map((column) => [row, column]));
  const head = make("tr", {}, make("th", { scope: "col", textContent: "student" }), ...columns.map((column) => {
    const { id, title, points } = table.exercises[column];
    return make("th", { scope: "col", title: `${title}, ${points} points`, textContent: id });
  }));
  const body = rows.map((row) => make("tr", {}, make("th", { scope: "row", textContent: nameOf(row), title: nameOf(row) }),
    ...columns.map((column) => drawCell(row, column))));
  at("place").replaceChildren(make("table", {}, make("thead", {}, head), make("tbody", {}, ...body)));
  at("count").textContent = `${rows.length} of ${table.students.length} students, ${shown.length} cells`;
  const first = at("place").querySelector("td:not(.other) button") ?? at("place").querySelector("td button");
  if (first) first.tabIndex = 0;
}

function nameOf(row) {
  const { id, name, section } = table.students[row];
  const several = table.students.filter((one) => one.name == name).length > 1;
  return [name, several && id, section].filter(Boolean).join(" · ");
}

function drawCell(row, column) {
  const cell = table.rows[row][column];
  const points = { nothing: "–", ungraded: "∅" }[cell.state] ?? plain(cell.total);
  const marks = [["flag", "⚑", "flagged"], ["asked", "?", "regrade request"], ["undecided", "⇄", "to be decided"], ["hand", "✎", "changed by hand"], ["late", "◷", "late"]]
    .filter(([name]) => cell[name]);
  const label = [`${table.students[row].name}, ${table.exercises[column].id}: ${points}`,
    STATES[cell.state], ...marks.map(([, , word]) => word)].join(", ");
  const button = make("button", { type: "button", tabIndex: -1, dataset: { row, column },
    textContent: marks.map(([, sign]) => sign).join("") + " " + points });
  button.setAttribute("aria-label", label);
  return make("td", { className: [cell.state, cell.flag ? "flag" : "", fits(cell) ? "" : "other"].join(" ") }, button);
}

function focusCell(button) {
  const before = at("place").querySelector("button[tabindex='0']");
  if (before) before.tabIndex = -1;
  button.tabIndex = 0;
  button.focus();
}

function moveInTable(event) {
  const cell = event.target.closest("td");
  const steps = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0], Home: [0, -99], End: [0, 99],
    PageUp: [-15, 0], PageDown: [15, 0] };
  const step = steps[event.key];
  if (!cell || !step || event.ctrlKey || event.altKey || event.metaKey) return;
  event.preventDefault();
  const rows = [...cell.closest("tbody").rows], between = (value, most) => Math.max(0, Math.min(most, value));
  const row = rows[between(rows.indexOf(cell.parentElement) + step[0], rows.length - 1)];
  focusCell(row.cells[between(cell.cellIndex + step[1], row.cells.length - 1) || 1].firstChild);
}

function focusAt(place) {
  const cell = place && at("place").querySelector(`button[data-row="${place[0]}"][data-column="${place[1]}"]`);
  if (cell) focusCell(cell);
  else at("who").focus();
}

// ---- a submission ----

const pathOf = ([row, column]) => `submission/${row}/${table.exercises[column].id}`;

async function look(place) {
  const mine = ++asking;
  const view = await ask(pathOf(place));
  if (mine != asking) return;
  open = place;
  at("class").hidden = true;
  at("submission").hidden = false;
  show(view);
  at("submission").focus();
  scrollTo(0, 0);
}

function show(view) {
  const { student, exercise } = view, where = shown.findIndex((place) => String(place) == String(open));
  at("title").textContent = `${student.name} · ${exercise.id} ${exercise.title}`;
  document.title = `${student.name}, ${exercise.id} – Review`;
  at("where").textContent = where < 0 ? "" : `${where + 1} of ${shown.length}`;
  at("previous").disabled = where <= 0;
  at("next").disabled = where + 1 >= shown.length;
  const total = typeof view.total == "number" ? `${plain(view.total)} of ${exercise.points} points` : view.status;
  const facts = [total, student.id, student.section, view.handed_in && `handed in ${view.handed_in}`, view.due && `due ${view.due}`,
    view.attempts > 1 && `${view.attempts} attempts`, view.submission];
  at("facts").textContent = facts.filter(Boolean).join(" · ");
  const list = (items) => make("ul", {}, ...items.map((item) => make("li", { textContent: item })));
  const warnings = [
    view.reason && make("p", { className: "warning", textContent: `Could not be graded: ${view.reason}` }),
    view.flags?.length && make("div", { className: "warning" }, make("strong", { textContent: "⚑ Code that no exercise needs: a hint, not a verdict" }),
      list(view.flags)),
    ...[view.late, ...(view.others ?? [])].map((text) => text && make("p", { className: "quote", textContent: text })),
    view.notes?.length && make("p", { className: "faint", textContent: `About the file: ${view.notes.join("; ")}` }),
  ];
  at("warnings").replaceChildren(...warnings.filter(Boolean));
  at("code").replaceChildren(...(view.no_code ? [make("p", { className: "faint", textContent: view.no_code })] : []),
    ...(view.code ?? []).flatMap(showCell));
  at("verdict").replaceChildren(...(view.tasks ?? []).map((task) => showTask(task, view)));
  at("requests").replaceChildren(...(view.requests ?? []).map((request) => showRequest(request, view)));
  at("comment").replaceChildren(...(view.submission ? [commentForm(view)] : []));
  const changes = (view.history ?? []).map(({ at: when, who, what }) => make("li", { className: "quote", textContent: `${when}, ${who}: ${what}` }));
  at("history").replaceChildren(...(changes.length ? [make("h3", { textContent: "Changes by hand" }), make("ol", {}, ...changes)] : []));
}

function showCell({ number, source, problem }) {
  const cell = make("pre", { tabIndex: 0, textContent: source });
  cell.setAttribute("role", "region");
  cell.setAttribute("aria-label", `cell ${number}`);
  return [make("p", { className: "number", textContent: `cell ${number}` }), cell,
    ...(problem ? [make("p", { className: "broken", textContent: problem })] : [])];
}

function showTask(task, view) {
  const points = task.points === null ? "–" : plain(task.points);
  const judged = task.by_hand !== null && task.judged !== null ? ` (judged: ${plain(task.judged)})` : "";
  const laws = task.laws.map(({ mark, kind, text, points, most, why }) => make("li", { className: kind,
    textContent: `${mark} ${text} (${plain(points)} of ${plain(most)}${why ? `: ${why}` : ""})` }));
  const mistakes = task.mistakes.map(({ text, count, own }) =>
    make("li", { className: own ? "own" : "", textContent: `${count} × ${text}${own ? " ← this one" : ""}` }));
  const [all, some, none] = task.class;
  return make("div", { className: "box" },
    make("h4", {}, make("span", { textContent: `${task.id} ${task.title}` }), make("span", { textContent: `${points} of ${task.most}${judged}` })),
    task.by_hand !== null ? make("p", { className: "quote", textContent: `set by hand: ${task.by_hand}` }) : null,
    task.undecided ? make("p", { className: "warning", textContent: `To be decided: ${task.undecided}. Set the points that count.` }) : null,
    task.problem ? make("p", { className: "broken", textContent: task.problem }) : null,
    laws.length ? make("ul", { className: "laws" }, ...laws) : null,
    task.hint ? make("p", { textContent: `Hint: ${task.hint}` }) : null,
    make("details", { open: mistakes.length > 0 && !(task.judged >= task.most) }, make("summary", { textContent: `The class: ${all} all points, ${some} some, ${none} none` }),
      mistakes.length ? make("ul", {}, ...mistakes) : make("p", { className: "faint", textContent: "no known mistakes" })),
    pointsForm(task, view));
}

// a field whose text is kept until it is saved, also while other submissions are shown
function field(name, tag, given) {
  const key = `${open}/${name}`, element = make(tag, given);
  element.dataset.key = key;
  if (drafts.has(key)) element.value = drafts.get(key);
  element.addEventListener("input", () => drafts.set(key, element.value));
  return [element, key];
}

// render all fields again, and keep the focus of a field outside the saved form
function showAgain(view, done) {
  const { activeElement } = document, typing = done?.contains(activeElement) ? undefined : activeElement.dataset.key;
  show(view);
  const field = [...at("submission").querySelectorAll("[data-key]")].find(({ dataset }) => dataset.key == typing);
  (field ?? at("submission")).focus();
}

function form(view, label, fields, contentOf) {
  const elements = fields.map(([element]) => element);
  const button = make("button", { textContent: label });
  const made = make("form", { className: "row" }, ...elements.map((element) =>
    make("label", { className: element.tagName == "TEXTAREA" || element.className == "reason" ? "reason" : "" }, element.dataset.label + " ", element)), button);
  made.addEventListener("submit", async (event) => {
    event.preventDefault();
    const place = open, mine = ++asking, sent = elements.map((element) => element.value);
    button.disabled = true;
    try {
      const now = await ask(pathOf(place), { seen: view.seen, ...contentOf(...sent) });
      fields.forEach(([, key], index) => drafts.get(key) === sent[index] && drafts.delete(key));
      table.rows[place[0]][place[1]] = now.cell;
      if (mine == asking) showAgain(now, made);
      notify("Saved.");
    } catch (error) {
      notify(`Not saved: ${error.message}`);
      const now = await ask(pathOf(place)).catch(() => view);
      if (mine == asking) showAgain(now);
    }
  });
  return made;
}

function pointsForm(task, view) {
  const points = field(`${task.id}/points`, "input", { type: "number", min: 0, max: task.most, step: "any", className: "points",
    placeholder: "auto", title: "empty: the points of the autograder", value: task.points ?? "", dataset: { label: "points" } });
  const reason = field(`${task.id}/reason`, "input", { required: true, maxLength: 4000, autocomplete: "off", className: "reason", dataset: { label: "reason" } });
  points[0].setAttribute("aria-label", `points of ${task.id}`);
  reason[0].setAttribute("aria-label", `reason for the points of ${task.id}`);
  return form(view, "set", [points, reason], (value, text) => ({ task: task.id, points: value === "" ? null : Number(value), text }));
}

function commentForm(view) {
  const text = field("comment", "textarea", { maxLength: 4000, value: view.comment, dataset: { label: "to the student, on the feedback page" } });
  return make("div", { className: "box" }, make("h3", { textContent: "Comment" }), form(view, "save comment", [text], (value) => ({ text: value })));
}

function showRequest({ key, text, answer }, view) {
  const reply = field(`answer/${key}`, "textarea", { maxLength: 4000, required: true, value: answer, dataset: { label: "answer" } });
  return make("div", { className: "box" }, make("h3", { textContent: answer ? "Regrade request, answered" : "Regrade request" }),
    make("p", { className: "quote", textContent: text }), form(view, answer ? "change answer" : "answer", [reply], (value) => ({ request: key, text: value })));
}

// ---- moving about ----

async function step(by) {
  const place = shown[shown.findIndex((one) => String(one) == String(open)) + by];
  if (place) await tried(() => look(place));
}

async function back() {
  const place = open;
  asking++;
  open = null;
  document.title = "Review";
  at("submission").hidden = true;
  at("class").hidden = false;
  focusAt(place);
  await tried(loadTable);
  const { row, column } = document.activeElement.dataset; // the user may have moved the focus meanwhile
  draw();
  if (row !== undefined) focusAt([row, column]);
}

async function tried(action) {
  try {
    await action();
  } catch (error) {
    notify(error.message);
  }
}

at("place").addEventListener("click", ({ target }) => {
  const { row, column } = target.closest("button")?.dataset ?? {};
  if (row !== undefined) tried(() => look([Number(row), Number(column)]));
});
at("place").addEventListener("keydown", moveInTable);
at("filters").addEventListener("input", draw);
at("filters").addEventListener("submit", (event) => event.preventDefault());
at("back").addEventListener("click", back);
at("previous").addEventListener("click", () => step(-1));
at("next").addEventListener("click", () => step(1));
at("submission").addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.altKey || event.metaKey || event.isComposing) return;
  const typing = event.target.closest("input, textarea, select");
  if (event.key == "Escape") typing ? at("submission").focus() : back();
  else if (typing) return;
  else if (event.key == "j") step(1);
  else if (event.key == "k") step(-1);
  else if (event.key == "c") { event.preventDefault(); at("comment").querySelector("textarea")?.focus(); }
  else if (/^[1-9]$/.test(event.key)) {
    const points = at("verdict").querySelectorAll(".points")[event.key - 1];
    if (points) { event.preventDefault(); points.focus(); points.select(); }
  }
});
addEventListener("beforeunload", (event) => { if (drafts.size) event.preventDefault(); });

logIn().catch((error) => notify(error.message));
