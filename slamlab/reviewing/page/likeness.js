// Likeness: pairs of an exercise, and two submissions side by side, as text alone.

let alike = null; // what was told of an exercise last
let pair = -1; // which of its pairs is looked at; -1 for the list of them

async function compare() {
  if (!at("exercise").value) {
    say("Choose an exercise first.");
    at("exercise").focus();
    return;
  }
  const mine = ++asking;
  say("Comparing …");
  const told = await ask(`likeness/${at("exercise").value}`);
  if (mine != asking) return;
  alike = told;
  say(`Compared ${alike.compared} submissions.`);
  at("class").hidden = true;
  at("likeness").hidden = false;
  listPairs();
}

function listPairs() {
  pair = -1;
  const { exercise, pairs, compared, not_compared, knows_handed_out } = alike;
  document.title = `Likeness, ${exercise.id} – Review`;
  at("alike-title").textContent = `Likeness in ${exercise.id} ${exercise.title}`;
  const left = not_compared.map(({ row, why }) => `${nameOf(row)} (${why})`);
  at("compared").textContent = [
    `${compared} submissions compared; of pairs that share something rare ${pairs.length ? `the first ${pairs.length}` : "there is none"}.`,
    left.length && `Not compared: ${left.join("; ")}.`,
    !knows_handed_out && "The notebooks handed out are not beside this program, so a lesson's code counts as anybody's.",
  ].filter(Boolean).join(" ");
  at("pairs").replaceChildren(...pairs.map(({ rows, share }, index) => make("li", {}, make("button", { type: "button",
    dataset: { index }, textContent: `${percent(share)}  ${rows.map(nameOf).join(" – ")}` }))));
  at("sides").replaceChildren();
  place();
  (at("pairs").querySelector("button") ?? at("likeness")).focus();
}

const percent = (share) => `${Math.round(100 * share)} %`;

function place() {
  at("pairs").hidden = at("compared").hidden = pair >= 0;
  at("leave").textContent = pair < 0 ? "↑ table (Esc)" : "↑ pairs (Esc)";
  at("which").textContent = pair < 0 ? "" : `${pair + 1} of ${alike.pairs.length}`;
  at("less").disabled = pair <= 0;
  at("more").disabled = pair + 1 >= alike.pairs.length;
}

async function showPair(index) {
  const mine = ++asking, { rows, share } = alike.pairs[index], { id } = alike.exercise;
  const { sides } = await ask(`likeness/${id}/${rows.join("/")}`);
  if (mine != asking) return;
  pair = index;
  place();
  at("alike-title").textContent = `${rows.map(nameOf).join(" – ")} · ${id} · ${percent(share)}`;
  at("sides").replaceChildren(...sides.map((cells, side) => showSide(rows[side], cells)));
  at("likeness").focus();
  scrollTo(0, 0);
}

function showSide(row, cells) {
  const submission = make("button", { type: "button", textContent: "beside its verdict", dataset: { row } });
  submission.setAttribute("aria-label", `${nameOf(row)}: the submission beside its verdict`);
  return make("section", {}, make("h3", {}, `${nameOf(row)} `, submission), ...cells.flatMap(({ number, lines }) => {
    const cell = make("pre", { tabIndex: 0 }, ...lines.map(([text, kind, like]) => make("span", { className: `line ${kind}` },
      text, like && make("span", { className: "number", textContent: `  ≈ ${like}` }))));
    cell.setAttribute("role", "region");
    cell.setAttribute("aria-label", `${nameOf(row)}, cell ${number}`);
    return [make("p", { className: "number", textContent: `cell ${number}` }), cell];
  }));
}

function leave() {
  asking++; // a pair that comes late is not wanted any more
  if (pair >= 0) {
    const was = pair;
    listPairs();
    at("pairs").querySelector(`[data-index="${was}"]`)?.focus();
    return;
  }
  at("likeness").hidden = true;
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
    await look([Number(row), table.exercises.findIndex(({ id }) => id == alike.exercise.id)]);
    at("likeness").hidden = true;
  });
});
at("likeness").addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.altKey || event.metaKey) return;
  if (event.key == "Escape") leave();
  else if (event.key == "j" && pair + 1 < alike.pairs.length) tried(() => showPair(pair + 1));
  else if (event.key == "k" && pair > 0) tried(() => showPair(pair - 1));
});
