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
import {launch, open, scrub, shown, valueOf} from './browser_support';

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
      const told = (await valueOf(page, 'vector')).replace(' N', '').split(', ').map(Number);
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
