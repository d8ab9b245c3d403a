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

export interface Aim {
  centre: THREE.Vector3;
  size: number;              // radius of what is to be seen
  direction: THREE.Vector3;  // of insertion
  up: THREE.Vector3;
}

// The needle's side counts half, so that the organ stays large.
export function aimAt(hello: Hello): Aim {
  const box = new THREE.Box3();
  const at = new THREE.Vector3();
  for (let i = 0; i < hello.rest.length; i += 3) box.expandByPoint(at.fromArray(hello.rest, i));
  const needle = hello.needles[0];
  const direction = needle ?
      new THREE.Vector3(needle.direction.x, needle.direction.y, needle.direction.z).normalize() :
      new THREE.Vector3(1, 0, 0);
  const size = box.getSize(new THREE.Vector3()).length() / 2;
  const centre = box.getCenter(new THREE.Vector3());
  if (needle) {
    const entry = new THREE.Vector3(needle.entry.x, needle.entry.y, needle.entry.z);
    centre.lerp(entry, 0.25).addScaledVector(direction, -0.2 * size);
  }
  const up = Math.abs(direction.y) < 0.9 ? new THREE.Vector3(0, 1, 0) : new THREE.Vector3(0, 0, 1);
  return {centre, size: Math.max(size, 0.01), direction, up};
}

export class CameraMan {
  readonly camera = new THREE.PerspectiveCamera(30, 1, 0.002, 5);
  readonly controls: OrbitControls;
  private aim: Aim|null = null;
  private goal: {position: THREE.Vector3; target: THREE.Vector3; began: number}|null = null;
  private from = {position: new THREE.Vector3(), target: new THREE.Vector3()};

  constructor(
      element: HTMLElement,
      private readonly still: () => boolean,  // the user asked for less motion
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
    const {centre, size, direction, up} = this.aim;
    const across = new THREE.Vector3().crossVectors(direction, up).normalize();
    const target = preset === 'tip' && tip ? new THREE.Vector3(tip.x, tip.y, tip.z) : centre;
    const from: Record<Preset, THREE.Vector3> = {
      side: across.clone().addScaledVector(up, 0.12),
      oblique: across.clone().addScaledVector(direction, -0.7).addScaledVector(up, 0.5),
      behind: direction.clone().negate().addScaledVector(up, 0.3).addScaledVector(across, 0.12),
      above: up.clone().addScaledVector(across, 0.02),
      tip: across.clone().addScaledVector(up, 0.25),
    };
    const half = (this.camera.fov / 2) * (Math.PI / 180);
    const narrow = Math.min(1, this.camera.aspect / 1.25);
    const distance = ((preset === 'tip' ? 0.3 : 1) * size) / Math.tan(half) / narrow;
    const position = target.clone().addScaledVector(from[preset].normalize(), distance);
    this.from.position.copy(this.camera.position);
    this.from.target.copy(this.controls.target);
    this.goal = {position, target: target.clone(), began: atOnce ? -kMoveMs : performance.now()};
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
