// SPDX-License-Identifier: Apache-2.0
// The page on the program itself: a recording played by `stylet console`. Its surface is the
// kernel's own, its force the recorded one, bit for bit.
import assert from 'node:assert/strict';
import {execFileSync, spawn, type ChildProcess} from 'node:child_process';
import {mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {createInterface} from 'node:readline';
import {test} from 'node:test';

import type {Page} from 'playwright-core';
import {vertexNormals} from '../../../hal/console/page/src/organ';
import {exactOf, launch, open, scrub, shown} from './browser_support';

const kBin = process.env.STYLET_BIN ?? '';
const kScene = join(kPage, '../../scenes/fig09-force-curve.toml');
const kTicks = [900, 3500, 7000, 9500];
const kNear = 1e-4;  // m, what was promised

interface Shape {
  tick: number;
  surface_m: number[][];
}

// Exactly what is in the file, as float32.
function recordedForces(recording: string): number[][] {
  const script = `import h5py, json, sys
f = h5py.File(sys.argv[1])
ticks = list(f["output/tick"][:])
rows = [ticks.index(int(tick)) for tick in sys.argv[2:]]
print(json.dumps([[float(v) for v in f["output/force_n"][row]] for row in rows]))`;
  const python = '/usr/bin/python3';
  return JSON.parse(String(execFileSync(python, ['-c', script, recording, ...kTicks.map(String)])));
}

// Angles in degrees between two lists of normals of any length, in order of size.
function anglesBetween(a: ArrayLike<number>, b: ArrayLike<number>): number[] {
  const angles: number[] = [];
  for (let i = 0; i < a.length; i += 3) {
    const [p, q] = [[a[i], a[i + 1], a[i + 2]], [b[i], b[i + 1], b[i + 2]]];
    const cosine = p.reduce((sum, v, k) => sum + v * q[k], 0) / Math.hypot(...p) / Math.hypot(...q);
    angles.push((180 / Math.PI) * Math.acos(Math.min(1, cosine)));
  }
  return angles.sort((x, y) => x - y);
}

// The normals that light the surface, beside those of the kernel's own.
async function judgeNormals(page: Page, own: number[], byGpu: boolean): Promise<void> {
  const shown = await page.evaluate(
      (gpu) => Array.from(window.stylet.view()?.deformedVertices(gpu, true) ?? []), byGpu);
  const [triangles, rest] = await page.evaluate(() => {
    const {organ} = window.stylet.store;
    return [Array.from(organ?.triangles ?? []), Array.from(organ?.vertexNormal ?? [])];
  });
  const truth = vertexNormals(Float32Array.from(own), Uint32Array.from(triangles));
  assert.equal(shown.length, truth.length);
  const [angles, still] = [anglesBetween(shown, truth), anglesBetween(rest, truth)];
  const at = (list: number[], share: number) => list[Math.floor(share * (list.length - 1))];
  console.log(
      `normals: 99 % within ${at(angles, 0.99).toFixed(2)} degrees, all within ` +
      `${at(angles, 1).toFixed(2)}; those at rest ${at(still, 0.99).toFixed(2)} and ` +
      `${at(still, 1).toFixed(2)}`);
  assert.ok(at(angles, 0.99) < 0.5 && at(angles, 1) < 2);
  const turned = at(still, 0.99) > 0.1;  // the surface had begun to bend
  assert.ok(!turned || at(angles, 0.99) < 0.5 * at(still, 0.99), 'better than those at rest');
}

async function serve(recording: string, organ: string): Promise<[ChildProcess, string]> {
  const words = ['console', recording, '--organ', organ, '--port', '0'];
  const program = spawn(join(kBin, 'stylet'), words, {stdio: ['ignore', 'pipe', 'inherit']});
  for await (const line of createInterface({input: program.stdout})) {
    const url = /http:\/\/\S+/.exec(line)?.[0];
    if (url !== undefined) return [program, url];
  }
  throw new Error('stylet console told no address');
}

test('the surface is the kernel\'s own to 0.1 mm, the force the recorded one', async () => {
  const folder = mkdtempSync(join(tmpdir(), 'stylet-page-'));
  const [organ, recording] = ['liver.organ', 'run.h5'].map((name) => join(folder, name));
  const run = (program: string, ...words: string[]) => execFileSync(
      join(kBin, program), words, {maxBuffer: 1 << 28, stdio: ['ignore', 'pipe', 'pipe']});
  run('stylet-organ', 'phantom', 'liver', '--voxel-mm', '8', '-o', organ);
  run('stylet', 'run', kScene, '--organ', organ, '--fast', '--record', recording);
  const {shapes} = JSON.parse(String(run('stylet-snapshot', recording, ...kTicks.map(String)))) as
      {shapes: Shape[]};
  const forces = recordedForces(recording);
  const [program, url] = await serve(recording, organ);
  const browser = await launch();
  try {
    const {page, errors, foreign} = await open(browser, `${url}#teacher`);
    await shown(page);
    for (const [i, tick] of kTicks.entries()) {
      await scrub(page, tick);
      await page.waitForFunction(
          (t) => document.querySelector('[data-value=tick]')?.textContent === String(t), tick);
      const told = (await exactOf(page, 'vector')).replace(' N', '').split(', ').map(Number);
      assert.deepEqual(told.map((v) => Math.fround(v) + 0), forces[i].map((v) => v + 0));
      const own = shapes[i].surface_m.flat();
      for (const byGpu of [true, false]) {
        const places = await page.evaluate(
            (gpu) => Array.from(window.stylet.view()?.deformedVertices(gpu) ?? []), byGpu);
        assert.equal(places.length, own.length);
        const apart = own.reduce((most, v, k) => Math.max(most, Math.abs(v - places[k])), 0);
        console.log(
            `tick ${tick}, by ${byGpu ? 'GPU' : 'processor'}: ${own.length / 3} vertices, ` +
            `at most ${(1e6 * apart).toFixed(1)} um apart`);
        assert.ok(apart < kNear, `tick ${tick}: ${apart} m`);
        await judgeNormals(page, own, byGpu);
      }
    }
    assert.deepEqual(foreign, []);
    assert.deepEqual(errors, []);
  } finally {
    await browser.close();
    program.kill();
    rmSync(folder, {recursive: true});
  }
});
