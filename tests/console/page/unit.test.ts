// SPDX-License-Identifier: Apache-2.0
// The page's parts that need no browser.
import * as flatbuffers from 'flatbuffers';
import assert from 'node:assert/strict';
import {test} from 'node:test';
import * as THREE from 'three';

import * as wire from '../../../hal/console/page/generated/stylet/format/organ';
import {Run} from '../../../hal/console/page/generated/stylet/format/run';
import {Levels} from '../../../hal/console/page/generated/stylet/format/levels';
import {Sheets} from '../../../hal/console/page/generated/stylet/format/sheets';
import {waitMs} from '../../../hal/console/page/src/connection';
import {spread} from '../../../hal/console/page/src/labels';
import {materialColours} from '../../../hal/console/page/src/palette';
import {croppedFaces, slice} from '../../../hal/console/page/src/view3d/caps';

import {csv, figureSvg, ticksOf, type Figure} from '../../../hal/console/page/src/figure';
import {
  isOpen,
  misfit,
  OrganError,
  outerEdges,
  readOrgan,
  vertexNormals
} from '../../../hal/console/page/src/organ';
import type {Organ} from '../../../hal/console/page/src/organ';
import {phaseSpans} from '../../../hal/console/page/src/phases';
import {
  ask,
  decode,
  type Frame,
  type Hello,
  type Row
} from '../../../hal/console/page/src/protocol';
import {exactText, Series, thin} from '../../../hal/console/page/src/series';
import {makeUpOrgan} from './made_up_organ';
import {MockServer, truthAt} from './mock_server';

const kSmall = makeUpOrgan(0.016, 14);
const server = new MockServer({dist: '', organ: kSmall, recordingTicks: 16000});

const rowOf = (tick: number, force: number): Row => ({
  tick,
  depth: 0,
  travel: truthAt(tick).travel,
  force,
  lateral: 0,
  stiffness: 0,
  cutting: 0,
  friction: 0,
  clamping: 0,
  obstacle: 0,
  tickUs: 0,
  lateUs: 0,
  needle: 0,
});

// Repeatable pseudo-random numbers (mulberry32).
function random(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

const buffer = (bytes: Uint8Array): ArrayBuffer =>
    bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength) as ArrayBuffer;

test('a float32 is told exactly, and as short as it can be', () => {
  const next = random(1);
  const view = new DataView(new ArrayBuffer(4));
  for (let i = 0; i < 20000; ++i) {
    view.setUint32(0, Math.floor(next() * 2 ** 32));
    const value = view.getFloat32(0);
    if (!Number.isFinite(value)) continue;
    assert.equal(Math.fround(Number(exactText(value))), value);
  }
  assert.equal(exactText(Math.fround(0.1)), '0.1');
  assert.equal(exactText(-1.5), '-1.5');
  assert.equal(exactText(0), '0');
});

test('rows keep the order of their ticks, each once, whatever the order of arrival', () => {
  const next = random(2);
  const series = new Series();
  const seen = new Map<number, number>();
  for (let i = 0; i < 9000; ++i) {
    const [tick, force] = [Math.floor(next() * 6000), next()];
    series.add(rowOf(tick, force));
    seen.set(tick, force);
  }
  const ticks = [...series.column('tick')];
  assert.deepEqual(ticks, [...seen.keys()].sort((a, b) => a - b));
  series.column('force').forEach((force, i) => assert.equal(force, seen.get(ticks[i])));
  assert.equal(series.near(ticks[17])?.tick, ticks[17]);
  assert.equal(new Series().near(3), null);
});

test('thinning loses neither the ends nor the extremes', () => {
  const values = Float64Array.from({length: 100000}, (_, i) => Math.sin(i / 900));
  values[54321] = 7;
  values[12345] = -9;
  const kept = thin(values, 10, 99990, 300);
  assert.ok(kept.length <= 1200);
  for (const index of [10, 99989, 54321, 12345]) assert.ok(kept.includes(index));
  assert.ok(kept.every((index, i) => i === 0 || index > kept[i - 1]));
  assert.deepEqual(thin(values, 3, 6, 300), [3, 4, 5]);
  assert.deepEqual(thin(values, 3, 3, 300), []);
});

test('a frame arrives as it was sent', () => {
  server.tick = 7000;
  const frame = decode(buffer(server.frameBytes())) as Frame;
  const truth = truthAt(7000);
  assert.equal(frame.tick, 7000);
  assert.deepEqual(Object.values(frame.needles[0].force), truth.force);
  assert.equal(frame.movedTo.length, kSmall.rest.length);
  assert.equal(frame.needles[0].nodes.length, 33);
  assert.ok(frame.particles.length > 5);
});

test('no bytes make the page throw: what cannot be read is null', () => {
  const good = [server.frameBytes(), server.helloBytes()];
  const next = random(3);
  for (const bytes of good) {
    for (let i = 0; i < 60; ++i) {
      const bad = bytes.slice(0, i % 2 === 0 ? Math.floor(next() * bytes.length) : bytes.length);
      for (let k = 0; k < 4; ++k)
        bad[Math.floor(next() * Math.min(bad.length, 400))] ^= 1 + 254 * next();
      assert.doesNotThrow(() => decode(buffer(bad)));
    }
  }
  assert.equal(decode(new ArrayBuffer(0)), null);
  assert.equal(decode(buffer(new TextEncoder().encode('not a flatbuffer at all'))), null);
  assert.equal(decode(buffer(ask.pause())), null);  // a page's message is none of a server's
});

test('the organ and the lattice fit each other, and what does not is said', () => {
  const hello = decode(buffer(server.helloBytes())) as Hello;
  const organ = readOrgan(buffer(kSmall.bytes));
  assert.equal(organ.voxelCount, kSmall.voxelCount);
  assert.equal(organ.triangles.length / 3, kSmall.triangleCount);
  assert.deepEqual(organ.materials, ['liver', 'tumour']);
  assert.equal(misfit(organ, hello), '');
  assert.match(misfit(organ, {...hello, corners: hello.corners.slice(8)}), /corners of/);
  assert.match(
      misfit(organ, {...hello, particles: 3, rest: hello.rest.slice(0, 9)}), /corner \d+ of 3/);
  assert.throws(() => readOrgan(new ArrayBuffer(40)), OrganError);
  // Every vertex lies in its voxel, where the lattice at rest puts it, to the fraction's last
  // place.
  for (let v = 0; v < organ.vertexVoxel.length; ++v) {
    const low = hello.corners[8 * organ.vertexVoxel[v]];
    for (let k = 0; k < 3; ++k) {
      const at = hello.rest[3 * low + k] + organ.vertexFraction[3 * v + k] * organ.edge;
      assert.ok(Math.abs(at - organ.vertexRest[3 * v + k]) < 1e-6);
    }
  }
});

test('voxels of all sheets lie at the same place', () => {
  const b = new flatbuffers.Builder(256);
  const sheets = Sheets.createSheets(b, 3, 0, 0);
  wire.Organ.startRunsVector(b, 2);
  Run.createRun(b, 1, 4, 0, 1);
  Run.createRun(b, 0, 1, 0, 2);
  const runs = b.endVector();
  const none = wire.Organ.createVoxelMaterialVector(b, []);
  wire.Organ.startOrgan(b);
  wire.Organ.addSizeY(b, 6);
  wire.Organ.addRuns(b, runs);
  wire.Organ.addVoxelMaterial(b, none);
  wire.Organ.addVoxelFill(b, none);
  wire.Organ.addMaterials(b, none);
  wire.Organ.addSheets(b, sheets);
  b.finish(wire.Organ.endOrgan(b), 'STLO');
  const places = readOrgan(buffer(b.asUint8Array())).voxelPlace;
  assert.deepEqual([...places], [0, 1, 0, 1, 1, 0, 1, 1, 0]);
});

test('voxels of all levels lie where their level says', () => {
  const b = new flatbuffers.Builder(256);
  // Two planes of level 0, then an empty one, then four of level 1.
  const levels = Levels.createLevels(b, 2, 2, 0);
  wire.Organ.startRunsVector(b, 3);
  Run.createRun(b, 3, 1, 6, 1);
  Run.createRun(b, 2, 0, 3, 2);
  Run.createRun(b, 0, 1, 1, 1);
  const runs = b.endVector();
  const none = wire.Organ.createVoxelMaterialVector(b, []);
  wire.Organ.startOrgan(b);
  wire.Organ.addVoxelEdgeM(b, 4);
  wire.Organ.addSizeY(b, 4);
  wire.Organ.addSizeZ(b, 7);
  wire.Organ.addRuns(b, runs);
  wire.Organ.addVoxelMaterial(b, none);
  wire.Organ.addVoxelFill(b, none);
  wire.Organ.addMaterials(b, none);
  wire.Organ.addLevels(b, levels);
  b.finish(wire.Organ.endOrgan(b), 'STLO');
  const organ = readOrgan(buffer(b.asUint8Array()));
  assert.deepEqual([...organ.voxelPlace], [0, 2, 2, 2, 0, 0, 3, 0, 0, 3, 1, 3]);
  assert.deepEqual([...organ.voxelSize], [2, 1, 1, 1]);
  assert.equal(organ.edge, 2);
});

test('no outer edge where finer voxels cover a coarser one', () => {
  const places = [0, 0, 0];
  const sizes = [2];
  for (let i = 0; i < 4; ++i) {
    places.push(2, i & 1, i >> 1);
    sizes.push(1);
  }
  const edges = (count: number) => {
    const organ = {
      voxelCount: count,
      voxelPlace: Uint16Array.from(places.slice(0, 3 * count)),
      voxelSize: Uint8Array.from(sizes.slice(0, count)),
    } as Organ;
    const corners = Uint32Array.from({length: 8 * count}, (_, i) => i);
    return outerEdges(organ, corners).length / 2;
  };
  assert.equal(edges(1), 12);
  // No particle is shared here. The coarse one keeps all edges, by its other faces; each fine one
  // has three outer faces at a corner, with nine edges.
  assert.equal(edges(5), 12 + 4 * 9);
});

test('normals point outward and have length one', () => {
  const organ = readOrgan(buffer(kSmall.bytes));
  const normals = vertexNormals(organ.vertexRest, organ.triangles);
  for (let v = 0; v < organ.vertexVoxel.length; ++v) {
    const [n, p] = [normals, organ.vertexRest].map((a) => a.subarray(3 * v, 3 * v + 3));
    const size = Math.hypot(...n);
    if (size === 0) continue;  // a vertex without a triangle
    assert.ok(Math.abs(size - 1) < 1e-6);
    assert.ok(n[0] * p[0] + n[1] * p[1] + n[2] * p[2] > 0);
  }
});

test('a surface is open where an edge has a triangle on one side only', () => {
  const closed = [0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0];
  assert.equal(isOpen(Uint32Array.from(closed)), false);
  assert.equal(isOpen(Uint32Array.from(closed.slice(3))), true);
});

test('outer edges: 12 of one voxel, 20 of two side by side, none inside', () => {
  const box = (nx: number, ny: number, nz: number) => {
    const places: number[] = [];
    const corners: number[] = [];
    const id = (x: number, y: number, z: number) => x + (nx + 1) * (y + (ny + 1) * z);
    for (let z = 0; z < nz; ++z) {
      for (let y = 0; y < ny; ++y) {
        for (let x = 0; x < nx; ++x) {
          places.push(x, y, z);
          for (let c = 0; c < 8; ++c)
            corners.push(id(x + (c & 1), y + ((c >> 1) & 1), z + (c >> 2)));
        }
      }
    }
    const voxelCount = places.length / 3;
    const voxelSize = new Uint8Array(voxelCount).fill(1);
    const organ = {voxelCount, voxelPlace: Uint16Array.from(places), voxelSize} as Organ;
    return outerEdges(organ, Uint32Array.from(corners)).length / 2;
  };
  assert.equal(box(1, 1, 1), 12);
  assert.equal(box(2, 1, 1), 20);
  // A cube of n^3 has 6 n^2 outer faces, and twice as many edges of them.
  assert.equal(box(4, 4, 4), 12 * 16);
});

test('a plane cuts a cube in the polygon that integration finds, and beside it in none', () => {
  const next = random(7);
  const corners = Array.from({length: 8}, (_, c) => new THREE.Vector3(c & 1, (c >> 1) & 1, c >> 2));
  for (let i = 0; i < 200; ++i) {
    const normal = new THREE.Vector3(next() - 0.5, next() - 0.5, next() - 0.5).normalize();
    const w = 1.6 * next() - 0.8 + normal.dot(new THREE.Vector3(0.5, 0.5, 0.5));
    const polygon = slice((c) => corners[c].clone(), corners.map((p) => normal.dot(p) - w), normal);
    let area = 0;
    for (let k = 2; k < (polygon?.length ?? 0); ++k) {
      const [a, b, c] = [polygon![0], polygon![k - 1], polygon![k]];
      area += b.clone().sub(a).cross(c.clone().sub(a)).dot(normal) / 2;
    }
    // The share of the cube within d of the plane, over 2 d: another way to the same area.
    const sum = new THREE.Vector3();
    const [steps, d] = [60, 0.02];
    let inside = 0;
    for (let x = 0; x < steps; ++x) {
      for (let y = 0; y < steps; ++y) {
        for (let z = 0; z < steps; ++z) {
          sum.set(x + next(), y + next(), z + next()).divideScalar(steps);
          if (Math.abs(normal.dot(sum) - w) < d) ++inside;
        }
      }
    }
    const sampled = inside / steps ** 3 / (2 * d);
    assert.ok(Math.abs(area - sampled) < 0.06, `${area} of ${sampled}`);
  }
});

test('labels that would cover each other are pushed apart, others stay', () => {
  const next = random(11);
  for (let i = 0; i < 100; ++i) {
    const labels = Array.from({length: 8}, () => ({
                                             x: 300 * next(),
                                             y: 200 * next(),
                                             width: 30 + 80 * next(),
                                             height: 18,
                                           }));
    const heights = spread(labels);
    labels.forEach((a, p) => labels.slice(0, p).forEach((b, q) => {
      const beside = a.x >= b.x + b.width || b.x >= a.x + a.width;
      assert.ok(beside || Math.abs(heights[p] - heights[q]) >= 18 - 1e-9);
    }));
    assert.ok(heights.every((h, k) => h >= labels[k].y));
  }
  const apart = [{x: 0, y: 5, width: 10, height: 10}, {x: 20, y: 5, width: 10, height: 10}];
  assert.deepEqual(spread(apart), [5, 5]);
});

test('no two of 27 tissues have the same colour, whatever they are called', () => {
  const names = ['liver', 'fat', ...Array.from({length: 25}, (_, i) => `tissue ${i}`)];
  assert.equal(new Set(materialColours(names)).size, 27);
});

test('phases: contact, insertion with its hold, withdrawal', () => {
  const series = new Series();
  for (let tick = 0; tick < 16000; tick += 4) series.add(rowOf(tick, 0));
  const event = (tick: number, eventKind: number, needle = 0) =>
      ({tick, eventKind, needle, layer: 0, depth: 0, force: 0});
  const spans =
      phaseSpans([event(1000, 0), event(1600, 2), event(14667, 4), event(2000, 4, 1)], series, 0);
  assert.deepEqual(spans.map((s) => s.phase), ['contact', 'inserted', 'retracting']);
  assert.deepEqual([spans[0].from, spans[1].from, spans[2].to], [1000, 1600, 14667]);
  assert.ok(Math.abs(spans[2].from - 10000) < 40);  // the hand turns back at 10 s
});

test('saved figures escape what servers say, and numbers can be read again', () => {
  const figure: Figure = {
    title: '<script>alert(1)</script>',
    xLabel: 'a & b',
    yLabel: '"',
    curves: [{name: '<b>', colour: '#000', dash: [], width: 1, xs: [0, 1], ys: [0, 2]}],
    bands: [],
    marks: [{x: 0.5, label: '</text><image href="x"/>', strong: true}],
  };
  const svg = figureSvg(figure);
  assert.ok(!/<script|<b>|<image/.test(svg));
  assert.ok(svg.includes('&lt;script&gt;'));
  assert.deepEqual(ticksOf(0, 1, 5), [0, 0.2, 0.4, 0.6, 0.8, 1]);
  const values = Float64Array.from([0.1, -2.5e-7, 3].map(Math.fround));
  const read = csv(['v'], [values], exactText).trim().split('\n').slice(1).map(Number);
  assert.deepEqual(read.map(Math.fround), [...values]);
});

test('the wait for the next try doubles, with a part left to chance, up to 10 s', () => {
  assert.deepEqual([1, 2, 3, 9].map((n) => waitMs(n, 1)), [500, 1000, 2000, 10000]);
  assert.equal(waitMs(1, 0), 250);
});
