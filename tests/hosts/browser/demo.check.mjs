// SPDX-License-Identifier: Apache-2.0
// A visitor of the demo, opened from a folder: pushes the needle in with the mouse, has the proof
// computed, tries the other scenes. Prints what was seen as JSON.
//
//   node demo.check.mjs PAGE PLAYWRIGHT CHROMIUM
const [page_file, playwright, executablePath] = process.argv.slice(2);
const { chromium } = await import(playwright);

const browser = await chromium.launch({ executablePath,
  args: ["--no-sandbox", "--enable-unsafe-swiftshader", "--use-angle=swiftshader"] });
const page = await browser.newPage({ viewport: { width: 1000, height: 700 } });
const seen = { errors: [], phases: [], ticks: [] };
page.on("pageerror", (error) => seen.errors.push(error.message));
page.on("request", (request) => {
  if (!/^(file|data|blob):/.test(request.url())) seen.errors.push(`asks for ${request.url()}`);
});
await page.goto(`file://${page_file}`);
const frame = () => page.evaluate(() => {
  const { frame } = window.stylet.store;
  const { phase, force } = frame?.needles[0] ?? {};
  return frame && { tick: frame.tick, phase, force };
});
const until = async (what, seconds = 120) => {
  for (const end = Date.now() + 1e3 * seconds; Date.now() < end;) {
    const now = await frame();
    if (now && what(now)) return now;
    await page.waitForTimeout(100);
  }
  throw new Error(`waited in vain: ${what}; ${JSON.stringify(await frame())}`);
};
const box = await page.locator("#scene-canvas").boundingBox();
for (const scene of [0, 1, 2]) {
  if (scene > 0) await page.selectOption("header select", String(scene));
  await page.waitForFunction((name) => window.stylet.store.hello?.scene === name,
    await page.locator("header option").nth(scene).innerText(), { timeout: 120000 });
  await until(({ tick }) => tick > 20);
  const [x, y] = [box.x + box.width / 2, box.y + 60];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x, y + 200, { steps: 40 });  // 40 mm
  await page.mouse.up();
  const inside = await until(({ phase }) => phase === 2);
  seen.phases.push(inside.phase);
  seen.ticks.push(inside.tick);
  seen.force = Math.hypot(...Object.values((await until(({ tick }) =>
    tick > inside.tick + 50)).force));
}
await page.getByRole("button", { name: "Compute it here, too" }).click();
await page.waitForSelector(".proof .same, .proof .other", { timeout: 120000 });
seen.same = await page.locator(".proof .same").count();
await browser.close();
console.log(JSON.stringify(seen));
