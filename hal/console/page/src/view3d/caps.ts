// SPDX-License-Identifier: Apache-2.0
// Where tissue was cut, its inside in the colours of its tissues: the face of the plane that cuts
// it open in the view, and the faces where a part was cropped out of a larger body.
//
// Both are made of the voxels on the processor, from where a frame moved their corners: a plane
// meets a few hundred of them. A voxel on the rim is larger than the tissue in it; of a closed
// surface the face is drawn only where one looks into the surface (stencil, see surface.ts).
// Units: m; frame: world.
import * as THREE from 'three';

import type {Organ} from '../organ';
import {materialColours} from '../palette';
import type {Hello} from '../protocol';

const kLit = 0.86;                    // a flat face, beside a surface that is lit
const kSideLit = [0.72, 0.86, 0.78];  // of cropped faces, by axis, so that they are told apart
const kGrain = 0.035;                 // lighter or darker, by voxel: a face shows how it is bent
const kClear = 0.3;                   // in an x-ray
const kCropShare = 0.05;              // of all open edges lie at a plane where tissue was cropped

// Pairs of corners dx + 2 dy + 4 dz that differ in one axis.
const kEdges = [0, 1, 2].flatMap(
    (axis) => [0, 1, 2, 3, 4, 5, 6, 7].filter((corner) => !(corner & (1 << axis))).map((corner): [
      number, number
    ] => [corner, corner | (1 << axis)]));

interface Quad {
  voxel: number;
  corners: number[];  // particles, around
  axis: number;
}

const lightOf = (voxel: number): number =>
    1 + kGrain * ((Math.imul(voxel, 0x9e3779b1) >>> 24) / 127.5 - 1);

// Edges with one triangle, as pairs of vertices.
function openEdges(triangles: Uint32Array): [number, number][] {
  const single = new Map<number, [number, number]>();
  for (let t = 0; t < triangles.length; t += 3) {
    for (let side = 0; side < 3; ++side) {
      const [a, b] = [triangles[t + side], triangles[t + (side + 1) % 3]];
      const edge = Math.min(a, b) * 2 ** 26 + Math.max(a, b);
      if (!single.delete(edge)) single.set(edge, [a, b]);
    }
  }
  return [...single.values()];
}

// Outer faces of voxels on those sides of the lattice's box where the surface is open.
export function croppedFaces(organ: Organ, hello: Hello): Quad[] {
  const edges = openEdges(organ.triangles);
  const {voxelPlace, voxelSize, voxelCount, vertexVoxel} = organ;
  const quads: Quad[] = [];
  if (edges.length === 0) return quads;
  for (let axis = 0; axis < 3; ++axis) {
    const end = (v: number, side: number) => voxelPlace[3 * v + axis] + side * voxelSize[v];
    let [low, high] = [Infinity, -Infinity];
    for (let v = 0; v < voxelCount; ++v) {
      low = Math.min(low, end(v, 0));
      high = Math.max(high, end(v, 1));
    }
    for (const side of [0, 1]) {
      const layer = side === 1 ? high : low;
      const at = (vertex: number) => end(vertexVoxel[vertex], side) === layer;
      const here = edges.filter(([a, b]) => at(a) && at(b)).length;
      if (here < kCropShare * edges.length) continue;
      const [p, q] = [1 << (axis + 1) % 3, 1 << (axis + 2) % 3];
      const base = side << axis;
      for (let v = 0; v < voxelCount; ++v) {
        if (end(v, side) !== layer) continue;
        const corners =
            [base, base + p, base + p + q, base + q].map((c) => hello.corners[8 * v + c]);
        quads.push({voxel: v, corners, axis});
      }
    }
  }
  return quads;
}

// The polygon in which a plane meets a voxel, given the signed distances of its corners from it;
// null: it does not. Corners of the polygon are in order around it.
export function slice(
    corner: (index: number) => THREE.Vector3, distance: number[],
    normal: THREE.Vector3): THREE.Vector3[]|null {
  const points: THREE.Vector3[] = [];
  for (const [a, b] of kEdges) {
    const [da, db] = [distance[a], distance[b]];
    if (da < 0 === db < 0) continue;
    points.push(corner(a).lerp(corner(b), da / (da - db)));
  }
  if (points.length < 3) return null;
  const middle = new THREE.Vector3();
  for (const point of points) middle.addScaledVector(point, 1 / points.length);
  const right = new THREE.Vector3().subVectors(points[0], middle).normalize();
  const up = new THREE.Vector3().crossVectors(normal, right);
  const turn = (point: THREE.Vector3) => {
    const from = point.clone().sub(middle);
    return Math.atan2(from.dot(up), from.dot(right));
  };
  return points.map((point) => ({point, at: turn(point)}))
      .sort((a, b) => a.at - b.at)
      .map(({point}) => point);
}

// Triangles with a colour each, written anew for every frame; room grows, never shrinks.
class Faces {
  readonly mesh: THREE.Mesh<THREE.BufferGeometry, THREE.MeshBasicMaterial>;
  private places = new Float32Array(0);
  private colours = new Float32Array(0);
  private count = 0;

  constructor() {
    const material = new THREE.MeshBasicMaterial({vertexColors: true, side: THREE.DoubleSide});
    this.mesh = new THREE.Mesh(new THREE.BufferGeometry(), material);
    this.mesh.frustumCulled = false;
  }

  begin(): void { this.count = 0; }

  fan(points: THREE.Vector3[], colour: number[], lit: number): void {
    this.grow(this.count + 3 * (points.length - 2));
    for (let i = 2; i < points.length; ++i) {
      for (const point of [points[0], points[i - 1], points[i]]) {
        point.toArray(this.places, 3 * this.count);
        for (let k = 0; k < 3; ++k) this.colours[3 * this.count + k] = lit * colour[k];
        ++this.count;
      }
    }
  }

  finish(): void {
    const {geometry} = this.mesh;
    geometry.setDrawRange(0, this.count);
    for (const name of ['position', 'color']) {
      const attribute = geometry.getAttribute(name);
      if (attribute) attribute.needsUpdate = true;
    }
  }

  private grow(needed: number): void {
    if (3 * needed <= this.places.length) return;
    const [places, colours] = [this.places, this.colours];
    const room = 3 * Math.max(needed, 2 * this.count, 1024);
    this.places = new Float32Array(room);
    this.colours = new Float32Array(room);
    this.places.set(places);
    this.colours.set(colours);
    const {geometry} = this.mesh;
    geometry.dispose();  // attributes of another size need buffers of their own
    geometry.setAttribute('position', new THREE.BufferAttribute(this.places, 3));
    geometry.setAttribute('color', new THREE.BufferAttribute(this.colours, 3));
  }
}

export class Caps {
  readonly group = new THREE.Group();
  private readonly cut = new Faces();
  private readonly cropped = new Faces();
  private readonly quads: Quad[];
  private readonly tissues: number[][];
  private readonly distances: Float32Array;

  // open: the surface has an edge, so that no stencil can tell its inside.
  constructor(private readonly organ: Organ, private readonly hello: Hello, open: boolean) {
    this.quads = open ? croppedFaces(organ, hello) : [];
    this.tissues = materialColours(organ.materials).map((c) => new THREE.Color(c).toArray());
    this.distances = new Float32Array(hello.particles);
    const {material} = this.cut.mesh;
    material.stencilWrite = !open;
    material.stencilFunc = THREE.NotEqualStencilFunc;
    material.stencilZPass = material.stencilZFail = THREE.ReplaceStencilOp;  // ready for the next
    this.cut.mesh.renderOrder = this.cropped.mesh.renderOrder = 2.5;
    this.group.add(this.cut.mesh, this.cropped.mesh);
  }

  setLook(xray: boolean, cut: boolean, surface: boolean): void {
    this.cut.mesh.visible = cut && surface;
    this.cropped.mesh.visible = surface && !xray;
    const {material} = this.cut.mesh;
    material.transparent = xray;
    material.opacity = xray ? kClear : 1;
    material.depthWrite = !xray;
  }

  // plane: of points p with normal . p = w; what lies beyond it is not drawn.
  move(moved: Int16Array, plane: THREE.Vector4): void {
    if (this.cut.mesh.visible) this.cutOpen(moved, plane);
    if (this.cropped.mesh.visible) this.closeCropped(moved, plane);
  }

  private place(particle: number, moved: Int16Array): THREE.Vector3 {
    const {rest, positionUnit: unit} = this.hello;
    const [r, m] = [3 * particle, 4 * particle];
    return new THREE.Vector3(
        rest[r] + unit * moved[m], rest[r + 1] + unit * moved[m + 1],
        rest[r + 2] + unit * moved[m + 2]);
  }

  private tissue(voxel: number): number[] {
    return this.tissues[this.organ.voxelMaterial[voxel]] ?? [0.5, 0.5, 0.5];
  }

  private measure(moved: Int16Array, plane: THREE.Vector4): void {
    const {rest, positionUnit: unit} = this.hello;
    for (let i = 0; i < this.distances.length; ++i) {
      const [r, m] = [3 * i, 4 * i];
      this.distances[i] = plane.x * (rest[r] + unit * moved[m]) +
          plane.y * (rest[r + 1] + unit * moved[m + 1]) +
          plane.z * (rest[r + 2] + unit * moved[m + 2]) - plane.w;
    }
  }

  private cutOpen(moved: Int16Array, plane: THREE.Vector4): void {
    this.measure(moved, plane);
    this.cut.begin();
    const normal = new THREE.Vector3(plane.x, plane.y, plane.z);
    const {corners} = this.hello;
    for (let v = 0; v < this.organ.voxelCount; ++v) {
      let beyond = 0;
      for (let c = 0; c < 8; ++c) beyond += this.distances[corners[8 * v + c]] < 0 ? 0 : 1;
      if (beyond === 0 || beyond === 8) continue;
      const distance = kCorners.map((c) => this.distances[corners[8 * v + c]]);
      const polygon = slice((c) => this.place(corners[8 * v + c], moved), distance, normal);
      if (polygon) this.cut.fan(polygon, this.tissue(v), kLit * lightOf(v));
    }
    this.cut.finish();
  }

  private closeCropped(moved: Int16Array, plane: THREE.Vector4): void {
    this.cropped.begin();
    const beyond = (p: THREE.Vector3) => plane.x * p.x + plane.y * p.y + plane.z * p.z > plane.w;
    for (const {voxel, corners, axis} of this.quads) {
      const places = corners.map((particle) => this.place(particle, moved));
      if (!places.some(beyond))
        this.cropped.fan(places, this.tissue(voxel), kSideLit[axis] * lightOf(voxel));
    }
    this.cropped.finish();
  }
}

const kCorners = [0, 1, 2, 3, 4, 5, 6, 7];
