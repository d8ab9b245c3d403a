// SPDX-License-Identifier: Apache-2.0
// Where labels stand so that each can be read. Units: CSS pixels, y down.

// Heights at which labels do not cover each other: from top to bottom, each pushed down below those
// that it would touch.
export function spread(labels: {x: number; y: number; width: number; height: number}[]): number[] {
  const heights = labels.map(({y}) => y);
  const order = labels.map((_, i) => i).sort((a, b) => labels[a].y - labels[b].y);
  order.forEach((at, rank) => {
    const mine = labels[at];
    for (const other of order.slice(0, rank).sort((a, b) => heights[a] - heights[b])) {
      const theirs = labels[other];
      const beside = mine.x >= theirs.x + theirs.width || theirs.x >= mine.x + mine.width;
      const apart = heights[at] >= heights[other] + theirs.height ||
          heights[other] >= heights[at] + mine.height;
      if (!beside && !apart) heights[at] = heights[other] + theirs.height;
    }
  });
  return heights;
}
