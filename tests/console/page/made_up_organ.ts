// SPDX-License-Identifier: Apache-2.0
// An organ for the page's tests: a lumpy ellipsoid as an organ file, and the lattice a Hello tells.
//
// Needs no other program. 5 mm and less make about as many voxels and triangles as the liver's
// (20 k and 30 k). Units: m.
import * as flatbuffers from 'flatbuffers';

import {Material} from '../../../hal/console/page/generated/stylet/format/material';
import * as format from '../../../hal/console/page/generated/stylet/format/organ';
import {Run} from '../../../hal/console/page/generated/stylet/format/run';
import {Triangle} from '../../../hal/console/page/generated/stylet/format/triangle';
import {Vertex} from '../../../hal/console/page/generated/stylet/format/vertex';

export interface MadeUpOrgan {
  bytes: Uint8Array;
  edge: number;
  rest: Float32Array;
  corners: Uint32Array;
  voxelCount: number;
  triangleCount: number;
}

const kAxes = [0.105, 0.068, 0.06];
const kFractions = 65535;

// How far the surface is from the middle, in a direction.
function reach(d: number[]): number {
  const ball = 1 / Math.hypot(d[0] / kAxes[0], d[1] / kAxes[1], d[2] / kAxes[2]);
  const lumps =
      0.05 * Math.sin(3 * d[0] + 1) * Math.cos(4 * d[1]) + 0.04 * Math.sin(5 * d[2] + d[0]);
  return ball * (0.95 + lumps);
}

function surface(rings: number): {places: number[][]; triangles: number[][]} {
  const places: number[][] = [];
  const turns = 2 * rings;
  for (let i = 0; i <= rings; ++i) {
    for (let j = 0; j < turns; ++j) {
      const [polar, round] = [(Math.PI * i) / rings, (2 * Math.PI * j) / turns];
      const d =
          [Math.cos(polar), Math.sin(polar) * Math.cos(round), Math.sin(polar) * Math.sin(round)];
      places.push(d.map((v) => v * reach(d)));
    }
  }
  // At a pole all vertices of a ring are one.
  const at = (i: number, j: number) => i * turns + (i === 0 || i === rings ? 0 : j % turns);
  const triangles: number[][] = [];
  for (let i = 0; i < rings; ++i) {
    for (let j = 0; j < turns; ++j) {
      const [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)];
      if (i > 0) triangles.push([a, c, b]);
      if (i < rings - 1) triangles.push([b, c, d]);
    }
  }
  return {places, triangles};
}

export function makeUpOrgan(edge: number, rings: number): MadeUpOrgan {
  const {places, triangles} = surface(rings);
  const low = kAxes.map((a) => -1.1 * a);
  const cellOf = (p: number[]) => p.map((v, k) => Math.floor((v - low[k]) / edge));
  const size = kAxes.map((a) => Math.ceil((2.2 * a) / edge));
  const id = (c: number[]) => c[0] + size[0] * (c[1] + size[1] * c[2]);
  const filled = new Set(places.map((p) => id(cellOf(p))));
  for (let z = 0; z < size[2]; ++z) {
    for (let y = 0; y < size[1]; ++y) {
      for (let x = 0; x < size[0]; ++x) {
        const middle = [x, y, z].map((v, k) => low[k] + (v + 0.5) * edge);
        const far = Math.hypot(...middle);
        if (far < reach(middle.map((v) => v / (far || 1)))) filled.add(id([x, y, z]));
      }
    }
  }
  const cells = [...filled].sort((a, b) => a - b);
  const voxelOf = new Map(cells.map((cell, i) => [cell, i]));
  const placeOf = (cell: number) =>
      [cell % size[0],
       Math.floor(cell / size[0]) % size[1],
       Math.floor(cell / size[0] / size[1]),
  ];
  return {
    ...lattice(cells.map(placeOf), low, edge),
    bytes: write({cells, placeOf, voxelOf, id, cellOf, size, low, edge, places, triangles}),
    edge,
    voxelCount: cells.length,
    triangleCount: triangles.length,
  };
}

function lattice(cells: number[][], low: number[], edge: number) {
  const known = new Map<string, number>();
  const rest: number[] = [];
  const corners: number[] = [];
  for (const [x, y, z] of cells) {
    for (let corner = 0; corner < 8; ++corner) {
      const at = [x + (corner & 1), y + ((corner >> 1) & 1), z + (corner >> 2)];
      const key = at.join();
      let particle = known.get(key);
      if (particle === undefined) {
        particle = known.size;
        known.set(key, particle);
        rest.push(...at.map((v, k) => low[k] + v * edge));
      }
      corners.push(particle);
    }
  }
  return {rest: Float32Array.from(rest), corners: Uint32Array.from(corners)};
}

interface Parts {
  cells: number[];
  placeOf: (cell: number) => number[];
  voxelOf: Map<number, number>;
  id: (c: number[]) => number;
  cellOf: (p: number[]) => number[];
  size: number[];
  low: number[];
  edge: number;
  places: number[][];
  triangles: number[][];
}

function write(parts: Parts): Uint8Array {
  const {cells, placeOf, edge, low, size} = parts;
  const b = new flatbuffers.Builder(1 << 20);
  const structs = <T>(list: T[], bytes: number, align: number, add: (item: T) => void) => {
    b.startVector(bytes, list.length, align);
    for (const item of [...list].reverse()) add(item);
    return b.endVector();
  };
  const material = (name: string) => Material.createMaterial(
      b,
      b.createString(name),
      0,
      1060,
      3000,
      0.45,
      0,
      0,
      1,
      0.5,
      0.5,
      20,
      20,
      0.001,
      10,
      0,
      0,
  );
  const materials = format.Organ.createMaterialsVector(b, ['liver', 'tumour'].map(material));
  const runs: number[][] = [];
  for (const cell of cells) {
    const [x, y, z] = placeOf(cell);
    const last = runs[runs.length - 1];
    if (last && last[1] === y && last[2] === z && last[0] + last[3] === x)
      ++last[3];
    else
      runs.push([x, y, z, 1]);
  }
  const runsAt = structs(runs, 8, 2, ([x, y, z, n]) => Run.createRun(b, x, y, z, n));
  const verticesAt = structs(parts.places, 12, 4, (p) => {
    const cell = parts.cellOf(p);
    const f = p.map((v, k) => Math.round(((v - low[k]) / edge - cell[k]) * kFractions));
    Vertex.createVertex(b, parts.voxelOf.get(parts.id(cell)) ?? 0, f[0], f[1], f[2], 0);
  });
  const trianglesAt =
      structs(parts.triangles, 12, 4, ([p, q, r]) => Triangle.createTriangle(b, p, q, r));
  const kinds = cells.map((cell) => (placeOf(cell)[0] > 0.72 * size[0] ? 1 : 0));
  const kindsAt = format.Organ.createVoxelMaterialVector(b, kinds);
  const fillsAt = format.Organ.createVoxelFillVector(b, cells.map(() => 255));
  const name = b.createString('made-up');
  format.Organ.startOrgan(b);
  format.Organ.addFormatVersion(b, 1);
  format.Organ.addName(b, name);
  format.Organ.addVoxelEdgeM(b, edge);
  format.Organ.addOriginXM(b, low[0]);
  format.Organ.addOriginYM(b, low[1]);
  format.Organ.addOriginZM(b, low[2]);
  format.Organ.addSizeX(b, size[0]);
  format.Organ.addSizeY(b, size[1]);
  format.Organ.addSizeZ(b, size[2]);
  format.Organ.addRuns(b, runsAt);
  format.Organ.addVoxelMaterial(b, kindsAt);
  format.Organ.addVoxelFill(b, fillsAt);
  format.Organ.addMaterials(b, materials);
  format.Organ.addVertices(b, verticesAt);
  format.Organ.addTriangles(b, trianglesAt);
  b.finish(format.Organ.endOrgan(b), 'STLO');
  return b.asUint8Array().slice();
}
