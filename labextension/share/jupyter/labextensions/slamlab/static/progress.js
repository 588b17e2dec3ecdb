// Progress at the head of a notebook: the points of each task, the questions that are answered.
// It is read from progress.json, which the kernel writes beside the folders of the notebooks.

import { element } from "./element.js";
import { questionIn } from "./questions.js";

const TASK = /\bcheck\("([^"\\]+)"\)/;

// tasks and questions of a notebook, in order
function tasksAndQuestions(model) {
  const found = [];
  for (const cell of model.cells) {
    if (cell.type !== "code") continue;
    const source = cell.sharedModel.getSource();
    const task = TASK.exec(source)?.[1], question = questionIn(source);
    if (task) found.push({ kind: "task", id: task, of: cell.getMetadata("nbgrader")?.points });
    else if (question) found.push({ kind: "question", id: question.id });
  }
  return found;
}

const NAME = "progress.json";

async function read(contents, folder) {
  try {
    const { content } = await contents.get(folder, { content: true });
    const file = content.find(({ name }) => name == NAME); // requesting a missing file would be an error
    if (!file) return {};
    const options = { type: "file", format: "text", content: true };
    return JSON.parse((await contents.get(file.path, options)).content);
  } catch {
    return {}; // the file is being written
  }
}

function state(item, progress) {
  const done = progress[item.kind === "task" ? "tasks" : "questions"]?.[item.id];
  const name = item.id.replace(/^(ex)?\d+-/, "");
  if (item.kind === "question") {
    return { mark: done ? "✓" : "○", text: name, words: `question ${name}: ${done ? "answered" : "open"}` };
  }
  const points = done?.points ?? 0, of = done?.of ?? item.of;
  const mark = !done ? "○" : points >= of ? "✓" : "◐";
  const words = done ? `${points} of ${of} points` : "not checked yet";
  return { mark, text: `${name} ${done ? points : 0}/${of}`, words: `task ${name}: ${words}` };
}

export async function showProgress(panel, app, Widget) {
  const { context } = panel;
  await context.ready;
  if (!context.model.getMetadata("slamlab")) return;
  const items = tasksAndQuestions(context.model);
  if (!items.length) return;
  const bar = element("ul", "slamlab-progress");
  bar.setAttribute("aria-label", "Progress");
  panel.contentHeader.addWidget(new Widget({ node: bar }));

  const folder = context.path.split("/").slice(0, -2).join("/");
  let shown = "";
  const update = async () => {
    const progress = await read(app.serviceManager.contents, folder);
    const states = items.map((item) => state(item, progress));
    if (JSON.stringify(states) === shown || panel.isDisposed) return;
    shown = JSON.stringify(states);
    bar.replaceChildren(...states.map(({ mark, text, words }) => {
      const entry = element("li", "", `${mark} ${text}`);
      entry.title = words;
      return entry;
    }));
  };
  await update();
  // the kernel writes while it is busy with a check or an answer
  panel.sessionContext.statusChanged.connect((_, status) => { if (status === "idle") update(); });
}
