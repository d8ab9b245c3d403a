// SPDX-License-Identifier: Apache-2.0
// The organ file (kernel/schema/organ.fbs) as arrays for the GPU.
//
// Promise: every index in the result is within its array; a file that breaks this is refused with a
// line that says where. Units: m; frame: world at rest.
import * as flatbuffers from 'flatbuffers';

import {Organ as WireOrgan} from '../generated/stylet/format/organ';
import {Run} from '../generated/stylet/format/run';
import {Triangle} from '../generated/stylet/format/triangle';
import {Vertex} from '../generated/stylet/format/vertex';

import type {Hello} from './protocol';

const kIdentifier = 'STLO';
const kFractions = 65535;

export interface Organ {
  name: string;
  edge: number;
  voxelCount: number;
  voxelPlace: Uint16Array;  // x y z of the cell, each voxel
  voxelMaterial: Uint8Array;
  materials: string[];
  vertexVoxel: Uint32Array;
  vertexFraction: Float32Array;  // 3 each, 0 to 1
  vertexRest: Float32Array;      // 3 each
  vertexNormal: Float32Array;    // 3 each, outward at rest
  triangles: Uint32Array;        // 3 each
}

export class OrganError extends Error {}

function walkRuns(organ: WireOrgan): Uint16Array {
  const places: number[] = [];
  const run = new Run();
  const rows = organ.sheets()?.rows() || organ.sizeY();  // of a sheet: all lie at the same place
  for (let i = 0; i < organ.runsLength(); ++i) {
    organ.runs(i, run);
    const [x, y, z, count] = [run.x(), run.y() % rows, run.z(), run.count()];
    for (let along = 0; along < count; ++along) places.push(x + along, y, z);
  }
  return Uint16Array.from(places);
}

function readVertices(wire: WireOrgan, organ: Organ): void {
  const origin = [wire.originXM(), wire.originYM(), wire.originZM()];
  const vertex = new Vertex();
  for (let i = 0; i < wire.verticesLength(); ++i) {
    wire.vertices(i, vertex);
    const voxel = vertex.voxel();
    if (voxel >= organ.voxelCount) throw new OrganError(`vertex ${i}: voxel ${voxel}`);
    organ.vertexVoxel[i] = voxel;
    [vertex.fx(), vertex.fy(), vertex.fz()].forEach((fraction, axis) => {
      const part = fraction / kFractions;
      organ.vertexFraction[3 * i + axis] = part;
      organ.vertexRest[3 * i + axis] =
          origin[axis] + (organ.voxelPlace[3 * voxel + axis] + part) * organ.edge;
    });
  }
}

function readTriangles(wire: WireOrgan, organ: Organ): void {
  const triangle = new Triangle();
  const vertexCount = wire.verticesLength();
  for (let i = 0; i < wire.trianglesLength(); ++i) {
    wire.triangles(i, triangle);
    [triangle.a(), triangle.b(), triangle.c()].forEach((vertex, corner) => {
      if (vertex >= vertexCount) throw new OrganError(`triangle ${i}: vertex ${vertex}`);
      organ.triangles[3 * i + corner] = vertex;
    });
  }
}

// Of each vertex: the sum of its triangles' normals, each as long as the triangle is large.
export function vertexNormals(places: Float32Array, triangles: Uint32Array): Float32Array {
  const normals = new Float32Array(places.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    const [ux, uy, uz] = [0, 1, 2].map((k) => places[b + k] - places[a + k]);
    const [vx, vy, vz] = [0, 1, 2].map((k) => places[c + k] - places[a + k]);
    const normal = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    for (const at of [a, b, c])
      for (let k = 0; k < 3; ++k) normals[at + k] += normal[k];
  }
  for (let i = 0; i < normals.length; i += 3) {
    const size = Math.hypot(normals[i], normals[i + 1], normals[i + 2]) || 1;
    for (let k = 0; k < 3; ++k) normals[i + k] /= size;
  }
  return normals;
}

export function readOrgan(bytes: ArrayBuffer): Organ {
  const buffer = new flatbuffers.ByteBuffer(new Uint8Array(bytes));
  if (bytes.byteLength < 12 || !buffer.__has_identifier(kIdentifier)) {
    throw new OrganError('no organ file');
  }
  const wire = WireOrgan.getRootAsOrgan(buffer);
  const voxelPlace = walkRuns(wire);
  const organ: Organ = {
    name: wire.name() ?? '',
    edge: wire.voxelEdgeM(),
    voxelCount: voxelPlace.length / 3,
    voxelPlace,
    voxelMaterial: (wire.voxelMaterialArray() ?? new Uint8Array()).slice(),
    materials: [],
    vertexVoxel: new Uint32Array(wire.verticesLength()),
    vertexFraction: new Float32Array(3 * wire.verticesLength()),
    vertexRest: new Float32Array(3 * wire.verticesLength()),
    vertexNormal: new Float32Array(),
    triangles: new Uint32Array(3 * wire.trianglesLength()),
  };
  for (let i = 0; i < wire.materialsLength(); ++i) {
    organ.materials.push(wire.materials(i)?.name() ?? `${i}`);
  }
  readVertices(wire, organ);
  readTriangles(wire, organ);
  organ.vertexNormal = vertexNormals(organ.vertexRest, organ.triangles);
  return organ;
}

// Whether the server's lattice can carry this organ: one line of what does not fit, or nothing.
export function misfit(organ: Organ, hello: Hello): string {
  if (hello.corners.length !== 8 * organ.voxelCount) {
    return `corners of ${hello.corners.length / 8} voxels, organ of ${organ.voxelCount}`;
  }
  if (hello.rest.length !== 3 * hello.particles) {
    return `${hello.rest.length / 3} places of ${hello.particles} particles`;
  }
  const outside = hello.corners.find((particle) => particle >= hello.particles);
  return outside === undefined ? '' : `corner ${outside} of ${hello.particles} particles`;
}

// Whether the surface has an edge with a triangle on one side only: a part cut out of a body, whose
// inside can be seen.
export function isOpen(triangles: Uint32Array): boolean {
  const single = new Set<number>();
  for (let t = 0; t < triangles.length; t += 3) {
    for (let side = 0; side < 3; ++side) {
      const [a, b] = [triangles[t + side], triangles[t + (side + 1) % 3]];
      const edge = Math.min(a, b) * 2 ** 26 + Math.max(a, b);
      if (!single.delete(edge)) single.add(edge);
    }
  }
  return single.size > 0;
}

// Edges of the lattice's outer faces, as pairs of particles: what is seen of it from outside.
export function outerEdges(organ: Organ, corners: Uint32Array): Uint32Array {
  const key = (x: number, y: number, z: number) => x + 65537 * (y + 65537 * z);
  const filled = new Set<number>();
  for (let v = 0; v < organ.voxelCount; ++v) {
    const [x, y, z] = organ.voxelPlace.subarray(3 * v, 3 * v + 3);
    filled.add(key(x + 1, y + 1, z + 1));
  }
  const seen = new Set<number>();
  const pairs: number[] = [];
  const add = (a: number, b: number) => {
    const edge = Math.min(a, b) * 2 ** 26 + Math.max(a, b);
    if (seen.has(edge)) return;
    seen.add(edge);
    pairs.push(a, b);
  };
  for (let v = 0; v < organ.voxelCount; ++v) {
    const [x, y, z] = organ.voxelPlace.subarray(3 * v, 3 * v + 3);
    for (let axis = 0; axis < 3; ++axis) {
      for (const side of [0, 1]) {
        const step = [0, 0, 0];
        step[axis] = side === 1 ? 1 : -1;
        if (filled.has(key(x + 1 + step[0], y + 1 + step[1], z + 1 + step[2]))) continue;
        const one = 1 << axis;
        const [p, q] = [1 << (axis + 1) % 3, 1 << (axis + 2) % 3];
        const at = (corner: number) => corners[8 * v + corner + (side === 1 ? one : 0)];
        add(at(0), at(p));
        add(at(0), at(q));
        add(at(p), at(p + q));
        add(at(q), at(p + q));
      }
    }
  }
  return Uint32Array.from(pairs);
}
