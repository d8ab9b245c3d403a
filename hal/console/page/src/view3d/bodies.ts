// SPDX-License-Identifier: Apache-2.0
// What is in the scene besides the organ: needles, particles and their goals, obstacles, targets,
// touches and the arrow of force.
//
// Promise: showing a frame makes no new objects on the GPU; pools grow, never shrink.
// Units: m; frame: world.
import * as THREE from 'three';
import {ConvexGeometry} from 'three/examples/jsm/geometries/ConvexGeometry.js';
import {MeshGouraudMaterial} from 'three/examples/jsm/materials/MeshGouraudMaterial.js';

import {kBody} from '../palette';

import type {Frame, Hello, NeedleFrame, NeedleInfo, Obstacle, Target, Vec3} from '../protocol';
import {steel} from './steel';

const kSides = 10;       // of the tube
const kMostNodes = 160;  // of a needle
const kHandleLength = 0.028;
const kArrowPerNewton = 0.012;
const kLongestArrow = 0.09;
const kRingParts = 48;
const kMostMarks = 512;  // particles or touches shown

const to = (v: Vec3): THREE.Vector3 => new THREE.Vector3(v.x, v.y, v.z);
// Lit once a vertex, as the organ is.
const matte = (colour: string, more: THREE.MeshLambertMaterialParameters = {}) =>
    new MeshGouraudMaterial({color: colour, ...more});

// A tube with a point at its end; vertices are written anew for every frame.
class Tube {
  readonly mesh: THREE.Mesh;
  private readonly places: THREE.BufferAttribute;
  private readonly normals: THREE.BufferAttribute;
  private readonly alongs: THREE.BufferAttribute;  // m from the tip

  constructor(private readonly radius: number) {
    const geometry = new THREE.BufferGeometry();
    const count = kMostNodes * kSides;
    this.places = new THREE.BufferAttribute(new Float32Array(3 * count), 3);
    this.normals = new THREE.BufferAttribute(new Float32Array(3 * count), 3);
    this.alongs = new THREE.BufferAttribute(new Float32Array(count), 1);
    geometry.setAttribute('position', this.places);
    geometry.setAttribute('normal', this.normals);
    geometry.setAttribute('along', this.alongs);
    const index: number[] = [];
    for (let ring = 0; ring + 1 < kMostNodes; ++ring) {
      for (let side = 0; side < kSides; ++side) {
        const [a, b] = [ring * kSides + side, ring * kSides + ((side + 1) % kSides)];
        index.push(a, b, a + kSides, b, b + kSides, a + kSides);
      }
    }
    geometry.setIndex(index);
    this.mesh = new THREE.Mesh(geometry, steel(kBody.needle, true));
    this.mesh.frustumCulled = false;
  }

  show(nodes: THREE.Vector3[]): void {
    const line = nodes.slice(0, kMostNodes - 1);
    if (line.length < 2) return;
    const across = new THREE.Vector3();
    const along = new THREE.Vector3().subVectors(line[1], line[0]).normalize();
    across.set(Math.abs(along.x) > 0.9 ? 0 : 1, Math.abs(along.x) > 0.9 ? 1 : 0, 0);
    let togo = line.reduce((sum, node, i) => sum + (i > 0 ? node.distanceTo(line[i - 1]) : 0), 0);
    line.forEach((node, i) => {
      if (i > 0) togo -= node.distanceTo(line[i - 1]);
      const next = line[Math.min(i + 1, line.length - 1)];
      const last = line[Math.max(i - 1, 0)];
      along.subVectors(next, last).normalize();
      across.addScaledVector(along, -across.dot(along)).normalize();
      this.ring(i, node, along, across, this.radius, togo);
    });
    // The point: as long as the needle is wide, twice.
    const tip = line[line.length - 1].clone();
    const point = 4 * this.radius;
    this.ring(line.length, tip, along, across, 0, 0);
    this.ring(
        line.length - 1, tip.addScaledVector(along, -point), along, across, this.radius, point);
    this.mesh.geometry.setDrawRange(0, line.length * kSides * 6);
    for (const each of [this.places, this.normals, this.alongs]) each.needsUpdate = true;
  }

  private ring(
      at: number, centre: THREE.Vector3, along: THREE.Vector3, across: THREE.Vector3, r: number,
      togo: number): void {
    const up = new THREE.Vector3().crossVectors(along, across);
    for (let side = 0; side < kSides; ++side) {
      const turn = (2 * Math.PI * side) / kSides;
      const [c, s] = [Math.cos(turn), Math.sin(turn)];
      const n = [0, 1, 2].map((k) => c * across.getComponent(k) + s * up.getComponent(k));
      const i = at * kSides + side;
      this.normals.setXYZ(i, n[0], n[1], n[2]);
      this.alongs.setX(i, togo);
      this.places.setXYZ(i, centre.x + r * n[0], centre.y + r * n[1], centre.z + r * n[2]);
    }
  }
}

class Needle {
  readonly group = new THREE.Group();
  private readonly tube: Tube;
  private readonly handle: THREE.Mesh;
  private readonly arrow: THREE.Group;
  private readonly shaft: THREE.Mesh;
  private readonly head: THREE.Mesh;

  constructor(private readonly info: NeedleInfo) {
    // Thin needles are drawn a little thicker than they are, or they would fall between pixels.
    this.tube = new Tube(Math.max(info.outerRadius, 0.0006));
    const grip = Math.max(5 * info.outerRadius, 0.0035);
    const handle = new THREE.CylinderGeometry(grip, 0.75 * grip, kHandleLength, 20);
    handle.rotateX(Math.PI / 2);
    handle.translate(0, 0, kHandleLength / 2);
    this.handle = new THREE.Mesh(handle, matte(kBody.handle));
    // A fin along +x: the side a bevel faces.
    const fin = new THREE.BoxGeometry(1.1 * grip, 0.35 * grip, 0.5 * kHandleLength);
    fin.translate(1.1 * grip, 0, kHandleLength / 2);
    this.handle.add(new THREE.Mesh(fin, steel(kBody.needle, false)));
    this.arrow = new THREE.Group();
    const ink = matte(kBody.force, {emissive: '#3d2900'});
    this.shaft =
        new THREE.Mesh(new THREE.CylinderGeometry(0.0011, 0.0011, 1, 12).translate(0, 0.5, 0), ink);
    this.head =
        new THREE.Mesh(new THREE.ConeGeometry(0.0034, 0.009, 16).translate(0, 0.0045, 0), ink);
    this.arrow.add(this.shaft, this.head);
    this.group.add(this.tube.mesh, this.handle, this.arrow);
  }

  show(frame: NeedleFrame): void {
    this.handle.position.copy(to(frame.handle));
    const q = frame.handleRotation;
    this.handle.quaternion.set(q.x, q.y, q.z, q.w);
    // Between attempts there is no shape yet: the needle is straight.
    const straight = [this.handle.position, this.pointAhead()];
    this.tube.show(frame.nodes.length > 1 ? frame.nodes.map(to) : straight);
    const force = to(frame.force);
    const size = force.length();
    this.arrow.visible = size > 0.02;
    if (!this.arrow.visible) return;
    const length = Math.min(kLongestArrow, kArrowPerNewton * size);
    const from =
        to(frame.handle)
            .add(new THREE.Vector3(0, 0, kHandleLength).applyQuaternion(this.handle.quaternion));
    this.arrow.position.copy(from);
    this.arrow.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), force.divideScalar(size));
    this.shaft.scale.set(1, length, 1);
    this.head.position.set(0, length, 0);
  }

  private pointAhead(): THREE.Vector3 {
    const along =
        new THREE.Vector3(0, 0, -this.info.length).applyQuaternion(this.handle.quaternion);
    return along.add(this.handle.position);
  }
}

// Small equal bodies, as many as a frame has.
class Dots {
  readonly mesh: THREE.InstancedMesh;
  constructor(geometry: THREE.BufferGeometry, material: THREE.Material) {
    this.mesh = new THREE.InstancedMesh(geometry, material, kMostMarks);
    this.mesh.frustumCulled = false;
    this.mesh.count = 0;
  }
  show(places: Vec3[]): void {
    const matrix = new THREE.Matrix4();
    this.mesh.count = Math.min(places.length, kMostMarks);
    for (let i = 0; i < this.mesh.count; ++i) {
      this.mesh.setMatrixAt(i, matrix.makeTranslation(places[i].x, places[i].y, places[i].z));
    }
    this.mesh.instanceMatrix.needsUpdate = true;
  }
}

// The hull of the vertices, each grown to a ball of the rounding.
function obstacleMesh(obstacle: Obstacle): THREE.Mesh {
  const material = matte(kBody.obstacle);
  let geometry: THREE.BufferGeometry;
  if (obstacle.vertices.length === 1) {
    const centre = obstacle.vertices[0];
    geometry = new THREE.SphereGeometry(obstacle.rounding, 32, 20);
    geometry.translate(centre.x, centre.y, centre.z);
  } else {
    const ball = obstacle.rounding > 0 ? ballPoints(obstacle.rounding) : [new THREE.Vector3()];
    const points = obstacle.vertices.flatMap((v) => ball.map((b) => to(v).add(b)));
    geometry = new ConvexGeometry(points);
  }
  const mesh = new THREE.Mesh(geometry, material);
  const q = obstacle.rotation;
  mesh.position.copy(to(obstacle.position));
  mesh.quaternion.set(q.x, q.y, q.z, q.w);
  return mesh;
}

function ballPoints(radius: number): THREE.Vector3[] {
  const places = new THREE.IcosahedronGeometry(radius, 1).getAttribute('position');
  return Array.from(
      {length: places.count}, (_, i) => new THREE.Vector3().fromBufferAttribute(places, i));
}

// A circle on a ball, across one axis, as pairs of points; shift: how far up, 1 at the pole.
function ring(radius: number, axis: number, shift: number): THREE.Vector3[] {
  const across = radius * Math.sqrt(1 - shift * shift);
  const at = (i: number) => {
    const turn = (2 * Math.PI * i) / kRingParts;
    const place = new THREE.Vector3().setComponent(axis, shift * radius);
    place.setComponent((axis + 1) % 3, across * Math.cos(turn));
    return place.setComponent((axis + 2) % 3, across * Math.sin(turn));
  };
  return Array.from({length: kRingParts}, (_, i) => [at(i), at(i + 1)]).flat();
}

// A target is a ball in rings; a forbidden zone has bars, so that colour is not the only sign.
function targetGroup(target: Target): THREE.Group {
  const group = new THREE.Group();
  const colour = target.forbidden ? kBody.forbidden : kBody.target;
  const radius = Math.max(target.radius, 0.001);
  const ball = new THREE.Mesh(
      new THREE.SphereGeometry(radius, 24, 14),
      matte(colour, {transparent: true, opacity: 0.35, depthWrite: false}),
  );
  ball.renderOrder = 1;
  group.add(ball);
  const parts = target.forbidden ?
      [-0.75, -0.4, 0, 0.4, 0.75].map((shift) => ring(radius, 2, shift)) :
      [0, 1, 2].map((axis) => ring(radius, axis, 0));
  const rings = new THREE.BufferGeometry().setFromPoints(parts.flat());
  group.add(new THREE.LineSegments(rings, new THREE.LineBasicMaterial({color: colour})));
  group.position.copy(to(target.position));
  return group;
}

export class Bodies {
  readonly group = new THREE.Group();
  private readonly needles: Needle[];
  private readonly particles: Dots;
  private readonly goals: Dots;
  private readonly touches: Dots;
  private readonly links: THREE.LineSegments;

  constructor(hello: Hello) {
    this.needles = hello.needles.map((info) => new Needle(info));
    const size = Math.min(0.0014, hello.voxelEdge / 4);
    this.particles = new Dots(new THREE.IcosahedronGeometry(size, 2), matte(kBody.particle));
    const ghost = matte(kBody.goal, {transparent: true, opacity: 0.75});
    this.goals = new Dots(new THREE.IcosahedronGeometry(0.8 * size, 1), ghost);
    this.touches = new Dots(new THREE.IcosahedronGeometry(1.2 * size, 2), matte(kBody.force));
    const lines = new THREE.BufferGeometry();
    lines.setAttribute('position', new THREE.BufferAttribute(new Float32Array(6 * kMostMarks), 3));
    this.links = new THREE.LineSegments(lines, new THREE.LineBasicMaterial({color: kBody.goal}));
    this.links.frustumCulled = false;
    const parts = [
      ...this.needles.map((n) => n.group), this.particles.mesh, this.goals.mesh, this.touches.mesh,
      this.links, ...hello.obstacles.filter((o) => o.vertices.length > 0).map(obstacleMesh),
      ...hello.targets.map(targetGroup)
    ];
    this.group.add(...parts);
  }

  show(frame: Frame): void {
    frame.needles.forEach((needle, i) => this.needles[i]?.show(needle));
    this.particles.show(frame.particles.map((p) => p.position));
    this.goals.show(frame.particles.map((p) => p.goal));
    this.touches.show(frame.touches.map((t) => t.position));
    const ends = this.links.geometry.getAttribute('position') as THREE.BufferAttribute;
    const count = Math.min(frame.particles.length, kMostMarks);
    for (let i = 0; i < count; ++i) {
      const {position: p, goal: g} = frame.particles[i];
      ends.setXYZ(2 * i, p.x, p.y, p.z);
      ends.setXYZ(2 * i + 1, g.x, g.y, g.z);
    }
    ends.needsUpdate = true;
    this.links.geometry.setDrawRange(0, 2 * count);
  }

  showParticles(visible: boolean): void {
    for (const thing of [this.particles.mesh, this.goals.mesh, this.links]) thing.visible = visible;
  }
}

export function disposeAll(root: THREE.Object3D): void {
  root.traverse((thing) => {
    const mesh = thing as Partial<THREE.Mesh>;
    mesh.geometry?.dispose();
    for (const material of [mesh.material ?? []].flat()) material.dispose();
  });
}
