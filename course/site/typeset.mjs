// Typeset formulas in one go: reads [[formula, displayed], …] as JSON, writes [{html} or {error}, …].
// The folder of node_modules is the first argument.
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";

const katex = createRequire(`${process.argv[2]}/`)("katex");
const set = ([formula, displayMode]) => {
  try {
    return { html: katex.renderToString(formula, { displayMode, strict: "ignore" }) };
  } catch (error) {
    return { error: error.message };
  }
};
process.stdout.write(JSON.stringify(JSON.parse(readFileSync(0, "utf-8")).map(set)));
