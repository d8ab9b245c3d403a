// SPDX-License-Identifier: Apache-2.0
// What the engine says as the messages that the console's panels and 3D view know.
import type {Event, Output, Vec3 as Triple} from 'stylet-wasm';

import {
  Activity,
  kProtocol,
  type Frame,
  type Happened,
  type Hello,
  type NeedleFrame,
  type Row,
  type Vec3
} from '../src/protocol';
import type {Opened, Snapshot, Tick} from './engine';

export const kPositionUnit = 10e-6;  // m: as the console's
const kLargest = 32767;
const kMostForce = 10;  // N, of the gauge

const vec = ([x, y, z]: Triple): Vec3 => ({x, y, z});
const along = (a: Triple, b: Triple): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

export function helloOf(opened: Opened, scene: string, entry: Triple, direction: Triple): Hello {
  const {needle} = opened;
  return {
    kind: 'hello',
    protocol: kProtocol,
    version: opened.version,
    scene,
    scenes: [scene],
    period: opened.period,
    recordingTicks: 0,
    voxelEdge: opened.edge,
    particles: opened.rest.length / 3,
    rest: opened.rest,
    corners: opened.corners,
    positionUnit: kPositionUnit,
    needles: [{
      device: '',
      length: needle.length_m,
      outerRadius: needle.outer_radius_m,
      entry: vec(entry),
      direction: vec(direction),
      maxForce: kMostForce,
    }],
    obstacles: [],
    targets: [],
    mayControl: true,
  };
}

function needleOf(tick: Tick, nodes: Float32Array): NeedleFrame {
  const {out, handle} = tick;
  return {
    nodes: Array.from(
        {length: nodes.length / 3},
        (_, i) => ({x: nodes[3 * i], y: nodes[3 * i + 1], z: nodes[3 * i + 2]})),
    handle: vec(handle.position_m),
    handleRotation: handle.rotation,
    tip: vec(out.tip_m),
    depth: out.depth_m,
    phase: out.phase,
    layer: out.layer,
    force: vec(out.force_n),
    command: vec(out.force_n),
    causes: {
      stiffness: vec(out.stiffness_n),
      cutting: vec(out.cutting_n),
      friction: vec(out.friction_n),
      clamping: vec(out.clamping_n),
      obstacle: vec(out.obstacle_n),
    },
    fault: '',
    faultNumber: 0,
    guard: '',
    flags: out.flags,
  };
}

// Signs as the console's: positive along the direction of insertion.
function rowOf(tick: Tick, direction: Triple): Row {
  const {out} = tick;
  const part = (force: Triple) => -along(force, direction);
  const axial = part(out.force_n);
  const size = Math.hypot(...out.force_n);
  return {
    tick: tick.tick,
    depth: out.depth_m,
    travel: tick.travel,
    force: axial,
    lateral: Math.sqrt(Math.max(0, size * size - axial * axial)),
    stiffness: part(out.stiffness_n),
    cutting: part(out.cutting_n),
    friction: part(out.friction_n),
    clamping: part(out.clamping_n),
    obstacle: part(out.obstacle_n),
    tickUs: tick.us,
    lateUs: 0,
    needle: 0,
  };
}

const happened = (e: Event): Happened => ({
  tick: e.tick,
  eventKind: e.kind,
  needle: e.needle,
  layer: e.layer,
  depth: e.depth_m,
  force: e.force_n,
});

export function frameOf(shown: Snapshot, direction: Triple): Frame {
  const movedTo = new Int16Array(shown.moved.length);
  for (let i = 0; i < movedTo.length; ++i) {
    const units = Math.round(shown.moved[i] / kPositionUnit);
    movedTo[i] = Math.max(-kLargest, Math.min(kLargest, units));
  }
  return {
    kind: 'frame',
    tick: shown.tick,
    activity: Activity.Running,
    key: true,
    movedIndex: new Uint32Array(),
    movedTo,
    needles: [needleOf(shown, shown.nodes)],
    particles: shown.particles.map((p) => ({
                                     position: vec(p.position_m),
                                     goal: vec(p.goal_m),
                                     force: vec(p.force_on_needle_n),
                                     needle: p.needle,
                                   })),
    touches: [],
    events: shown.events.map(happened),
    rows: shown.rows.map((row) => rowOf(row, direction)),
    timing: null,
    attempt: 1,
    timeNs: 0n,
  };
}

export const sizeOf = (out: Output): number => Math.hypot(...out.force_n);
