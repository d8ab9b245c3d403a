// SPDX-License-Identifier: Apache-2.0
// Opens a page and tells its texts once all are there, as JSON.
//
//   node page.check.mjs ADDRESS PLAYWRIGHT CHROMIUM
const [address, playwright, executablePath] = process.argv.slice(2);
const { chromium } = await import(playwright);
const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
const page = await browser.newPage();
page.on("pageerror", (error) => console.error(error.message));
await page.goto(address);
await page.waitForFunction(() =>
  [...document.querySelectorAll("pre")].every(({ textContent }) => textContent !== ""),
  undefined, { timeout: 120000 });
console.log(JSON.stringify(await page.locator("pre").allTextContents()));
await browser.close();
