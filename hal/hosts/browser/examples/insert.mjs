// SPDX-License-Identifier: Apache-2.0
// A needle in an organ, from JavaScript: 20 mm into it at 10 mm/s from above, and the force on the
// way. The lines of ../../c/examples/insert.c, with the same state in the end.
//
//   node insert.mjs liver.organ
import { readFile } from "node:fs/promises";
import { load } from "stylet-wasm";

const number = (value, width, digits) => value.toFixed(digits).padStart(width);

const stylet = await load();
const organ = stylet.organ(await readFile(process.argv[2]));
const { low_m, high_m } = organ.info;

const needle = stylet.needle({ bending_nm2: 0.02 }); // 18G, 150 mm, rigid, unless said otherwise
const simulation = stylet.simulation(organ, { needles: [needle] });

// From above the middle of the organ, straight down. Math.fround: as C counts in float.
const f = Math.fround;
const down = [0, 0, -1];
const above = [f(f(low_m[0] + high_m[0]) / 2), f(f(low_m[1] + high_m[1]) / 2),
  f(high_m[2] + f(0.01))];
const to_skin_m = organ.raycast(above, down);
const begin_m = f(above[2] - f(to_skin_m - f(1e-3))); // the tip begins 1 mm above the skin

for (let tick = 0; tick <= 2100; ++tick) {
  const tip = [above[0], above[1], f(begin_m - f(f(f(10e-3) * f(1e-3)) * tick))];
  const [out] = simulation.tick([stylet.pose_of_tip(tip, down, needle.length_m)]);
  if (tick % 100 === 0) {
    console.log(`${number(1e3 * out.depth_m, 6, 2)} mm  ${number(out.force_n[2], 6, 3)} N`);
  }
}
console.log(`state ${simulation.hash()}`);
simulation.free();
organ.free();
