// SPDX-License-Identifier: Apache-2.0
// The built page in Chromium, against a stand-in for the program.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import {after, before, test} from 'node:test';
import type {Browser, Page} from 'playwright-core';
import {materialColours} from '../../../hal/console/page/src/palette';
import {exactOf, launch, open, scrub, shown, valueOf} from './browser_support';
import {makeUpOrgan} from './made_up_organ';
import {MockServer, movedAt, truthAt, type MockOptions} from './mock_server';

const kUnit = 4e-6;
const kDist = join(kPage, 'dist');
const organ = makeUpOrgan(0.009, 40);
let browser: Browser;
const servers: MockServer[] = [];

before(async () => {
  browser = await launch();
});
after(async () => {
  await browser.close();
  for (const server of servers) await server.end();
});

async function serve(options: Partial<MockOptions> = {}): Promise<MockServer> {
  const server = new MockServer({dist: kDist, organ, framesPerSecond: 30, ...options});
  servers.push(server);
  await server.begin();
  return server;
}

// Polls: what the server heard comes over a socket.
async function until(what: () => boolean, why: string): Promise<void> {
  for (let i = 0; i < 600; ++i) {
    if (what()) return;
    await new Promise((done) => setTimeout(done, 100));
  }
  assert.fail(why);
}

test(
    'a recording: nothing from elsewhere, surface as the CPU says, force exactly as recorded',
    async () => {
      const server = await serve({recordingTicks: 16000});
      const {page, errors, foreign} = await open(browser, `${server.url}?token=a%26b#teacher`);
      await shown(page);
      assert.deepEqual(server.organAsked, ['/organ?token=a%26b']);

      for (const tick of [7000, 12, 15999, 1599, 1600, 9007]) {
        await scrub(page, tick);
        const truth = truthAt(tick);
        await page.waitForFunction(
            (t) => document.querySelector('[data-value=tick]')?.textContent === String(t), tick);
        const told = (await exactOf(page, 'vector')).replace(' N', '').split(', ').map(Number);
        assert.deepEqual(told.map(Math.fround), truth.force.map((v) => (v === 0 ? 0 : v)));
        const read = (await valueOf(page, 'vector')).replace(' N', '').split(', ');
        assert.ok(
            read.every((v, k) => /^-?\d+\.\d{3}$/.test(v) && Math.abs(Number(v) - told[k]) < 6e-4));
        await page.waitForFunction((t) => {
          const {store} = window.stylet;
          return store.rows.near(t)?.tick === t;
        }, tick);
        await page.waitForFunction(
            () => document.querySelector<HTMLElement>('[data-value=axial]')?.title !== '');
        const axial = Math.fround(Number.parseFloat(await exactOf(page, 'axial')));
        assert.equal(axial, truth.axial === 0 ? 0 : truth.axial);
      }

      await scrub(page, 7000);
      for (const byGpu of [true, false]) {
        const largest = await page.evaluate(deviation, byGpu);
        assert.ok(largest.moved > 1e-3, 'the made-up surface moved');
        assert.ok(largest.apart < 1e-4, `${largest.apart} m`);
        assert.ok(largest.apart < 1e-6, 'and far better than the 0.1 mm that were asked');
      }
      const expected = movedAt(organ, 7000);
      const held = await page.evaluate(() => Array.from(window.stylet.store.moved));
      for (let i = 0; i < expected.length / 3; i += 97) {
        for (let k = 0; k < 3; ++k) assert.equal(held[4 * i + k], expected[3 * i + k]);
      }

      await exportsAreWhole(page);
      assert.deepEqual(foreign, []);
      assert.deepEqual(errors, []);
      await page.context().close();
    });

// In the page: how far the surface is from the trilinear one in double precision, in m.
function deviation(byGpu: boolean): {apart: number; moved: number} {
  const {store, view} = window.stylet;
  const {organ: of, hello} = store;
  const places = view()?.deformedVertices(byGpu);
  if (!of || !hello || !places || places.length !== of.vertexRest.length)
    throw new Error('no view');
  let [apart, most] = [0, 0];
  for (let v = 0; v < of.vertexVoxel.length; ++v) {
    const f = of.vertexFraction.subarray(3 * v, 3 * v + 3);
    for (let k = 0; k < 3; ++k) {
      let moved = 0;
      for (let c = 0; c < 8; ++c) {
        const particle = hello.corners[8 * of.vertexVoxel[v] + c];
        const weight =
            (c & 1 ? f[0] : 1 - f[0]) * (c & 2 ? f[1] : 1 - f[1]) * (c & 4 ? f[2] : 1 - f[2]);
        moved += weight * store.moved[4 * particle + k] * hello.positionUnit;
      }
      most = Math.max(most, Math.abs(moved));
      apart = Math.max(apart, Math.abs(of.vertexRest[3 * v + k] + moved - places[3 * v + k]));
    }
  }
  return {apart, moved: most};
}

async function exportsAreWhole(page: Page): Promise<void> {
  const tools = page.locator('.plots .plot-tools').first();
  const files: Buffer[] = [];
  for (const kind of ['PNG', 'SVG', 'CSV']) {
    const [download] = await Promise.all([
      page.waitForEvent('download'),
      tools.getByText(kind, {exact: true}).click(),
    ]);
    assert.equal(download.suggestedFilename(), `force-time.${kind.toLowerCase()}`);
    files.push(readFileSync(await download.path()));
  }
  assert.equal(files[0].toString('latin1', 1, 4), 'PNG');
  assert.ok(files[0].length > 5000);
  assert.match(files[1].toString(), /^<svg[\s\S]*Puncture: liver[\s\S]*<\/svg>\s*$/);
  const [head, ...lines] = files[2].toString().trim().split('\n').map((line) => line.split(','));
  const [tickAt, forceAt] = [head.indexOf('tick'), head.indexOf('force_n')];
  assert.ok(lines.length > 1000);
  for (const line of lines) {
    const force = Math.fround(Number(line[forceAt]));
    assert.equal(force, truthAt(Number(line[tickAt])).axial || 0);
  }
}

test(
    'by keyboard alone: every control is reached, named and seen; attempts, marks, report',
    async () => {
      const server = await serve();
      const {page, errors} = await open(browser, `${server.url}#trainee`, {still: true});
      await shown(page);
      await page.keyboard.press('Tab');
      assert.equal(await page.evaluate(() => document.activeElement?.className), 'skip');
      for (const view of ['trainee', 'teacher', 'engineer']) {
        await page.keyboard.press(`Alt+${['trainee', 'teacher', 'engineer'].indexOf(view) + 1}`);
        assert.equal(await page.evaluate(() => document.body.dataset.view), view);
        await walk(page);
      }
      await page.locator('#tab-engineer').focus();
      await page.keyboard.press('ArrowLeft');
      assert.equal(await page.evaluate(() => document.activeElement?.id), 'tab-teacher');

      await page.locator('#scene-canvas').focus();
      await page.keyboard.press(' ');
      await until(() => server.heard.includes('Start'), 'Space starts');
      await page.waitForFunction(() => (window.stylet.store.frame?.tick ?? 0) > 300);
      await page.keyboard.press('m');
      await page.keyboard.type('<b>too fast</b>');
      await page.keyboard.press('Enter');
      await page.locator('.marks-list').getByText('<b>too fast</b>').waitFor();
      await page.locator('#scene-canvas').focus();
      await page.keyboard.press(' ');
      await until(() => server.heard.includes('Pause'), 'Space pauses');
      await page.waitForFunction(() => window.stylet.store.frame?.activity === 2);
      for (let attempt = 1; attempt <= 2; ++attempt) {
        await page.locator('.controls').getByText('Reset').press('Enter');
        await page.waitForFunction((n) => window.stylet.store.scores.length === n, attempt);
        if (attempt === 2) break;
        await page.waitForFunction(() => window.stylet.store.frame?.activity === 0);
        await page.locator('.controls .primary').press('Enter');
        await page.waitForFunction(() => (window.stylet.store.frame?.tick ?? 0) > 200);
      }
      await page.locator('.compare table').waitFor();
      assert.equal(await page.locator('.compare tbody tr').count(), 12);
      await page.keyboard.press('Alt+4');
      assert.equal(await page.locator('.report figure canvas').count(), 2);
      await page.emulateMedia({media: 'print'});
      assert.equal(await page.locator('.top').isVisible(), false);
      assert.equal(await page.locator('.report').isVisible(), true);
      await page.emulateMedia({media: 'screen'});
      await page.keyboard.press('?');
      assert.equal(await page.locator('dialog').isVisible(), true);
      await page.keyboard.press('Escape');
      assert.equal(await page.locator('dialog').isVisible(), false);
      assert.deepEqual(errors, []);
      await page.context().close();
    });

// Tab through the whole page once: what can be used has a name, and shows that it has the focus.
async function walk(page: Page): Promise<void> {
  const wanted = await page.evaluate(() => {
    const all = 'button, select, input, [tabindex="0"]';
    const usable = [...document.querySelectorAll<HTMLButtonElement>(all)].filter(
        (e) => e.checkVisibility() && !e.disabled && e.tabIndex >= 0);
    usable.forEach((e, i) => (e.dataset.walk = String(i)));
    document.body.tabIndex = -1;
    document.body.focus();
    return usable.length;
  });
  assert.ok(wanted > 8);
  const seen = new Set<string>();
  for (let i = 0; i < wanted + 4; ++i) {
    await page.keyboard.press('Tab');
    const at = await page.evaluate(() => {
      const e = document.activeElement as HTMLInputElement;
      const label = e.labels?.[0]?.textContent ?? '';
      const name = e.getAttribute('aria-label') ?? (label || e.textContent || '');
      const outline = getComputedStyle(e).outlineStyle !== 'none';
      return {walk: e.dataset.walk, name: name.trim(), outline, html: e.outerHTML.slice(0, 120)};
    });
    if (at.walk === undefined) continue;
    seen.add(at.walk);
    assert.ok(at.outline, `focus is not seen: ${at.html}`);
    assert.ok(at.name !== '' || at.html.includes('plot-place'), `no name: ${at.html}`);
  }
  assert.equal(seen.size, wanted);
  await page.evaluate(() => {
    document.body.removeAttribute('tabindex');
    for (const e of document.querySelectorAll<HTMLElement>('[data-walk]')) delete e.dataset.walk;
  });
}

test(
    'a lost connection is said and comes back; what is garbled or hostile does nothing',
    async () => {
      const first = await serve();
      const {page, errors} = await open(browser, `${first.url}#teacher`);
      await shown(page);
      first.say(new TextEncoder().encode('\u0000garbage that is no message'));
      await page.locator('.notices').getByText('could not be read').waitFor();
      first.refuse('<img src=x onerror="window.hacked = true"> expected a scene');
      await page.locator('.notices').getByText('<img src=x').waitFor();
      assert.equal(await page.locator('.notices img').count(), 0);
      const {port} = first;
      await first.end();
      await page.locator('.banner').getByText('Connection lost').waitFor();
      const second = new MockServer({dist: kDist, organ});
      servers.push(second);
      await second.begin(port);
      await page.locator('.banner').waitFor({state: 'hidden'});
      assert.equal(await page.evaluate(() => 'hacked' in window), false);
      assert.deepEqual(errors.filter((e) => !/WebSocket connection/.test(e)), []);
      await page.context().close();

      const other = await serve({protocol: 1});
      const wrong = await open(browser, other.url);
      await wrong.page.locator('.banner').getByText('protocol 1, this page protocol 2').waitFor();
      await wrong.page.context().close();
    });

// In the page: draws now, and gives the colours that stand at shares of the canvas, right and down,
// or at the middle of the needle's part in tissue.
function drawn(shares: (number[]|'inside')[]): number[][] {
  const view = window.stylet.view();
  const gl = view?.canvas.getContext('webgl2');
  const needle = window.stylet.store.frame?.needles[0];
  if (!view || !gl || !needle) throw new Error('no view');
  view.always = true;
  view.step();
  view.always = false;
  const {clientWidth, clientHeight, width, height} = view.canvas;
  return shares.map((share) => {
    const [a, b] = needle.nodes.slice(-2);
    const middle = {x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, z: (a.z + b.z) / 2};
    const at = share === 'inside' ? view.project(middle) :
                                    {x: share[0] * clientWidth, y: share[1] * clientHeight};
    const pixel = new Uint8Array(4);
    const [x, y] = [(at?.x ?? 0) / clientWidth, 1 - (at?.y ?? 0) / clientHeight];
    gl.readPixels(
        Math.floor(x * width), Math.floor(y * height), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    return [...pixel];
  });
}

const near = (a: number[], b: number[], most: number) =>
    a.every((v, k) => Math.abs(v - b[k]) <= most);

// How far a colour is from grey.
const spread = (pixel: number[]) => Math.max(...pixel.slice(0, 3)) - Math.min(...pixel.slice(0, 3));
const bytes = (hex: string) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
// A flat face in the tissue's colour, lit by less than full light; each voxel by a little more or
// less than its neighbours.
const kFaceOfLiver = [...bytes(materialColours(['liver'])[0]).map((v) => 0.86 * v), 255];

// The same by the processor and by the shader: solid, cut open at the needle, cut away, x-ray.
test('solid, cut and x-ray show what they are for, whoever deforms', async () => {
  const server = await serve({recordingTicks: 16000});
  const kGrid = Array.from({length: 15 * 11}, (_, i) => [(i % 15 + 0.5) / 15, (i / 15) / 11]);
  const seen: number[][][] = [];
  for (const card of [false, true]) {
    const {page, errors} = await open(browser, `${server.url}#teacher`, {card, still: true});
    await shown(page);
    assert.equal(await page.evaluate(() => window.stylet.view()?.byGpu), card);
    await scrub(page, 7000);
    const looks: number[][] = [];
    const look = async (change: object) => {
      await page.evaluate((to) => window.stylet.view()?.setLook(to), change);
      const [inside, ...grid] = await page.evaluate(drawn, ['inside', ...kGrid] as number[][]);
      looks.push(...grid);
      return inside;
    };
    const solid = await look({xray: false, cut: false});
    assert.ok(spread(solid) > 40, `solid: the liver hides the needle: ${solid}`);
    const cut = await look({cut: true});
    assert.ok(spread(cut) < 40, `cut: the needle's grey is seen: ${cut}`);
    const [wall] = await page.evaluate(drawn, [[0.5, 0.35]]);
    assert.ok(near(wall, kFaceOfLiver, 5), `cut: the face is that of its tissue: ${wall}`);
    const away = await look({cutAt: 1});
    assert.ok(near(away, cut, 40), `cut away: the needle stays: ${away}`);
    const [gone] = await page.evaluate(drawn, [[0.5, 0.35]]);
    assert.equal(gone[3], 0, 'cut away: nothing is left of the liver');
    const xray = await look({cut: false, xray: true});
    assert.ok(!near(xray, solid, 20), 'x-ray: the needle shows through');
    const [thin] = await page.evaluate(drawn, [[0.5, 0.35]]);
    assert.ok(thin[3] > 0 && thin[3] < 255, `x-ray: light comes through: ${thin}`);
    seen.push(looks);
    assert.deepEqual(errors, []);
    await page.context().close();
  }
  const [processor, gpu] = seen;
  const other = processor.filter((pixel, i) => !near(pixel, gpu[i], 12)).length;
  assert.ok(other <= 0.03 * processor.length, `${other} of ${processor.length} pixels differ`);
});

test('presets move the camera, and at once where less motion is asked for', async () => {
  const server = await serve();
  for (const still of [false, true]) {
    const {page} = await open(browser, `${server.url}#trainee`, {still});
    await shown(page);
    const places = await page.evaluate(() => {
      const camera = window.stylet.view()?.cameraMan.camera;
      const from = camera?.position.toArray();
      window.stylet.view()?.preset('above');
      return [from, camera?.position.toArray()];
    });
    await page.waitForTimeout(700);
    const end =
        await page.evaluate(() => window.stylet.view()?.cameraMan.camera.position.toArray());
    const apart = (a?: number[], b?: number[]) =>
        Math.hypot(...(a ?? []).map((v, k) => v - (b?.[k] ?? 0)));
    assert.ok(apart(places[0], end) > 0.05);
    assert.equal(apart(places[1], end) < 1e-9, still);
    await page.context().close();
  }
});

test('on a touch screen one finger pushes and two roll', async () => {
  const server = await serve({device: 'pointer:'});
  const {page, errors} =
      await open(browser, `${server.url}#trainee`, {touch: true, width: 1024, height: 768});
  await shown(page);
  await page.locator('.pad').scrollIntoViewIfNeeded();
  const box = await page.locator('.pad').boundingBox();
  assert.ok(box);
  const touch = await page.context().newCDPSession(page);
  const send = (type: 'touchStart'|'touchMove'|'touchEnd', ...spots: number[][]) =>
      touch.send('Input.dispatchTouchEvent', {
        type,
        touchPoints: spots.map(([x, y], id) => ({x: box.x + x, y: box.y + y, id})),
      });
  const last = () => server.pointers[server.pointers.length - 1];
  await send('touchStart', [100, 150]);
  for (let y = 140; y >= 90; y -= 10) await send('touchMove', [100, y]);
  await until(
      () => Math.abs((last()?.z ?? 0) + 60 * 0.25e-3) < 1e-5 && last().buttons === 1,
      'a finger pushes by a quarter of a millimetre a pixel');
  const pushed = last().z;
  await send('touchStart', [100, 90], [180, 90]);
  for (let y = 100; y <= 170; y += 10) await send('touchMove', [100, 90], [180, y]);
  await until(() => Math.abs(last().roll - 45) < 0.5, 'two roll, by 45 degrees');
  assert.ok(Math.abs(last().z - pushed) < 1e-9, 'and do not push');
  await send('touchEnd');
  await until(() => last().buttons === 0, 'let go');
  assert.deepEqual(errors, []);
  await page.context().close();
});

test('the pointer is the needle: drag pushes, wheel rolls, keys do both', async () => {
  const server = await serve({device: 'pointer:'});
  const {page, errors} = await open(browser, `${server.url}#trainee`);
  await shown(page);
  const box = await page.locator('.pad').boundingBox();
  assert.ok(box);
  await page.mouse.move(box.x + 100, box.y + 150);
  await page.mouse.down();
  await page.mouse.move(box.x + 100, box.y + 90, {steps: 6});
  const last = () => server.pointers[server.pointers.length - 1];
  await until(() => (last()?.z ?? 0) < -0.01 && last().buttons === 1, 'a drag up pushes');
  assert.ok(Math.abs(last().z + 60 * 0.25e-3) < 1e-5, 'by a quarter of a millimetre a pixel');
  await page.mouse.up();
  await until(() => last().buttons === 0, 'let go');
  // A second stroke, and over the picture of the needle, which a browser would drag away.
  const stem = await page.locator('.stem').boundingBox();
  assert.ok(stem);
  await page.mouse.move(stem.x + 1, stem.y + 20);
  await page.mouse.down();
  await page.mouse.move(stem.x + 1, stem.y - 20, {steps: 8});
  await until(
      () => Math.abs(last().z + 100 * 0.25e-3) < 1e-5 && last().buttons === 1,
      'a second stroke pushes on');
  await page.mouse.up();
  await until(() => last().buttons === 0, 'let go again');
  await page.mouse.wheel(0, 200);
  await until(() => Math.abs(last().roll - 30) < 0.1, 'the wheel rolls 15 degrees a notch');
  await page.locator('.pad').focus();
  const before = last().z;
  await page.keyboard.down('KeyS');
  await until(() => last().z > before + 1e-3, 'S pulls');
  await page.keyboard.up('KeyS');
  assert.deepEqual(errors, []);
  await page.context().close();
});

test('an attempt by pointer is ended by a button; marks, roll and way survive', async () => {
  const server = await serve({device: 'pointer:'});
  const {page, errors} = await open(browser, `${server.url}#trainee`);
  await shown(page);
  assert.equal(await page.getByText('End', {exact: true}).isDisabled(), true);
  await page.locator('.controls .primary').click();
  await page.waitForFunction(() => (window.stylet.store.frame?.tick ?? 0) > 300);
  const box = await page.locator('.pad').boundingBox();
  assert.ok(box);
  await page.mouse.move(box.x + 100, box.y + 150);
  await page.mouse.wheel(0, 200);
  const last = () => server.pointers[server.pointers.length - 1];
  await until(() => Math.abs((last()?.roll ?? 0) - 30) < 0.1, 'rolled');
  await page.keyboard.press('m');
  await page.keyboard.type('first');
  await page.keyboard.press('Enter');

  // In the middle of an attempt the browser asks before it leaves; then the page goes on with it.
  let asked = 0;
  page.on('dialog', (dialog) => {
    ++asked;
    void dialog.accept();
  });
  const before = server.pointers.length;
  await page.reload({waitUntil: 'commit'});
  await shown(page);
  assert.equal(asked, 1);
  await until(() => server.pointers.length > before && Math.abs(last().roll - 30) < 0.1, 'still');
  assert.match(await page.locator('.pad-words').innerText(), /Tip -?[0-9.]+ mm (past|before)/);

  // Views are places that Back returns to.
  await page.keyboard.press('Alt+1');
  await page.keyboard.press('Alt+2');
  await page.keyboard.press('m');
  await page.keyboard.type('second');
  await page.keyboard.press('Enter');
  await page.goBack();
  assert.equal(await page.evaluate(() => document.body.dataset.view), 'trainee');
  await page.goForward();
  assert.equal(await page.evaluate(() => document.body.dataset.view), 'teacher');

  await page.getByText('End', {exact: true}).click();
  await until(() => server.heard.includes('End'), 'End ends');
  for (let attempt = 2; attempt <= 6; ++attempt) {
    await page.waitForFunction((n) => window.stylet.store.scores.length === n, attempt - 1);
    await page.locator('.controls .primary').click();
    await page.waitForFunction(() => window.stylet.store.frame?.activity === 1);
    await page.getByText('End', {exact: true}).click();
  }
  await page.waitForFunction(() => window.stylet.store.scores.length === 6);
  await page.locator('.marks-list').getByText('Attempt 1').waitFor();
  await page.locator('.marks-list').getByText('second').waitFor();

  // On paper no column is cut off.
  await page.keyboard.press('Alt+4');
  await page.emulateMedia({media: 'print'});
  await page.setViewportSize({width: 660, height: 900});  // an A4 page less its margins, at 96 dpi
  const cut = await page.evaluate(
      () => [...document.querySelectorAll('.report .wide')]
                .filter((e) => e.scrollWidth > e.clientWidth + 1)
                .length);
  assert.equal(cut, 0);
  const heads = await page.locator('.report thead th').allInnerTexts();
  for (let attempt = 1; attempt <= 6; ++attempt)
    assert.ok(heads.includes(`Attempt ${attempt}`), `attempt ${attempt} is in the report`);
  await page.locator('.report').getByText('second').waitFor();
  assert.deepEqual(errors, []);
  await page.context().close();
});
