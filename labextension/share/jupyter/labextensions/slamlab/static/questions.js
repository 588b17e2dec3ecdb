// Questions of a notebook (slamlab.checks.ask), found in the code that asks them.

// The question that a cell's code asks: {id, unit}, unit "" where there is none; undefined if it asks nothing.
export function questionIn(source) {
  const id = /\bask\(\s*["']([^"'\\]+)["']/.exec(source)?.[1];
  const unit = /\bunit=["']([^"'\\]*)["']/.exec(source)?.[1] ?? "";
  return id && { id, unit };
}
