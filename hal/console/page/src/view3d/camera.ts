// SPDX-License-Identifier: Apache-2.0
// Where one looks from: the presets, and turning by mouse, finger or key.
//
// Presets are made of the insertion's direction d and the organ's box: side, across d with d to the
// right, as in the paper's Fig. 7 to 9; behind, along d, over the handle; tip, close to the tip.
import * as THREE from 'three';
import {OrbitControls} from 'three/examples/jsm/controls/OrbitControls.js';
import type {Hello, Vec3} from '../protocol';

export const kPresets = ['side', 'oblique', 'behind', 'above', 'tip'] as const;
export type Preset = (typeof kPresets)[number];
const kMoveMs = 350;
const kShownShaft = 0.75;  // share of the needle outside that is in the picture
const kOnNarrow = 0.3;     // the same in a picture that is higher than wide
const kRoom = 1.1;
const kFreeHeight = 0.8;   // between legend and buttons
const kTipDistance = 1.2;  // sizes of the organ

export interface Aim {
  points: THREE.Vector3[];                             // what is to be seen: the organ's box
  shaft: {entry: THREE.Vector3, length: number}|null;  // and of the needle a part
  size: number;                                        // half of the box's diagonal
  direction: THREE.Vector3;                            // of insertion
  up: THREE.Vector3;
}

export function aimAt(hello: Hello): Aim {
  const box = new THREE.Box3();
  const at = new THREE.Vector3();
  for (let i = 0; i < hello.rest.length; i += 3) box.expandByPoint(at.fromArray(hello.rest, i));
  const points = Array.from(
      {length: 8},
      (_, i) => new THREE.Vector3(
          i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
          i & 4 ? box.max.z : box.min.z));
  const needle = hello.needles[0];
  const direction = needle ?
      new THREE.Vector3(needle.direction.x, needle.direction.y, needle.direction.z).normalize() :
      new THREE.Vector3(1, 0, 0);
  const shaft = needle ? {
    entry: new THREE.Vector3(needle.entry.x, needle.entry.y, needle.entry.z),
    length: needle.length
  } :
                         null;
  const up = Math.abs(direction.y) < 0.9 ? new THREE.Vector3(0, 1, 0) : new THREE.Vector3(0, 0, 1);
  return {points, shaft, size: Math.max(box.getSize(at).length() / 2, 0.01), direction, up};
}

// Where to stand and look at so that all points are within the picture and as large as they can be.
function fit(
    points: THREE.Vector3[], from: THREE.Vector3, up: THREE.Vector3,
    camera: THREE.PerspectiveCamera) {
  const right = new THREE.Vector3().crossVectors(up, from).normalize();
  const above = new THREE.Vector3().crossVectors(from, right);
  const spans = [right, above, from].map((axis) => {
    const along = points.map((p) => p.dot(axis));
    return [Math.min(...along), Math.max(...along)];
  });
  const [middle, half] = [(s: number[]) => (s[0] + s[1]) / 2, (s: number[]) => (s[1] - s[0]) / 2];
  const target = new THREE.Vector3();
  [right, above, from].forEach((axis, i) => target.addScaledVector(axis, middle(spans[i])));
  const slope = Math.tan((camera.fov * Math.PI) / 360);
  const wide = half(spans[0]) / (slope * camera.aspect);
  const high = half(spans[1]) / (slope * kFreeHeight);
  const distance = kRoom * Math.max(wide, high) + half(spans[2]);
  return {target, position: target.clone().addScaledVector(from, distance)};
}

export class CameraMan {
  readonly camera = new THREE.PerspectiveCamera(30, 1, 0.002, 5);
  readonly controls: OrbitControls;
  private aim: Aim|null = null;
  private goal: {position: THREE.Vector3; target: THREE.Vector3; began: number}|null = null;
  private from = {position: new THREE.Vector3(), target: new THREE.Vector3()};

  constructor(
      element: HTMLElement,
      readonly still: () => boolean,  // the user asked for less motion
      changed: () => void,
  ) {
    this.controls = new OrbitControls(this.camera, element);
    this.controls.minDistance = 0.02;
    this.controls.maxDistance = 3;
    this.controls.addEventListener('change', changed);
    this.controls.addEventListener('start', () => (this.goal = null));
  }

  setScene(aim: Aim): void {
    this.aim = aim;
    this.camera.up.copy(aim.up);
    this.look('side', null, true);
  }

  look(preset: Preset, tip: Vec3|null, atOnce = this.still()): void {
    if (this.aim === null) return;
    const {points, shaft, size, direction, up} = this.aim;
    const across = new THREE.Vector3().crossVectors(direction, up).normalize();
    const from: Record<Preset, THREE.Vector3> = {
      side: across.clone().addScaledVector(up, 0.12),
      oblique: across.clone().addScaledVector(direction, -0.7).addScaledVector(up, 0.5),
      behind: direction.clone().negate().addScaledVector(up, 0.3).addScaledVector(across, 0.12),
      above: up.clone().addScaledVector(across, 0.02),
      tip: across.clone().addScaledVector(up, 0.25),
    };
    const toward = from[preset].normalize();
    const part = this.camera.aspect < 1 ? kOnNarrow : kShownShaft;
    const seen = shaft ?
        [...points, shaft.entry.clone().addScaledVector(direction, -part * shaft.length)] :
        points;
    let {position, target} = fit(seen, toward, up, this.camera);
    if (preset === 'tip' && tip) {
      target = new THREE.Vector3(tip.x, tip.y, tip.z);
      position = target.clone().addScaledVector(toward, kTipDistance * size);
    }
    this.from.position.copy(this.camera.position);
    this.from.target.copy(this.controls.target);
    this.goal = {position, target, began: atOnce ? -kMoveMs : performance.now()};
    this.move(atOnce ? kMoveMs : performance.now());
  }

  // Keys: turn by degrees, nearer by a factor.
  nudge(right: number, up: number, nearer: number): void {
    this.goal = null;
    const turn =
        new THREE.Quaternion().setFromUnitVectors(this.camera.up, new THREE.Vector3(0, 1, 0));
    const offset = this.camera.position.clone().sub(this.controls.target).applyQuaternion(turn);
    const ball = new THREE.Spherical().setFromVector3(offset);
    ball.theta -= (right * Math.PI) / 180;
    ball.phi = Math.min(Math.PI - 0.05, Math.max(0.05, ball.phi - (up * Math.PI) / 180));
    ball.radius *= nearer;
    offset.setFromSpherical(ball).applyQuaternion(turn.invert());
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
  }

  // True while a preset's move goes on.
  move(now: number): boolean {
    if (this.goal === null) return false;
    const part = Math.min(1, (now - this.goal.began) / kMoveMs);
    const eased = part * part * (3 - 2 * part);
    this.camera.position.lerpVectors(this.from.position, this.goal.position, eased);
    this.controls.target.lerpVectors(this.from.target, this.goal.target, eased);
    this.controls.update();
    if (part === 1) this.goal = null;
    return this.goal !== null;
  }
}
