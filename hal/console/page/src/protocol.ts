// SPDX-License-Identifier: Apache-2.0
// Messages of hal/console/console.fbs as plain objects, and back to bytes.
//
// Everything the page knows of FlatBuffers is here and in organ.ts. Units and frames: as the
// schema.
import * as flatbuffers from 'flatbuffers';

import * as wire from '../generated/console_generated';

export const kProtocol = 2;
const kIdentifier = 'STLC';

export interface Vec3 {
  x: number;
  y: number;
  z: number;
}
export interface Quaternion extends Vec3 {
  w: number;
}

export enum Phase {
  Free,
  Contact,
  Inserted,
  Retracting,
}
export enum Activity {
  Ready,
  Running,
  Paused,
  Ended,
  Playback,
}
export const kNoLayer = 0xffffffff;

export interface Obstacle {
  position: Vec3;
  rotation: Quaternion;
  vertices: Vec3[];
  rounding: number;
}
export interface Target {
  name: string;
  position: Vec3;
  radius: number;
  forbidden: boolean;
}
export interface NeedleInfo {
  device: string;
  length: number;
  outerRadius: number;
  entry: Vec3;
  direction: Vec3;
  maxForce: number;
}
export interface Hello {
  kind: 'hello';
  protocol: number;
  version: string;
  scene: string;
  scenes: string[];
  period: number;
  recordingTicks: number;
  voxelEdge: number;
  particles: number;
  rest: Float32Array;    // x y z each
  corners: Uint32Array;  // 8 a voxel
  positionUnit: number;
  needles: NeedleInfo[];
  obstacles: Obstacle[];
  targets: Target[];
  mayControl: boolean;
}
export interface NeedleFrame {
  nodes: Vec3[];
  handle: Vec3;
  handleRotation: Quaternion;
  tip: Vec3;
  depth: number;
  phase: Phase;
  layer: number;
  force: Vec3;
  command: Vec3;
  causes: Record<Cause, Vec3>;
  fault: string;
  faultNumber: number;
  guard: string;
  flags: number;
}
export const kCauses = ['stiffness', 'cutting', 'friction', 'clamping', 'obstacle'] as const;
export type Cause = (typeof kCauses)[number];

export interface ConstraintParticle {
  position: Vec3;
  goal: Vec3;
  force: Vec3;
  needle: number;
}
export interface Touch {
  position: Vec3;
  force: Vec3;
  needle: number;
}
export interface Happened {
  tick: number;
  eventKind: number;
  needle: number;
  layer: number;
  depth: number;
  force: number;
}
export interface Row extends Record<Cause, number> {
  tick: number;
  depth: number;
  travel: number;
  force: number;
  lateral: number;
  tickUs: number;
  lateUs: number;
  needle: number;
}
export interface Timing {
  ticks: number;
  missed: number;
  lostRecords: number;
  lostFrames: number;
  connections: number;
  tickUs: Float32Array;
  lateUs: Float32Array;
  tickBins: Uint32Array;
  lateBins: Uint32Array;
  binUs: number;
}
export interface Frame {
  kind: 'frame';
  tick: number;
  activity: Activity;
  key: boolean;
  movedIndex: Uint32Array;
  movedTo: Int16Array;
  needles: NeedleFrame[];
  particles: ConstraintParticle[];
  touches: Touch[];
  events: Happened[];
  rows: Row[];
  timing: Timing|null;
  attempt: number;  // from 1; 0: none yet, or a recording
  timeNs: bigint;   // of the server's clock, for acknowledge
}
export interface RowsAnswer {
  kind: 'rows';
  first: number;
  stride: number;
  rows: Row[];
  events: Happened[];
}
export interface Score {
  kind: 'score';
  attempt: number;
  scene: string;
  trainee: string;
  began: string;
  duration: number;
  path: number;
  depthPath: number;
  punctures: {tick: number; layer: string; force: number}[];
  withdrawals: number;
  targets: {name: string; forbidden: boolean; closest: number; reached: boolean}[];
  peakForce: number;
  peakLateral: number;
  meanForce: number;
  faults: number;
  recording: string;
  rows: Row[];
}
export interface Marked {
  kind: 'marked';
  tick: number;
  text: string;
  attempt: number;  // 0: of a recording
}
export interface Refused {
  kind: 'refused';
  what: string;
}
export type FromServer = Hello|Frame|RowsAnswer|Score|Marked|Refused;

const kOrigin: Vec3 = {
  x: 0,
  y: 0,
  z: 0
};
const kUpright: Quaternion = {
  w: 1,
  x: 0,
  y: 0,
  z: 0
};

const vec3 = (v: wire.Vec3|null): Vec3 => (v ? {x: v.x(), y: v.y(), z: v.z()} : kOrigin);
const quaternion = (q: wire.Quaternion|null): Quaternion =>
    q ? {w: q.w(), x: q.x(), y: q.y(), z: q.z()} : kUpright;
const text = (s: string|Uint8Array|null): string => (typeof s === 'string' ? s : '');

// Elements that may still be read of the present message: each takes at least four bytes of it, so
// that a wrong length cannot keep the page busy.
let allowance = 0;
function take(count: number): void {
  allowance -= count;
  if (count < 0 || allowance < 0) throw new RangeError('more elements than bytes');
}

function list<Wire, Plain>(
    count: number,
    at: (i: number) => Wire | null,
    read: (item: Wire) => Plain,
    ): Plain[] {
  take(count);
  const out: Plain[] = [];
  for (let i = 0; i < count; ++i) {
    const item = at(i);
    if (item !== null) out.push(read(item));
  }
  return out;
}

function needleInfo(n: wire.NeedleInfo): NeedleInfo {
  return {
    device: text(n.device()),
    length: n.lengthM(),
    outerRadius: n.outerRadiusM(),
    entry: vec3(n.entryM()),
    direction: vec3(n.direction()),
    maxForce: n.maxForceN(),
  };
}

function obstacle(o: wire.Obstacle): Obstacle {
  return {
    position: vec3(o.positionM()),
    rotation: quaternion(o.rotation()),
    vertices: list(o.verticesMLength(), (i) => o.verticesM(i), vec3),
    rounding: o.roundingM(),
  };
}

function restOf(h: wire.Hello): Float32Array {
  take(h.restMLength());
  const out = new Float32Array(3 * h.restMLength());
  const v = new wire.Vec3();
  for (let i = 0; 3 * i < out.length; ++i) {
    h.restM(i, v);
    out[3 * i] = v.x();
    out[3 * i + 1] = v.y();
    out[3 * i + 2] = v.z();
  }
  return out;
}

function hello(h: wire.Hello): Hello {
  return {
    kind: 'hello',
    protocol: h.protocol(),
    version: text(h.styletVersion()),
    scene: text(h.scene()),
    scenes: list(h.scenesLength(), (i) => h.scenes(i), text),
    period: h.periodS(),
    recordingTicks: Number(h.recordingTicks()),
    voxelEdge: h.voxelEdgeM(),
    particles: h.particles(),
    rest: restOf(h),
    corners: (h.cornersArray() ?? new Uint32Array()).slice(),
    positionUnit: h.positionUnitM(),
    needles: list(h.needlesLength(), (i) => h.needles(i), needleInfo),
    obstacles: list(h.obstaclesLength(), (i) => h.obstacles(i), obstacle),
    targets: list(h.targetsLength(), (i) => h.targets(i), (t) => ({
                                                            name: text(t.name()),
                                                            position: vec3(t.positionM()),
                                                            radius: t.radiusM(),
                                                            forbidden: t.forbidden(),
                                                          })),
    mayControl: h.mayControl(),
  };
}

function needleFrame(n: wire.NeedleFrame): NeedleFrame {
  return {
    nodes: list(n.nodesMLength(), (i) => n.nodesM(i), vec3),
    handle: vec3(n.handlePositionM()),
    handleRotation: quaternion(n.handleRotation()),
    tip: vec3(n.tipM()),
    depth: n.depthM(),
    phase: n.phase() as number,
    layer: n.layer(),
    force: vec3(n.forceN()),
    command: vec3(n.commandN()),
    causes: {
      stiffness: vec3(n.stiffnessN()),
      cutting: vec3(n.cuttingN()),
      friction: vec3(n.frictionN()),
      clamping: vec3(n.clampingN()),
      obstacle: vec3(n.obstacleN()),
    },
    fault: text(n.fault()),
    faultNumber: n.faultNumber(),
    guard: text(n.guard()),
    flags: n.flags(),
  };
}

function row(r: wire.Row): Row {
  return {
    tick: Number(r.tick()),
    depth: r.depthM(),
    travel: r.travelM(),
    force: r.forceN(),
    lateral: r.lateralN(),
    stiffness: r.stiffnessN(),
    cutting: r.cuttingN(),
    friction: r.frictionN(),
    clamping: r.clampingN(),
    obstacle: r.obstacleN(),
    tickUs: r.tickUs(),
    lateUs: r.lateUs(),
    needle: r.needle(),
  };
}

const happened = (e: wire.Happened): Happened => ({
  tick: Number(e.tick()),
  eventKind: e.kind(),
  needle: e.needle(),
  layer: e.layer(),
  depth: e.depthM(),
  force: e.forceN(),
});

function timing(t: wire.Timing|null): Timing|null {
  if (t === null) return null;
  return {
    ticks: Number(t.ticks()),
    missed: Number(t.missed()),
    lostRecords: Number(t.lostRecords()),
    lostFrames: Number(t.lostFrames()),
    connections: t.connections(),
    tickUs: t.tickUsArray() ?? new Float32Array(),
    lateUs: t.lateUsArray() ?? new Float32Array(),
    tickBins: t.tickBinsArray() ?? new Uint32Array(),
    lateBins: t.lateBinsArray() ?? new Uint32Array(),
    binUs: t.binUs(),
  };
}

function frame(f: wire.Frame): Frame {
  return {
    kind: 'frame',
    tick: Number(f.tick()),
    activity: f.activity() as number,
    key: f.key(),
    movedIndex: f.movedIndexArray() ?? new Uint32Array(),
    movedTo: f.movedToArray() ?? new Int16Array(),
    needles: list(f.needlesLength(), (i) => f.needles(i), needleFrame),
    particles: list(
        f.particlesLength(), (i) => f.particles(i), (p) => ({
                                                      position: vec3(p.positionM(new wire.Vec3())),
                                                      goal: vec3(p.goalM(new wire.Vec3())),
                                                      force: vec3(p.forceN(new wire.Vec3())),
                                                      needle: p.needle(),
                                                    })),
    touches:
        list(f.touchesLength(), (i) => f.touches(i), (t) => ({
                                                       position: vec3(t.positionM(new wire.Vec3())),
                                                       force: vec3(t.forceN(new wire.Vec3())),
                                                       needle: t.needle(),
                                                     })),
    events: list(f.eventsLength(), (i) => f.events(i), happened),
    rows: list(f.rowsLength(), (i) => f.rows(i), row),
    timing: timing(f.timing()),
    attempt: f.attempt(),
    timeNs: f.timeNs(),
  };
}

function score(s: wire.Score): Score {
  return {
    kind: 'score',
    attempt: s.attempt(),
    scene: text(s.scene()),
    trainee: text(s.trainee()),
    began: text(s.began()),
    duration: s.durationS(),
    path: s.pathM(),
    depthPath: s.depthPathM(),
    punctures: list(s.puncturesLength(), (i) => s.punctures(i), (p) => ({
                                                                  tick: Number(p.tick()),
                                                                  layer: text(p.layer()),
                                                                  force: p.forceN(),
                                                                })),
    withdrawals: s.withdrawals(),
    targets: list(s.targetsLength(), (i) => s.targets(i), (t) => ({
                                                            name: text(t.name()),
                                                            forbidden: t.forbidden(),
                                                            closest: t.closestM(),
                                                            reached: t.reached(),
                                                          })),
    peakForce: s.peakForceN(),
    peakLateral: s.peakLateralN(),
    meanForce: s.meanForceN(),
    faults: s.faults(),
    recording: text(s.recording()),
    rows: list(s.rowsLength(), (i) => s.rows(i), row),
  };
}

const rowsAnswer = (r: wire.Rows): RowsAnswer => ({
  kind: 'rows',
  first: Number(r.first()),
  stride: r.stride(),
  rows: list(r.rowsLength(), (i) => r.rows(i), row),
  events: list(r.eventsLength(), (i) => r.events(i), happened),
});

// null: not a message of this protocol.
export function decode(bytes: ArrayBuffer): FromServer|null {
  try {
    const buffer = new flatbuffers.ByteBuffer(new Uint8Array(bytes));
    allowance = bytes.byteLength / 4;
    if (bytes.byteLength < 12 || !buffer.__has_identifier(kIdentifier)) return null;
    const message = wire.Message.getRootAsMessage(buffer);
    const body = <T>(empty: T): T => message.body(empty) as T;
    switch (message.bodyType()) {
      case wire.Body.Hello:
        return hello(body(new wire.Hello()));
      case wire.Body.Frame:
        return frame(body(new wire.Frame()));
      case wire.Body.Rows:
        return rowsAnswer(body(new wire.Rows()));
      case wire.Body.Score:
        return score(body(new wire.Score()));
      case wire.Body.Marked: {
        const m = body(new wire.Marked());
        return {kind: 'marked', tick: Number(m.tick()), text: text(m.text()), attempt: m.attempt()};
      }
      case wire.Body.Refused:
        return {kind: 'refused', what: text(body(new wire.Refused()).what())};
      default:
        return null;
    }
  } catch {
    return null;  // a length or offset in it points outside
  }
}

function message(type: wire.Body, fill: (b: flatbuffers.Builder) => number): Uint8Array {
  const builder = new flatbuffers.Builder(128);
  const body = fill(builder);
  const root = wire.Message.createMessage(builder, type, body);
  builder.finish(root, kIdentifier);
  return builder.asUint8Array();
}

export const ask = {
  start: (trainee: string) =>
      message(wire.Body.Start, (b) => wire.Start.createStart(b, b.createString(trainee))),
  pause: () => message(wire.Body.Pause, (b) => wire.Pause.createPause(b)),
  resume: () => message(wire.Body.Resume, (b) => wire.Resume.createResume(b)),
  reset: () => message(wire.Body.Reset, (b) => wire.Reset.createReset(b)),
  end: () => message(wire.Body.End, (b) => wire.End.createEnd(b)),
  choose: (scene: string) =>
      message(wire.Body.Choose, (b) => wire.Choose.createChoose(b, b.createString(scene))),
  seek: (tick: number) => message(
      wire.Body.Seek, (b) => wire.Seek.createSeek(b, BigInt(Math.max(0, Math.round(tick))))),
  play: (speed: number) => message(wire.Body.Play, (b) => wire.Play.createPlay(b, speed)),
  rows: (first: number, last: number, points: number) => message(
      wire.Body.AskRows,
      (b) => wire.AskRows.createAskRows(b, BigInt(first), BigInt(last), points),
      ),
  mark: (words: string) =>
      message(wire.Body.Mark, (b) => wire.Mark.createMark(b, b.createString(words))),
  pointer: (needle: number, p: Vec3, q: Quaternion, buttons: number) => message(
      wire.Body.Pointer,
      (b) => {
        wire.Pointer.startPointer(b);
        wire.Pointer.addNeedle(b, needle);
        wire.Pointer.addPositionM(b, wire.Vec3.createVec3(b, p.x, p.y, p.z));
        wire.Pointer.addRotation(b, wire.Quaternion.createQuaternion(b, q.w, q.x, q.y, q.z));
        wire.Pointer.addButtons(b, buttons);
        return wire.Pointer.endPointer(b);
      }),
  acknowledge: (frame: Frame, needle: number) => message(
      wire.Body.Acknowledge,
      (b) => {
        const {fault, faultNumber} = frame.needles[needle];
        return wire.Acknowledge.createAcknowledge(
            b, needle, b.createString(fault), faultNumber, frame.timeNs);
      }),
};
