// SPDX-License-Identifier: Apache-2.0
// Visitors of the demo, opened from a folder. One pushes the needle in with the mouse, has the
// proof computed, tries the other scenes; one has a telephone and a thumb. Tells what was seen as
// JSON.
//
// Given an address instead of a file, it tells what is said of threads where there are four
// processors.
//
//   node demo.check.mjs PAGE|ADDRESS PLAYWRIGHT CHROMIUM
const [page_file, playwright, executablePath] = process.argv.slice(2);
const { chromium } = await import(playwright);

const browser = await chromium.launch({ executablePath,
  args: ["--no-sandbox", "--enable-unsafe-swiftshader", "--use-angle=swiftshader"] });
const seen = { errors: [], phases: [], ticks: [], hidden: [], wide: [] };

async function visit(options) {
  const context = await browser.newContext(options);
  const page = await context.newPage();
  page.on("pageerror", (error) => seen.errors.push(error.message));
  page.on("request", (request) => {
    if (!/^(file|data|blob):/.test(request.url())) seen.errors.push(`asks for ${request.url()}`);
  });
  await page.goto(`file://${page_file}`);
  return page;
}

const frame = (page) => page.evaluate(() => {
  const { frame } = window.stylet.store;
  const { phase, force } = frame?.needles[0] ?? {};
  return frame && { tick: frame.tick, phase, force };
});

async function until(page, what, seconds = 120) {
  for (const end = Date.now() + 1e3 * seconds; Date.now() < end;) {
    const now = await frame(page);
    if (now && what(now)) return now;
    await page.waitForTimeout(100);
  }
  throw new Error(`waited in vain: ${what}; ${JSON.stringify(await frame(page))}`);
}

async function choose(page, scene) {
  if (scene > 0) await page.selectOption("header select", String(scene));
  await page.waitForFunction((name) => window.stylet.store.hello?.scene === name,
    await page.locator("header option").nth(scene).innerText(), { timeout: 120000 });
  await until(page, ({ tick }) => tick > 20);
}

async function with_a_mouse() {
  const page = await visit({ viewport: { width: 1000, height: 700 } });
  for (const scene of [0, 1, 2]) {
    await choose(page, scene);
    const box = await page.locator("#scene-canvas").boundingBox();
    const [x, y] = [box.x + box.width / 4, box.y + 100];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 220, y, { steps: 40 });  // along the needle, as far as it goes
    await page.mouse.up();
    const inside = await until(page, ({ phase }) => phase === 2);
    seen.phases.push(inside.phase);
    seen.ticks.push(inside.tick);
    seen.force = Math.hypot(...Object.values((await until(page, ({ tick }) =>
      tick > inside.tick + 50)).force));
  }
  await page.getByRole("button", { name: "Compute it here as well" }).click();
  await page.waitForSelector(".proof .same, .proof .other", { timeout: 120000 });
  seen.same = await page.locator(".proof .same").count();
  await page.context().close();
}

// Controls that a thumb cannot hit: under others, outside the picture, or too small.
const out_of_reach = (page) => page.evaluate(() => {
  const shown = [...document.querySelectorAll("button, select, input")]
    .filter((each) => each.checkVisibility());
  return shown.filter((each) => {
    each.scrollIntoView({ block: "center" });
    const { left, right, top, height, width } = each.getBoundingClientRect();
    const hit = document.elementFromPoint(left + width / 2, top + height / 2);
    return left < 0 || right > innerWidth || height < 24 || width < 24 || !each.contains(hit);
  }).map((each) => each.textContent || each.getAttribute("aria-label"));
});

async function with_a_thumb() {
  const page = await visit({ viewport: { width: 390, height: 844 }, hasTouch: true,
    isMobile: true, deviceScaleFactor: 2 });
  const touch = await page.context().newCDPSession(page);
  const send = (type, ...spots) => touch.send("Input.dispatchTouchEvent", { type,
    touchPoints: spots.map(([x, y], id) => ({ x, y, id })) });
  for (const scene of [0, 2]) {
    await choose(page, scene);
    seen.hidden.push(...await out_of_reach(page));
    seen.wide.push(await page.evaluate(() => document.documentElement.scrollWidth));
    await page.evaluate(() => scrollTo(0, 0));
    seen.hint = await page.locator(".hint").innerText();
    const box = await page.locator("#scene-canvas").boundingBox();
    const [x, y] = [box.x + 60, box.y + box.height / 2];
    await send("touchStart", [x, y]);
    for (let by = 0; by <= 200; by += 5) await send("touchMove", [x + by, y]);
    await send("touchEnd");
    seen.phases.push((await until(page, ({ phase }) => phase === 2)).phase);
  }
  const turn = await page.getByRole("button", { name: "Roll right" }).boundingBox();
  const roll = () => page.evaluate(() => window.stylet.hand.aim.rollRad);
  const before = await roll();
  await send("touchStart", [turn.x + turn.width / 2, turn.y + turn.height / 2]);
  await page.waitForTimeout(500);
  await send("touchEnd");
  seen.rolled = await roll() - before;
  await page.context().close();
}

async function from_a_server() {
  const page = await browser.newPage();
  await page.addInitScript(() =>
    Object.defineProperty(navigator, "hardwareConcurrency", { value: 4 }));
  await page.goto(page_file);
  await until(page, ({ tick }) => tick > 20);
  seen.said = await page.locator(".scene-numbers").innerText();
  await page.getByRole("button", { name: "Start again" }).click(); // the same threads again
  await until(page, ({ tick }) => tick < 20);
  await until(page, ({ tick }) => tick > 20);
}

if (page_file.startsWith("http:")) {
  await from_a_server();
} else {
  await with_a_mouse();
  await with_a_thumb();
}
await browser.close();
console.log(JSON.stringify(seen));
