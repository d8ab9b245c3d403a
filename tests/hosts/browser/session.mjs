// SPDX-License-Identifier: Apache-2.0
// The insertion of the example in C, for a page: its lines as one text, and how many threads there
// were.
import { load } from "stylet-wasm";

export async function insertion(bytes, wanted = 1) {
  const stylet = await load(undefined, { threads: wanted });
  const { threads } = stylet;
  const organ = stylet.organ(bytes);
  const { low_m, high_m } = organ.info;
  const simulation = stylet.simulation(organ, { needles: [{ bending_nm2: 0.02 }] });
  const { length_m } = stylet.needle();
  const f = Math.fround, down = [0, 0, -1];
  const x = f(f(low_m[0] + high_m[0]) / 2), y = f(f(low_m[1] + high_m[1]) / 2);
  const above = f(high_m[2] + f(0.01));
  const begin = f(above - f(organ.raycast([x, y, above], down) - f(1e-3)));
  const speed = f(f(10e-3) * f(1e-3));
  const pose = (tick) => [stylet.pose_of_tip([x, y, f(begin - f(speed * tick))], down, length_m)];
  const lines = [];
  for (let tick = 0; tick <= 2100; tick += tick === 0 ? 1 : 100) {
    const due = tick === 0 ? [pose(0)] : Array.from({ length: 100 }, (_, i) => pose(tick + i));
    const [[out]] = simulation.run(due, { last: true });
    lines.push(`${(1e3 * out.depth_m).toFixed(2).padStart(6)} mm  ` +
      `${out.force_n[2].toFixed(3).padStart(6)} N`);
    if (tick + 99 === 2100) lines.push(`state ${simulation.hash()}`);
  }
  stylet.end_threads();
  return { text: lines.join("\n"), threads };
}
