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
  edge: number;  // of the finest level's voxels
  voxelCount: number;
  voxelPlace: Uint16Array;  // x y z of each voxel's low corner, in those edges
  voxelSize: Uint8Array;    // its own edge, in those edges
  voxelMaterial: Uint8Array;
  materials: string[];
  vertexVoxel: Uint32Array;
  vertexFraction: Float32Array;  // 3 each, 0 to 1
  vertexRest: Float32Array;      // 3 each
  vertexNormal: Float32Array;    // 3 each, outward at rest
  triangles: Uint32Array;        // 3 each
}

export class OrganError extends Error {}

// Levels lie one after the other along z, each with twice the planes of the one before and an empty
// plane between two.
function walkRuns(organ: WireOrgan): [Uint16Array, Uint8Array] {
  const places: number[] = [];
  const sizes: number[] = [];
  const run = new Run();
  const rows = organ.sheets()?.rows() || organ.sizeY();  // of a sheet: all lie at the same place
  const [levels, planes] = levelsOf(organ);
  const start = (level: number) => level + planes * (2 ** level - 1);
  for (let i = 0; i < organ.runsLength(); ++i) {
    organ.runs(i, run);
    let level = 0;
    while (level + 1 < levels && run.z() >= start(level + 1)) ++level;
    const size = 2 ** (levels - 1 - level);
    const [x, y, z] = [run.x(), run.y() % rows, run.z() - start(level)];
    for (let along = 0; along < run.count(); ++along) {
      places.push(size * (x + along), size * y, size * z);
      sizes.push(size);
    }
  }
  return [Uint16Array.from(places), Uint8Array.from(sizes)];
}

// How many levels an organ has, and the planes of the coarsest.
function levelsOf(organ: WireOrgan): [number, number] {
  const levels = organ.levels();
  return levels ? [levels.count(), levels.planes()] : [1, organ.sizeZ()];
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
          origin[axis] +
          (organ.voxelPlace[3 * voxel + axis] + part * organ.voxelSize[voxel]) * organ.edge;
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
  const [voxelPlace, voxelSize] = walkRuns(wire);
  const organ: Organ = {
    name: wire.name() ?? '',
    edge: wire.voxelEdgeM() / 2 ** (levelsOf(wire)[0] - 1),
    voxelCount: voxelPlace.length / 3,
    voxelPlace,
    voxelSize,
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

// Whether tissue covers the square of a voxel's size that lies across one of its faces: a voxel of
// its size, one of twice, or four of half. Places are low corners of such voxels.
function covers(organ: Organ): (place: number[], size: number, axis: number, side: number) =>
    boolean {
  const filled = new Map<number, Set<number>>();  // by size
  const key = ([x, y, z]: ArrayLike<number>&Iterable<number>) =>
      x + 1 + 65537 * (y + 1 + 65537 * (z + 1));
  for (let v = 0; v < organ.voxelCount; ++v) {
    const size = organ.voxelSize[v];
    if (!filled.has(size)) filled.set(size, new Set());
    filled.get(size)?.add(key(organ.voxelPlace.subarray(3 * v, 3 * v + 3)));
  }
  const has = (size: number, place: number[]) => filled.get(size)?.has(key(place)) ?? false;
  return (place, size, axis, side) => {
    if (has(size, place) || has(2 * size, place.map((at) => at - at % (2 * size)))) return true;
    const half = size / 2;
    return [0, 1, 2, 3].every((quarter) => {
      const at = [...place];
      at[axis] += side === 1 ? 0 : half;  // those that touch the face
      at[(axis + 1) % 3] += (quarter & 1) * half;
      at[(axis + 2) % 3] += (quarter >> 1) * half;
      return has(half, at);
    });
  };
}

// Edges of the lattice's outer faces, as pairs of particles: what is seen of it from outside.
export function outerEdges(organ: Organ, corners: Uint32Array): Uint32Array {
  const isCovered = covers(organ);
  const seen = new Set<number>();
  const pairs: number[] = [];
  const add = (a: number, b: number) => {
    const edge = Math.min(a, b) * 2 ** 26 + Math.max(a, b);
    if (seen.has(edge)) return;
    seen.add(edge);
    pairs.push(a, b);
  };
  for (let v = 0; v < organ.voxelCount; ++v) {
    const size = organ.voxelSize[v];
    for (let axis = 0; axis < 3; ++axis) {
      for (const side of [0, 1]) {
        const beyond = [...organ.voxelPlace.subarray(3 * v, 3 * v + 3)];
        beyond[axis] += side === 1 ? size : -size;
        if (isCovered(beyond, size, axis, side)) continue;
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
