// SPDX-License-Identifier: Apache-2.0
// Pictures a second of 20 k voxels and 30 k triangles on software rendering at 1280 x 720, while
// every one of 60 frames a second moves all particles; and what of it each part takes.
//
// Other work on the machine makes pictures fewer, but not dearer: judged is the processor time that
// a picture costs in all of Chromium's processes, against that of kFastEnough pictures a second on
// two processors. Prints both.
import assert from 'node:assert/strict';
import {readdirSync, readFileSync} from 'node:fs';
import {join} from 'node:path';
import {test} from 'node:test';

import {launch, open, shown} from './browser_support';
import {makeUpOrgan} from './made_up_organ';
import {MockServer} from './mock_server';

const kFastEnough = 30;
const kSeconds = 5;
const kProcessors = 2;

// Processor time in ms of all descendants of this process whose program is Chromium.
function chromiumMs(): number {
  const stats = readdirSync('/proc').filter((name) => /^\d+$/.test(name)).flatMap((pid) => {
    try {
      const text = readFileSync(`/proc/${pid}/stat`, 'latin1');
      const [name, rest] = [
        text.slice(text.indexOf('(') + 1, text.lastIndexOf(')')),
        text.slice(text.lastIndexOf(')') + 2)
      ];
      const fields = rest.split(' ');
      return [{
        pid: Number(pid),
        name,
        parent: Number(fields[1]),
        ms: 10 * (Number(fields[11]) + Number(fields[12]))
      }];
    } catch {
      return [];  // ended meanwhile
    }
  });
  const mine = new Set([process.pid]);
  for (let grown = true; grown;) {
    const size = mine.size;
    for (const {pid, parent} of stats)
      if (mine.has(parent)) mine.add(pid);
    grown = mine.size > size;
  }
  return stats.filter((s) => mine.has(s.pid) && s.name.startsWith('chrom'))
      .reduce((sum, s) => sum + s.ms, 0);
}

test('a picture costs no more than 30 a second may', async () => {
  const organ = makeUpOrgan(0.00437, 88);
  const server = new MockServer({dist: join(kPage, 'dist'), organ});
  const browser = await launch();
  try {
    await server.begin();
    const {page} = await open(browser, `${server.url}#trainee`);
    await shown(page);
    await page.click('.controls .primary');
    await page.waitForFunction(() => (window.stylet.store.frame?.tick ?? 0) > 1500);
    const counted = () => page.evaluate(() => window.stylet.view()?.budget.pictures ?? 0);
    const [ms, pictures, began] = [chromiumMs(), await counted(), performance.now()];
    await new Promise((done) => setTimeout(done, 1000 * kSeconds));
    const drawn = (await counted()) - pictures;
    const seconds = (performance.now() - began) / 1000;
    const each = (chromiumMs() - ms) / drawn;
    const parts = await page.evaluate(() => {
      const view = window.stylet.view();
      if (view === null) return {};
      view.finish = true;
      return new Promise<Record<string, number>>(
          (done) => setTimeout(() => {
            const names = ['upload', 'bodies', 'draw'] as const;
            done(Object.fromEntries(names.map((name) => [name, view.budget.median(name)])));
          }, 2500));
    });
    console.log(
        `${organ.voxelCount} voxels, ${organ.triangleCount} triangles: ` +
        `${(drawn / seconds).toFixed(1)} pictures a second, ` +
        `${each.toFixed(1)} ms of processor each; parts in ms, GPU waited for: ` +
        Object.entries(parts).map(([name, t]) => `${name} ${t.toFixed(2)}`).join(', '));
    assert.ok(organ.voxelCount >= 20000 && organ.triangleCount >= 30000);
    assert.ok(drawn / seconds >= kFastEnough || each <= (1000 * kProcessors) / kFastEnough);
  } finally {
    await browser.close();
    await server.end();
  }
});
