// SPDX-License-Identifier: Apache-2.0
// What a program relies on: fields of refusals, objects that end in any order, arrays that stay
// valid while memory grows, the same state by any way to it.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";
import { constants, load, StyletError } from "stylet-wasm";

const bytes = readFileSync("liver.organ");
const stylet = await load(readFileSync("package/stylet.wasm"));
const organ = stylet.organ(bytes);
const { low_m, high_m } = organ.info;
const LENGTH_M = stylet.needle().length_m;

// Random numbers that are the same everywhere.
function draws(seed) {
  let state = BigInt(seed) * 0x9E3779B97F4A7C15n + 1n;
  const next = () => {
    state = BigInt.asUintN(64, state * 6364136223846793005n + 1442695040888963407n);
    return Number(state >> 11n) / 2 ** 53;
  };
  return { between: (a, b) => a + (b - a) * next() };
}

// Needles that go to and fro above and in the organ.
function way(seed, needles, ticks) {
  const draw = draws(seed);
  const tips = Array.from({ length: needles }, () => ({
    at: [0, 1].map((i) => draw.between(low_m[i], high_m[i])),
    lean: [draw.between(-0.4, 0.4), draw.between(-0.4, 0.4), -1],
    deep: draw.between(0.01, 0.06), rate: draw.between(0.002, 0.01),
  }));
  return Array.from({ length: ticks }, (_, t) => tips.map(({ at, lean, deep, rate }) =>
    stylet.pose_of_tip([...at, high_m[2] + 0.005 - deep * Math.sin(rate * t) ** 2], lean,
      LENGTH_M)));
}

test("an organ is what its file holds", () => {
  const { info } = organ;
  assert.match(info.hash, /^[0-9a-f]{16}$/);
  assert.equal(organ.vertices.length, 3 * info.vertices);
  assert.equal(organ.triangles.length, 3 * info.triangles);
  assert.equal(organ.vertex_materials.length, info.vertices);
  assert.equal(organ.voxels.length, info.voxels);
  assert.equal(organ.cubes.length, info.voxels);
  assert.equal(organ.cubes[7].edge_m, info.voxel_edge_m);
  assert.ok(Math.max(...organ.triangles) < info.vertices);
  const names = Array.from({ length: info.materials }, (_, i) => organ.material(i).name);
  assert.deepEqual(names, ["liver", "liver_capsule"]);
  // A closed surface: its volume by the divergence theorem is that of the tissue in the voxels.
  const p = organ.vertices, t = organ.triangles;
  let six = 0;
  for (let i = 0; i < t.length; i += 3) {
    const [a, b, c] = [t[i], t[i + 1], t[i + 2]].map((v) => p.subarray(3 * v, 3 * v + 3));
    six += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
      a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  const filled = organ.voxels.reduce((sum, { fill }) => sum + fill, 0) * info.voxel_edge_m ** 3;
  assert.ok(Math.abs(six / 6 - filled) < 0.01 * filled, `${six / 6} of ${filled}`);
});

test("a refusal names the field and what is accepted", () => {
  assert.throws(() => stylet.simulation(organ, { needles: [{}, { length_m: 0.7 }] }), (why) => {
    assert.ok(why instanceof StyletError);
    assert.equal(why.refusal.place, "needle.length_m");
    assert.equal(why.refusal.index, 1);
    assert.ok(Math.abs(why.refusal.most - 0.5) < 1e-6);
    assert.equal(why.refusal.status, constants.CONFIG_VALUE_OUT_OF_RANGE);
    return true;
  });
  const damaged = Uint8Array.from(bytes);
  damaged[damaged.length - 9] ^= 1;
  assert.throws(() => stylet.organ(damaged), StyletError);
  assert.throws(() => stylet.organ(new Uint8Array(0)), StyletError);
  assert.throws(() => stylet.simulation(organ, { config: { periods_s: 1 } }), TypeError);
  assert.throws(() => stylet.simulation(organ, { config: { substeps: 1.5 } }), TypeError);
  assert.throws(() => stylet.simulation(organ, { config: { substeps: "2" } }), TypeError);
  assert.throws(() => stylet.simulation(organ, { needles: new Array(5).fill({}) }), StyletError);
  assert.throws(() => stylet.pose_of_tip([0, 0], [0, 0, -1], 0.15), TypeError);
  const simulation = stylet.simulation(organ);
  assert.throws(() => simulation.restore(new Uint8Array(100)), StyletError);
  simulation.tick([null]);
  assert.throws(() => simulation.set_obstacles([{}]), (why) =>
    why.refusal.status === constants.OBSTACLES_TOO_LATE);
  simulation.free();
  assert.throws(() => simulation.tick([null]), /was freed/);
  simulation.free(); // a second time does nothing
});

test("invalid poses, invalid snapshots and those of another library are refused", async () => {
  const simulation = stylet.simulation(organ, { needles: [{}, {}] });
  const poses = way(5, 2, 30);
  simulation.run(poses);
  const before = simulation.hash(), saved = simulation.snapshot();
  const odd = [undefined, null, 5, NaN, "x", true, {}, [], [5], [{}], [[5]], [["x"]], () => 1, 7n,
    new Float64Array(3), [[{ position_m: [0, 0, 0] }]], [[null, null, null]]];
  for (const value of odd) {
    for (const call of ["run", "tick", "restore", "set_obstacles", "difference"]) {
      try {
        simulation[call](value);
        assert.ok(["run", "tick"].includes(call) && Array.isArray(value) && value.length === 0,
          `${call}(${String(value)}) is taken`);
        simulation.restore(saved);
      } catch (why) {
        assert.ok(why instanceof TypeError || why instanceof StyletError, `${call}: ${why}`);
      }
      assert.equal(simulation.hash(), before, `${call}(${String(value)})`);
    }
    for (const make of ["organ", "simulation", "config", "needle", "obstacle"]) {
      try {
        stylet[make](value);
      } catch (why) {
        assert.ok(why instanceof TypeError || why instanceof StyletError, `${make}: ${why}`);
      }
    }
  }
  const other = await load(readFileSync("package/stylet.wasm"));
  assert.throws(() => other.simulation(organ), TypeError);
  assert.throws(() => other.simulation(other.organ(bytes)).difference(simulation), TypeError);
  simulation.run(poses);
  simulation.restore(saved.buffer); // as a message between workers brings it
  assert.equal(simulation.hash(), before);
  simulation.free();
});

test("by one tick, by many, from a snapshot and in a clone: the same state", () => {
  for (let seed = 1; seed <= 4; ++seed) {
    const needles = 1 + seed % 3, poses = way(seed, needles, 240);
    const options = { needles: new Array(needles).fill(seed % 2 ? { bending_nm2: 0.02 } : {}),
      config: { inertia: seed % 2 }, obstacles: [stylet.obstacle_sphere(0.01,
        { pose: { position_m: [0.01, 0.01, 0], rotation: { w: 1, x: 0, y: 0, z: 0 } } })] };
    const whole = stylet.simulation(organ, options);
    const felt = whole.run(poses);
    const single = stylet.simulation(organ, options);
    let saved;
    poses.forEach((each, tick) => {
      const out = single.tick(each);
      if (tick % 80 === 0) assert.deepEqual(out, felt[tick]);
      if (tick === 100) saved = single.snapshot();
    });
    assert.equal(single.hash(), whole.hash());
    assert.equal(single.difference(whole), null);
    single.restore(saved);
    const copy = single.clone();
    single.run(poses.slice(101));
    copy.run(poses.slice(101), { last: true });
    assert.equal(single.hash(), whole.hash());
    assert.equal(copy.hash(), whole.hash());
    whole.reset();
    assert.notEqual(whole.difference(copy), null);
    assert.equal(whole.stats().ticks, 0);
    [whole, single, copy].forEach((each) => each.free());
  }
});

test("arrays that were returned stay valid while memory grows", () => {
  const simulation = stylet.simulation(organ);
  simulation.run(way(9, 1, 100));
  const surface = simulation.surface(), before = Float32Array.from(surface);
  const size = stylet.memory.exports.memory.buffer.byteLength;
  const others = [];
  while (stylet.memory.exports.memory.buffer.byteLength === size) {
    others.push(stylet.simulation(organ));
  }
  assert.deepEqual(surface, before);
  assert.deepEqual(simulation.surface(), before);
  others.forEach((each) => each.free());
  const used = stylet.memory.exports.memory.buffer.byteLength;
  for (let i = 0; i < 3 * others.length; ++i) stylet.simulation(organ).free();
  assert.equal(stylet.memory.exports.memory.buffer.byteLength, used, "memory was given back");
  simulation.free();
});

test("objects end in any order", () => {
  const own = stylet.organ(bytes);
  const a = stylet.simulation(own), b = a.clone();
  own.free();
  a.free();
  assert.throws(() => own.info, /was freed/);
  b.run(way(3, 1, 20));
  assert.equal(b.stats().ticks, 20);
  b.free();
});

test("what a trainer draws", () => {
  const simulation = stylet.simulation(organ, { needles: [{ bending_nm2: 0.02, rods: 12 }] });
  assert.equal(simulation.needle_shape().length, 0);
  const x = (low_m[0] + high_m[0]) / 2, y = (low_m[1] + high_m[1]) / 2;
  const skin = organ.raycast([x, y, high_m[2] + 0.01], [0, 0, -1]);
  const top = high_m[2] + 0.01 - skin;
  const poses = Array.from({ length: 600 }, (_, t) =>
    [stylet.pose_of_tip([x, y, top + 0.002 - 5e-5 * t], [0, 0, -1], LENGTH_M)]);
  const [[out]] = simulation.run(poses, { last: true });
  assert.equal(out.phase, constants.INSERTED);
  assert.ok(out.force_n[2] > 0.1, `pushes the hand back: ${out.force_n}`);
  assert.equal(simulation.needle_shape().length, 3 * 13);
  const kinds = simulation.events().map(({ kind }) => stylet.event_name(kind));
  assert.deepEqual(kinds.slice(0, 2), ["contact", "puncture"]);
  assert.ok(simulation.constraint_particles().length > 2);
  const { work_by_hand_j, elastic_j } = simulation.energy();
  assert.ok(work_by_hand_j > 0 && elastic_j > 0 && elastic_j < work_by_hand_j);
  assert.equal(simulation.particles().length % 3, 0);
  assert.equal(simulation.voxel_corners().length, 8 * organ.info.voxels);
  assert.ok(simulation.mass(0).real_kg > 0);
  simulation.free();
});

test("the bits do not depend on threads, whatever is done between runs", async () => {
  const poses = way(11, 2, 600);
  const done = async (threads) => {
    const library = await load(undefined, { threads });
    assert.equal(library.threads, threads);
    const held = library.organ(bytes);
    const options = { needles: [{}, { bending_nm2: 0.02 }] };
    let simulation = library.simulation(held, options);
    simulation.run(poses.slice(0, 200));
    const before = library.exports.memory.buffer.byteLength;
    const more = Array.from({ length: 30 }, () => simulation.clone()); // memory grows
    assert.ok(library.exports.memory.buffer.byteLength > before);
    simulation.free();
    simulation = more.pop();
    for (const pose of poses.slice(200, 300)) simulation.tick(pose);
    const other = library.simulation(held, options); // the same threads help with both
    other.run(poses.slice(0, 300));
    assert.equal(simulation.difference(other), null);
    simulation.restore(other.snapshot());
    more.forEach((one) => one.free());
    simulation.run(poses.slice(300, 400));
    library.end_threads();
    assert.equal(library.threads, 1);
    simulation.run(poses.slice(400));
    return simulation.hash();
  };
  const alone = await done(1);
  assert.equal(await done(2), alone);
  assert.equal(await done(4), alone);
});

test("where memory is not shared there is one thread", async () => {
  globalThis.crossOriginIsolated = false;
  try {
    assert.equal((await load(undefined, { threads: 2 })).threads, 1);
  } finally {
    delete globalThis.crossOriginIsolated;
  }
  const broken = await load(undefined, { threads: 2, shared: new Uint8Array(8) });
  assert.equal(broken.threads, 1);
  for (const threads of [0, 1.5, 17, "2"]) {
    await assert.rejects(load(undefined, { threads }), TypeError);
  }
});
