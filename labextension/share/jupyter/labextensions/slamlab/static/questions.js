// Questions of a notebook (classroom.checks.ask), found in the code of their cells.

// Question in a cell's code: {id, unit}, unit "" if there is none; undefined without a question.
export function questionIn(source) {
  const id = /\bask\(\s*["']([^"'\\]+)["']/.exec(source)?.[1];
  const unit = /\bunit=["']([^"'\\]*)["']/.exec(source)?.[1] ?? "";
  return id && { id, unit };
}
