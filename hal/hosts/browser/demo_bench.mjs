// SPDX-License-Identifier: Apache-2.0
// Pictures a second of the demo in Chromium without a graphics card, in a window of 1280 x 720 with
// a needle that goes to and fro in the liver: of each of four rounds, with the processors that all
// of Chromium used and the load of the machine, as other programs take from both.
//
//   node hal/hosts/browser/demo_bench.mjs [build/demo/index.html]
//
// Needs the npm packages of hal/console/page.
import os from "node:os";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";

import { chromium } from "../../console/page/node_modules/playwright-core/index.mjs";

const ROUNDS = 4, ROUND_S = 8, SWING_PX = 220, SWING_S = 2;

const page_file = resolve(process.argv[2] ?? "build/demo/index.html");
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader"] });
const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
await page.goto(pathToFileURL(page_file).href);
await page.waitForFunction(() => window.stylet?.store.frame?.tick > 20, undefined,
  { timeout: 120000 });

const system = await browser.newBrowserCDPSession();
async function counts() {
  const { processInfo } = await system.send("SystemInfo.getProcessInfo");
  const cpu_s = processInfo.reduce((sum, { cpuTime }) => sum + cpuTime, 0);
  return { cpu_s, ...await page.evaluate(() => {
    const view = window.stylet.view();
    return { at: performance.now(), pictures: view.budget.pictures, scale: view.scale,
      tick: window.stylet.store.frame.tick };
  }) };
}

const since = (at) => page.evaluate((at) => performance.now() - at, at);

const box = await page.locator("#scene-canvas").boundingBox();
const [x, y] = [box.x + box.width / 4, box.y + 100];
await page.mouse.move(x, y);
await page.mouse.down();
const said = (await page.locator(".scene-numbers").innerText()).replaceAll("\n", ", ");
console.log(`${os.cpus()[0].model}, ${os.cpus().length} processors, Chromium ` +
  `${browser.version()}; ${said}`);
for (let round = 0; round < ROUNDS; ++round) {
  const before = await counts();
  for (let now = 0; now < 1e3 * ROUND_S; now = await since(before.at)) {
    const share = (1 - Math.cos(2 * Math.PI * now / (1e3 * SWING_S))) / 2;
    await page.mouse.move(x + SWING_PX * share, y);
    await page.waitForTimeout(30);
  }
  const after = await counts();
  const seconds = (after.at - before.at) / 1e3;
  const pictures = (after.pictures - before.pictures) / seconds;
  console.log(`${pictures.toFixed(1)} pictures a second at ${after.scale} of the pixels each ` +
    `way, ${((after.tick - before.tick) / seconds).toFixed(0)} ticks a second, ` +
    `${((after.cpu_s - before.cpu_s) / seconds).toFixed(2)} processors, load ` +
    os.loadavg()[0].toFixed(1));
}
await browser.close();
