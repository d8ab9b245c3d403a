// SPDX-License-Identifier: Apache-2.0
// A reader of the book who opened it from a folder and has no network: looks at every page at two
// widths, at formulas, and at the search. Prints what was seen as JSON; with a folder as fourth
// argument it leaves pictures of the pages there.
//
//   node look.mjs SITE PLAYWRIGHT CHROMIUM [PICTURES] [PAGE...]
import { readdirSync } from "node:fs";
import { join, relative } from "node:path";

const [site, playwright, executablePath, pictures, ...only] = process.argv.slice(2);
const { chromium } = await import(playwright);
const kWidths = [1280, 390];

const pages = readdirSync(site, { withFileTypes: true, recursive: true })
  .map((entry) => relative(site, join(entry.parentPath ?? entry.path, entry.name)))
  .filter((name) => name.endsWith(".html") && !/^(api|source)\/|^404/.test(name))
  .filter((name) => only.length === 0 || only.includes(name));
const browser = await chromium.launch({ executablePath,
  args: ["--no-sandbox", "--disable-gpu", "--host-resolver-rules=MAP * ~NOTFOUND"] });
const page = await browser.newPage();
page.setDefaultTimeout(180000);
const seen = { pages: pages.length, faults: [], found: [] };
let name = "";
page.on("pageerror", (error) => seen.faults.push(`${name}: ${error.message}`));
page.on("console", (said) => {
  if (said.type() === "error") seen.faults.push(`${name}: ${said.text()}`);
});
page.on("request", (request) => {
  if (!/^(file|data|blob):/.test(request.url())) {
    seen.faults.push(`${name}: asks for ${request.url()}`);
  }
});
for (const width of kWidths) {
  await page.setViewportSize({ width, height: 900 });
  for (name of pages) {
    await page.goto(`file://${join(site, name)}`);
    const looked = await page.evaluate(() => ({
      wide: document.documentElement.scrollWidth - innerWidth,
      formulas: [...document.querySelectorAll(".katex-error")].map((one) => one.title),
      empty: [...document.images].filter((image) => image.naturalWidth === 0).length,
    }));
    if (looked.wide > 0) {
      seen.faults.push(`${name}: ${looked.wide} pixels wider than a window of ${width}`);
    }
    if (looked.empty > 0) seen.faults.push(`${name}: ${looked.empty} pictures are not there`);
    seen.faults.push(...looked.formulas.map((what) => `${name}: formula: ${what}`));
    if (pictures) {
      await page.screenshot({ path: join(pictures, `${name.replaceAll("/", "_")}.${width}.png`),
                              fullPage: true });
    }
  }
}
name = "search";
await page.setViewportSize({ width: 1280, height: 900 });
await page.goto(`file://${join(site, "index.html")}`);
await page.fill(".md-search__input", "watchdog");
await page.waitForSelector(".md-search-result__link", { timeout: 60000 });
seen.found = await page.$$eval(".md-search-result__link", (links) =>
  links.map((link) => link.getAttribute("href").split("/").slice(-2).join("/")));
await browser.close();
console.log(JSON.stringify(seen));
