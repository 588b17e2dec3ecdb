// Similarity: pairs of an exercise, and two submissions side by side, as text only.

let report = null; // the last report of an exercise
let pair = -1; // index of the pair that is shown; -1 for the list of pairs

async function compare() {
  if (!at("exercise").value) {
    notify("Choose an exercise first.");
    at("exercise").focus();
    return;
  }
  const mine = ++asking;
  notify("Comparing …");
  const received = await ask(`similarity/${at("exercise").value}`);
  if (mine != asking) return;
  report = received;
  notify(`Compared ${report.compared} submissions.`);
  at("class").hidden = true;
  at("similarity").hidden = false;
  listPairs();
}

function listPairs() {
  pair = -1;
  const { exercise, pairs, compared, not_compared, originals_excluded } = report;
  document.title = `Similarity, ${exercise.id} – Review`;
  at("similarity-title").textContent = `Similarity in ${exercise.id} ${exercise.title}`;
  const left = not_compared.map(({ row, why }) => `${nameOf(row)} (${why})`);
  at("compared").textContent = [
    pairs.length ? `${compared} submissions compared; the list shows the ${pairs.length} most similar pairs.`
      : `${compared} submissions compared; no pair shares rare code.`,
    left.length && `Not compared: ${left.join("; ")}.`,
    !originals_excluded && "The distributed notebooks are missing here, so code of the lessons is not excluded.",
  ].filter(Boolean).join(" ");
  at("pairs").replaceChildren(...pairs.map(({ rows, share }, index) => make("li", {}, make("button", { type: "button",
    dataset: { index }, textContent: `${percent(share)}  ${rows.map(nameOf).join(" – ")}` }))));
  at("sides").replaceChildren();
  place();
  (at("pairs").querySelector("button") ?? at("similarity")).focus();
}

const percent = (share) => `${Math.round(100 * share)} %`;

function place() {
  at("pairs").hidden = at("compared").hidden = pair >= 0;
  at("leave").textContent = pair < 0 ? "↑ table (Esc)" : "↑ pairs (Esc)";
  at("which").textContent = pair < 0 ? "" : `${pair + 1} of ${report.pairs.length}`;
  at("less").disabled = pair <= 0;
  at("more").disabled = pair + 1 >= report.pairs.length;
}

async function showPair(index) {
  const mine = ++asking, { rows, share } = report.pairs[index], { id } = report.exercise;
  const { sides } = await ask(`similarity/${id}/${rows.join("/")}`);
  if (mine != asking) return;
  pair = index;
  place();
  at("similarity-title").textContent = `${rows.map(nameOf).join(" – ")} · ${id} · ${percent(share)}`;
  at("sides").replaceChildren(...sides.map((cells, side) => showSide(rows[side], cells)));
  at("similarity").focus();
  scrollTo(0, 0);
}

function showSide(row, cells) {
  const submission = make("button", { type: "button", textContent: "show submission", dataset: { row } });
  submission.setAttribute("aria-label", `${nameOf(row)}: show the submission and its verdict`);
  return make("section", {}, make("h3", {}, `${nameOf(row)} `, submission), ...cells.flatMap(({ number, lines }) => {
    const cell = make("pre", { tabIndex: 0 }, ...lines.map(([text, kind, like]) => make("span", { className: `line ${kind}` },
      text, like && make("span", { className: "number", textContent: `  ≈ ${like}` }))));
    cell.setAttribute("role", "region");
    cell.setAttribute("aria-label", `${nameOf(row)}, cell ${number}`);
    return [make("p", { className: "number", textContent: `cell ${number}` }), cell];
  }));
}

function leave() {
  asking++; // ignore a late response
  if (pair >= 0) {
    const was = pair;
    listPairs();
    at("pairs").querySelector(`[data-index="${was}"]`)?.focus();
    return;
  }
  at("similarity").hidden = true;
  at("class").hidden = false;
  document.title = "Review";
  at("compare").focus();
}

at("compare").addEventListener("click", () => tried(compare));
at("leave").addEventListener("click", leave);
at("less").addEventListener("click", () => tried(() => showPair(pair - 1)));
at("more").addEventListener("click", () => tried(() => showPair(pair + 1)));
at("pairs").addEventListener("click", ({ target }) => {
  const { index } = target.closest("button")?.dataset ?? {};
  if (index !== undefined) tried(() => showPair(Number(index)));
});
at("sides").addEventListener("click", ({ target }) => {
  const { row } = target.closest("button")?.dataset ?? {};
  if (row === undefined) return;
  tried(async () => {
    await look([Number(row), table.exercises.findIndex(({ id }) => id == report.exercise.id)]);
    at("similarity").hidden = true;
  });
});
at("similarity").addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.altKey || event.metaKey) return;
  if (event.key == "Escape") leave();
  else if (event.key == "j" && pair + 1 < report.pairs.length) tried(() => showPair(pair + 1));
  else if (event.key == "k" && pair > 0) tried(() => showPair(pair - 1));
});
