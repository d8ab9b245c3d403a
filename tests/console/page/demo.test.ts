// SPDX-License-Identifier: Apache-2.0
// The demo's pace, on a clock of its own: how many pictures, and of how many pixels.
import assert from 'node:assert/strict';
import {test} from 'node:test';

import {Pace} from '../../../hal/console/page/demo/pace';

// A browser that offers 60 pictures a second, as long as `seconds`, from a time on.
function run(pace: Pace, from: number, seconds: number, speed: (now: number) => number, every = 1):
    {drawn: number, scales: number[]} {
  const scales: number[] = [];
  let drawn = 0;
  for (let i = 0; i < 60 * seconds; i += every) {
    const now = from + 1000 * i / 60;
    if (!pace.due(now)) continue;
    ++drawn;
    pace.see(now, speed(now));
    scales.push(pace.scale);
  }
  return {drawn, scales};
}

test('a processor draws 30 pictures a second, a card all', () => {
  assert.ok(Math.abs(run(new Pace(false), 0, 10, () => 1).drawn - 300) <= 2);
  assert.ok(Math.abs(run(new Pace(true), 0, 10, () => 1).drawn - 600) <= 2);
});

test('pictures become coarser as long as ticks stay behind, and no coarser than a limit', () => {
  const {scales} = run(new Pace(false), 0, 20, () => 0.8);
  assert.equal(scales[0], 1);
  scales.slice(1).forEach((scale, i) => assert.ok(scale <= scales[i]));
  const least = scales[scales.length - 1];
  assert.ok(least >= 0.5 && least < 0.8, String(least));
  const quick = run(new Pace(false), 0, 20, () => 1).scales;
  assert.ok(quick.every((scale) => scale === 1), 'and not where all is well');
});

test('they become coarser, too, where they are fewer than wanted', () => {
  assert.ok(run(new Pace(false), 0, 4, () => 1, 3).scales.at(-1)! < 1);
});

test('finer again when there is room, but what was too much is left alone for a while', () => {
  const pace = new Pace(false);
  const tooMuch = () => (pace.scale === 1 ? 0.9 : 1);
  const {scales} = run(pace, 0, 90, tooMuch);
  const tries = scales.filter((scale, i) => scale === 1 && scales[i - 1] !== 1).length;
  assert.ok(tries >= 2 && tries <= 4, `tried ${tries} times in 90 s`);
  const share = scales.filter((scale) => scale === 1).length / scales.length;
  assert.ok(share < 0.1, `${share} of all pictures were too fine`);
});

test('a page that was hidden is not judged by the time it was away', () => {
  const pace = new Pace(true);
  run(pace, 0, 3, () => 1);
  run(pace, 60000, 3, () => 1);
  assert.equal(pace.scale, 1);
});
