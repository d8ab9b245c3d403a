// SPDX-License-Identifier: Apache-2.0
// Formulas as HTML: JSON [[tex, displayed], ...] in, JSON of as many texts out. One that KaTeX does
// not understand ends it with the formula.
//
//   node book_formulas.mjs KATEX_FOLDER < formulas.json
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const { default: katex } = await import(pathToFileURL(join(process.argv[2], "katex.mjs")));
const made = JSON.parse(readFileSync(0, "utf8")).map(([tex, displayMode]) =>
  katex.renderToString(tex, { displayMode, throwOnError: true, strict: "ignore" }));
process.stdout.write(JSON.stringify(made));
