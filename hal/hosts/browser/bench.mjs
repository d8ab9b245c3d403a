// SPDX-License-Identifier: Apache-2.0
// Time of a tick in WebAssembly, of an organ with its needle away, and with threads; with
// STYLET_BENCH also that of the same step natively with SSE2, in turns with it.
//
//   node hal/hosts/browser/bench.mjs build/browser/package ORGAN [build/release/bin/stylet-bench]
import { spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import os from "node:os";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";

const ROUNDS = 5, TICKS = 200;
const MOST_THREADS = 4;

function median(values) {
  return [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];
}

// Microseconds a tick as a clock counts them: of the best round, as other work only adds to it.
async function by_threads(load, threads, file) {
  const stylet = await load(undefined, { threads });
  const simulation = stylet.simulation(stylet.organ(readFileSync(file)));
  const poses = Array.from({ length: TICKS }, () => [null]);
  const round = () => {
    const before = performance.now();
    simulation.run(poses, { last: true });
    return 1e3 * (performance.now() - before) / TICKS;
  };
  const best = Math.min(...Array.from({ length: 2 * ROUNDS }, round));
  stylet.end_threads();
  return best;
}

// Microseconds of processor time a tick.
function in_wasm(simulation, pose) {
  const poses = Array.from({ length: TICKS }, () => [pose]);
  const before = process.cpuUsage();
  simulation.run(poses, { last: true });
  return process.cpuUsage(before).user / TICKS;
}

function natively(program, organ) {
  const done = spawnSync(program, [organ, "--benchmark_filter=^tissue/.*/baseline$",
    "--benchmark_min_time=0.1"], { encoding: "utf8" });
  const row = /^tissue\/\S+\/baseline +([\d.]+)/m.exec(done.stdout + done.stderr);
  if (done.status !== 0 || !row) throw new Error(`${program}: ${done.stdout}${done.stderr}`);
  return Number(row[1]);
}

const [folder, organ_file, program] = process.argv.slice(2);
if (!organ_file) {
  console.error("usage: node bench.mjs PACKAGE_FOLDER ORGAN [STYLET_BENCH]");
  process.exit(2);
}
const { load } = await import(pathToFileURL(resolve(folder, "index.mjs")));
const stylet = await load();
const organ = stylet.organ(readFileSync(organ_file));
const simulation = stylet.simulation(organ);
const away = stylet.pose_of_tip([0, 0, organ.info.high_m[2] + 0.3], [0, 0, -1], 0.15);
in_wasm(simulation, away); // the engine compiles
const times = { wasm: [], native: [] };
for (let round = 0; round < ROUNDS; ++round) {
  times.wasm.push(in_wasm(simulation, away));
  if (program) times.native.push(natively(program, organ_file));
}
const wasm = median(times.wasm), { voxels } = organ.info;
console.log(`${os.cpus()[0].model}, node ${process.version}, ${stylet.build.trim()}`);
console.log(`WebAssembly  ${wasm.toFixed(0)} us a tick of ${voxels} voxels, ` +
  `${(1e3 * wasm / voxels).toFixed(1)} ns a voxel`);
if (program) {
  const native = median(times.native);
  console.log(`native SSE2  ${native.toFixed(0)} us, ${(wasm / native).toFixed(2)} times as long ` +
    "in WebAssembly");
}
const processors = Math.min(os.availableParallelism(), MOST_THREADS);
for (let threads = 1; threads <= processors; ++threads) {
  const us = await by_threads(load, threads, organ_file);
  console.log(`by ${threads} threads  ${us.toFixed(0)} us by the clock`);
}
