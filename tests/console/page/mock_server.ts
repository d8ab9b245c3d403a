// SPDX-License-Identifier: Apache-2.0
// A stand-in for the program: serves the page and speaks the protocol, with a made-up insertion.
//
// It answers what a page asks as console.fbs says, keeps what it was asked (`heard`), and can do
// what the program must not: close at once, speak another protocol, send garbage. A recording is
// the same insertion with its ticks known. Units: SI.
import * as flatbuffers from 'flatbuffers';
import {readFileSync} from 'node:fs';
import {createServer, type Server} from 'node:http';
import {join} from 'node:path';
import {WebSocketServer, type WebSocket} from 'ws';
import * as wire from '../../../hal/console/page/generated/console_generated';
import type {MadeUpOrgan} from './made_up_organ';

const kUnit = 4e-6;
const kLength = 0.15;
const kTypes: Record<string, string> = {
  html: 'text/html',
  js: 'text/javascript',
  css: 'text/css'
};
const kEntryX = -0.095;
const kOuter = 0.635e-3;

export interface MockOptions {
  dist: string;
  organ: MadeUpOrgan;
  recordingTicks?: number;
  device?: string;
  protocol?: number;
  framesPerSecond?: number;
  token?: string;
}

// The made-up truth at a tick, as float32: what a test compares with.
export interface Truth {
  travel: number;
  depth: number;
  axial: number;
  force: [number, number, number];
  phase: number;
}

const f32 = Math.fround;

export function truthAt(tick: number): Truth {
  const t = (tick % 16000) / 1000;
  const travel = t < 8 ? -0.01 + 0.01 * t : t < 10 ? 0.07 : 0.07 - 0.015 * (t - 10);
  const inside = travel > 0.006 || (t > 8 && travel > 0);
  const back = t > 10;
  const depth = inside ? travel : 0;
  const wobble = 0.05 * Math.sin(tick / 37) + 0.02 * Math.sin(tick / 11);
  let axial = 0;
  if (!inside && travel > 0 && !back)
    axial = 160 * travel;
  else if (inside)
    axial = (back ? -22 * depth : t > 8 ? 14 * depth : 0.35 + 22 * depth) + wobble;
  const force: Truth['force'] =
      [f32(-axial), f32(0.1 * wobble + 0.3 * depth), f32(1.5 * depth * wobble)];
  return {
    travel,
    depth,
    axial: f32(axial),
    force,
    phase: back    ? 3 :
        inside     ? 2 :
        travel > 0 ? 1 :
                     0
  };
}

// Displacements in kUnit of every particle: a dent at the tip, drawn along the shaft.
export function movedAt(organ: MadeUpOrgan, tick: number): Int16Array {
  const {travel, axial, depth} = truthAt(tick);
  const tip = kEntryX + travel;
  const out = new Int16Array(organ.rest.length);
  const size = 0.004 * axial;
  for (let i = 0; i < out.length; i += 3) {
    const [x, y, z] = organ.rest.subarray(i, i + 3);
    const along = x > tip ? x - tip : x > kEntryX ? 0 : kEntryX - x;
    const near = Math.exp(-(along * along + y * y + z * z) / (2 * 0.02 * 0.02));
    out[i] = Math.round((size * near) / kUnit);
    out[i + 1] = Math.round((0.1 * depth * near * Math.sign(y) * Math.abs(y) * 10) / kUnit);
    out[i + 2] = Math.round((0.05 * depth * near) / kUnit);
  }
  return out;
}

function message(type: wire.Body, fill: (b: flatbuffers.Builder) => number): Uint8Array {
  const b = new flatbuffers.Builder(1 << 16);
  b.finish(wire.Message.createMessage(b, type, fill(b)), 'STLC');
  return b.asUint8Array().slice();
}

function structs<T>(
    b: flatbuffers.Builder, list: T[], bytes: number, align: number,
    add: (item: T) => void): number {
  b.startVector(bytes, list.length, align);
  for (let i = list.length - 1; i >= 0; --i) add(list[i]);
  return b.endVector();
}

interface EventOf {
  tick: number;
  kind: number;
  force: number;
}
function eventsUpTo(from: number, to: number): EventOf[] {
  const all: [number, number][] = [[1000, 0], [1600, 2], [5200, 5], [14667, 4]];
  return all.filter(([tick]) => tick > from && tick <= to)
      .map(([tick, kind]) => ({tick, kind, force: truthAt(tick).axial}));
}

export class MockServer {
  readonly heard: string[] = [];
  readonly pointers: {z: number; buttons: number; roll: number}[] = [];
  readonly organAsked: string[] = [];
  activity = 0;
  tick = 0;
  speed = 0;
  url = '';
  private readonly http: Server;
  private readonly sockets = new WebSocketServer({noServer: true});
  private timer: NodeJS.Timeout|null = null;
  private last = -1;
  private eventLast = 0;
  private attempt = 0;
  private began = 0;
  private keys = new WeakSet<WebSocket>();

  constructor(private readonly options: MockOptions) {
    if (options.recordingTicks) this.activity = 4;
    this.http = createServer((request, response) => {
      const path = new URL(request.url ?? '/', 'http://x').pathname;
      if (path === '/organ') {
        this.organAsked.push(request.url ?? '');
        response.end(options.organ.bytes);
        return;
      }
      const name = path === '/' ? 'index.html' : path.slice(1);
      if (!['index.html', 'app.js', 'app.css'].includes(name)) {
        response.writeHead(404).end();
        return;
      }
      response.writeHead(200, {
        'Content-Type': kTypes[name.split('.')[1]],
        'Content-Security-Policy':
            `default-src 'self'; img-src 'self' data: blob:; style-src 'self'; frame-ancestors ` +
            '\'none\'; form-action \'none\'; base-uri \'none\'',
      });
      response.end(readFileSync(join(options.dist, name)));
    });
    this.http.on('upgrade', (request, socket, head) => {
      this.sockets.handleUpgrade(request, socket, head, (ws) => this.join(ws));
    });
  }

  async begin(port = 0): Promise<string> {
    await new Promise<void>((done) => this.http.listen(port, '127.0.0.1', () => done()));
    const at = this.http.address();
    this.url = `http://127.0.0.1:${typeof at === 'object' && at ? at.port : 0}/`;
    this.timer = setInterval(() => this.step(), 1000 / (this.options.framesPerSecond ?? 60));
    return this.url;
  }

  get port(): number { return Number(new URL(this.url).port); }

  async end(): Promise<void> {
    if (this.timer) clearInterval(this.timer);
    for (const ws of this.sockets.clients) ws.terminate();
    this.http.closeAllConnections?.();
    await new Promise((done) => this.http.close(done));
  }

  say(bytes: Uint8Array): void {
    for (const ws of this.sockets.clients)
      if (ws.readyState === ws.OPEN) ws.send(bytes);
  }

  refuse(what: string): void {
    this.say(
        message(wire.Body.Refused, (b) => wire.Refused.createRefused(b, b.createString(what))));
  }

  // The frame of the present tick, with all particles.
  frameBytes(): Uint8Array { return this.frame(-1, true); }

  private join(ws: WebSocket): void {
    ws.on('message', (data: Buffer) => this.hear(ws, data));
    ws.on('error', () => undefined);
    ws.send(this.helloBytes());
    this.sendFrame(ws, -1);
  }

  private step(): void {
    const {recordingTicks, framesPerSecond} = this.options;
    const ticks = 1000 / (framesPerSecond ?? 60);
    if (recordingTicks) {
      this.tick = Math.round(Math.min(recordingTicks, Math.max(0, this.tick + this.speed * ticks)));
      if (this.tick === this.last) return;
    } else if (this.activity === 1) {
      this.tick = Math.round((performance.now() - this.began));
    }
    const from = this.last;
    this.last = this.tick;
    for (const ws of this.sockets.clients) this.sendFrame(ws, from);
    if (!recordingTicks && this.activity === 1 && this.tick > 16000) this.finish();
  }

  private finish(): void {
    this.activity = 3;
    this.say(this.score());
  }

  private hear(ws: WebSocket, data: Buffer): void {
    const m = wire.Message.getRootAsMessage(new flatbuffers.ByteBuffer(new Uint8Array(data)));
    const kind = wire.Body[m.bodyType()];
    this.heard.push(kind);
    const body = <T>(empty: T): T => m.body(empty) as T;
    switch (m.bodyType()) {
      case wire.Body.Start:
        this.activity = 1;
        this.began = performance.now() - (this.activity === 1 ? 0 : this.tick);
        this.tick = 0;
        this.last = -1;
        this.eventLast = 0;
        ++this.attempt;
        break;
      case wire.Body.Pause:
        this.activity = 2;
        break;
      case wire.Body.Resume:
        this.activity = 1;
        this.began = performance.now() - this.tick;
        break;
      case wire.Body.End:
        this.finish();
        break;
      case wire.Body.Reset:
        if (this.activity === 1 || this.activity === 2) this.finish();
        this.activity = 0;
        this.tick = 0;
        this.last = -1;
        break;
      case wire.Body.Seek:
        this.tick = Number(body(new wire.Seek()).tick());
        this.speed = 0;
        break;
      case wire.Body.Play:
        this.speed = body(new wire.Play()).speed();
        break;
      case wire.Body.AskRows: {
        const a = body(new wire.AskRows());
        ws.send(this.rows(Number(a.first()), Number(a.last()), a.points()));
        break;
      }
      case wire.Body.Mark: {
        const words = body(new wire.Mark()).text() ?? '';
        const tick = BigInt(this.tick);
        this.say(message(
            wire.Body.Marked,
            (b) => wire.Marked.createMarked(b, tick, b.createString(words), this.attempt)));
        break;
      }
      case wire.Body.Pointer: {
        const p = body(new wire.Pointer());
        const q = p.rotation();
        this.pointers.push({
          z: p.positionM()?.z() ?? 0,
          buttons: p.buttons(),
          roll: (2 * Math.atan2(q?.z() ?? 0, q?.w() ?? 1) * 180) / Math.PI,
        });
        break;
      }
    }
  }

  helloBytes(): Uint8Array {
    const {organ, recordingTicks, device, protocol} = this.options;
    return message(wire.Body.Hello, (b) => {
      const rest =
          structs(b, Array.from({length: organ.rest.length / 3}, (_, i) => i), 12, 4, (i) => {
            const [x, y, z] = organ.rest.subarray(3 * i, 3 * i + 3);
            wire.Vec3.createVec3(b, x, y, z);
          });
      const corners = wire.Hello.createCornersVector(b, organ.corners);
      const needles = wire.Hello.createNeedlesVector(b, [this.needle(b, device ?? 'simulated')]);
      const obstacles = wire.Hello.createObstaclesVector(b, [this.obstacle(b)]);
      const targets = wire.Hello.createTargetsVector(b, [
        this.target(b, 'tumour', [-0.02, 0.004, 0], 0.009, false),
        this.target(b, 'vessel', [0.0, 0.026, 0.012], 0.008, true),
      ]);
      const names = ['liver-biopsy', 'lumbar-puncture', 'fig09-force-curve'];
      const scenes = wire.Hello.createScenesVector(
          b, recordingTicks ? [] : names.map((n) => b.createString(n)));
      const [version, scene] = [b.createString('0.1.0'), b.createString('liver-biopsy')];
      wire.Hello.startHello(b);
      wire.Hello.addProtocol(b, protocol ?? 2);
      wire.Hello.addStyletVersion(b, version);
      wire.Hello.addScene(b, scene);
      wire.Hello.addScenes(b, scenes);
      wire.Hello.addPeriodS(b, 0.001);
      wire.Hello.addRecordingTicks(b, BigInt(recordingTicks ?? 0));
      wire.Hello.addVoxelEdgeM(b, organ.edge);
      wire.Hello.addParticles(b, organ.rest.length / 3);
      wire.Hello.addRestM(b, rest);
      wire.Hello.addCorners(b, corners);
      wire.Hello.addPositionUnitM(b, kUnit);
      wire.Hello.addNeedles(b, needles);
      wire.Hello.addObstacles(b, obstacles);
      wire.Hello.addTargets(b, targets);
      wire.Hello.addMayControl(b, true);
      return wire.Hello.endHello(b);
    });
  }

  private needle(b: flatbuffers.Builder, device: string): number {
    const name = b.createString(device);
    wire.NeedleInfo.startNeedleInfo(b);
    wire.NeedleInfo.addDevice(b, name);
    wire.NeedleInfo.addLengthM(b, kLength);
    wire.NeedleInfo.addOuterRadiusM(b, kOuter);
    wire.NeedleInfo.addEntryM(b, wire.Vec3.createVec3(b, kEntryX, 0, 0));
    wire.NeedleInfo.addDirection(b, wire.Vec3.createVec3(b, 1, 0, 0));
    wire.NeedleInfo.addMaxForceN(b, 8);
    return wire.NeedleInfo.endNeedleInfo(b);
  }

  private obstacle(b: flatbuffers.Builder): number {
    const ends = Array.from(
        {length: 8}, (_, i) => [i & 1, (i >> 1) & 1, i >> 2].map((v) => 0.012 * (v - 0.5)));
    const vertices = structs(b, ends, 12, 4, ([x, y, z]) => wire.Vec3.createVec3(b, x, y, z));
    wire.Obstacle.startObstacle(b);
    wire.Obstacle.addPositionM(b, wire.Vec3.createVec3(b, 0.03, -0.03, 0));
    wire.Obstacle.addRotation(b, wire.Quaternion.createQuaternion(b, 0.96, 0.1, 0.2, 0.1));
    wire.Obstacle.addVerticesM(b, vertices);
    wire.Obstacle.addRoundingM(b, 0.001);
    return wire.Obstacle.endObstacle(b);
  }

  private target(
      b: flatbuffers.Builder, name: string, p: number[], radius: number,
      forbidden: boolean): number {
    const at = b.createString(name);
    wire.Target.startTarget(b);
    wire.Target.addName(b, at);
    wire.Target.addPositionM(b, wire.Vec3.createVec3(b, p[0], p[1], p[2]));
    wire.Target.addRadiusM(b, radius);
    wire.Target.addForbidden(b, forbidden);
    return wire.Target.endTarget(b);
  }

  private rowAt(b: flatbuffers.Builder, tick: number): void {
    const {travel, depth, axial, force, phase} = truthAt(tick);
    const lateral = Math.hypot(force[1], force[2]);
    const friction = phase >= 2 ? 0.8 * axial : 0;
    const cutting = phase === 2 ? 0.2 * axial : 0;
    wire.Row.createRow(
        b,
        BigInt(tick),
        depth,
        travel,
        axial,
        lateral,
        phase === 1 ? axial : 0,
        cutting,
        friction,
        phase === 3 ? 0.2 * axial : 0,
        0,
        120 + 30 * Math.sin(tick),
        4 + 3 * Math.cos(tick),
        0,
    );
  }

  private eventsAt(b: flatbuffers.Builder, events: EventOf[]): number {
    return structs(
        b,
        events,
        32,
        8,
        (e) => wire.Happened.createHappened(
            b, BigInt(e.tick), e.kind, 0, e.kind === 5 ? 1 : 0, truthAt(e.tick).depth, e.force),
    );
  }

  private ticksOf(first: number, last: number, points: number): number[] {
    const stride = Math.max(1, Math.ceil((last - first + 1) / points));
    const ticks: number[] = [];
    for (let t = first; t <= last; t += stride) ticks.push(t);
    return ticks;
  }

  private rows(first: number, last: number, points: number): Uint8Array {
    const ticks = this.ticksOf(first, last, points);
    return message(wire.Body.Rows, (b) => {
      const rows = structs(b, ticks, 56, 8, (t) => this.rowAt(b, t));
      const events = this.eventsAt(b, eventsUpTo(first, last));
      wire.Rows.startRows(b);
      wire.Rows.addFirst(b, BigInt(first));
      wire.Rows.addStride(b, ticks.length > 1 ? ticks[1] - ticks[0] : 1);
      wire.Rows.addRows(b, rows);
      wire.Rows.addEvents(b, events);
      return wire.Rows.endRows(b);
    });
  }

  private score(): Uint8Array {
    return message(wire.Body.Score, (b) => {
      const end = this.tick;
      const rows = structs(b, this.ticksOf(0, end, 800), 56, 8, (t) => this.rowAt(b, t));
      const layer = b.createString('liver');
      const punctures = wire.Score.createPuncturesVector(
          b, [wire.PunctureScore.createPunctureScore(b, 1600n, layer, truthAt(1600).axial)]);
      const targets = wire.Score.createTargetsVector(b, [
        wire.TargetScore.createTargetScore(b, b.createString('tumour'), false, 0.0021, true),
        wire.TargetScore.createTargetScore(b, b.createString('vessel'), true, 0.0172, false),
      ]);
      const words = [
        'liver-biopsy', 'A. Novice', '2026-01-15T10:30:00', `attempt-${this.attempt}.h5`
      ].map((w) => b.createString(w));
      wire.Score.startScore(b);
      wire.Score.addAttempt(b, this.attempt);
      wire.Score.addScene(b, words[0]);
      wire.Score.addTrainee(b, words[1]);
      wire.Score.addBegan(b, words[2]);
      wire.Score.addDurationS(b, end / 1000);
      wire.Score.addPathM(b, 0.08 + 0.02 * this.attempt);
      wire.Score.addDepthPathM(b, 0.064);
      wire.Score.addPunctures(b, punctures);
      wire.Score.addWithdrawals(b, this.attempt);
      wire.Score.addTargets(b, targets);
      wire.Score.addPeakForceN(b, 1.91 + 0.2 * this.attempt);
      wire.Score.addPeakLateralN(b, 0.21);
      wire.Score.addMeanForceN(b, 0.93);
      wire.Score.addFaults(b, 0);
      wire.Score.addRecording(b, words[3]);
      wire.Score.addRows(b, rows);
      return wire.Score.endScore(b);
    });
  }

  private sendFrame(ws: WebSocket, from: number): void {
    if (ws.readyState !== ws.OPEN || ws.bufferedAmount > 4e6) return;
    const first = !this.keys.has(ws);
    this.keys.add(ws);
    ws.send(this.frame(from, first || (this.options.recordingTicks ?? 0) > 0));
  }

  private frame(from: number, key: boolean): Uint8Array {
    const {organ, recordingTicks} = this.options;
    const {tick} = this;
    const truth = truthAt(tick);
    const moved = movedAt(organ, tick);
    return message(wire.Body.Frame, (b) => {
      const index: number[] = [];
      if (!key)
        for (let i = 0; 3 * i < moved.length; ++i) index.push(i);
      const movedIndex = wire.Frame.createMovedIndexVector(b, index);
      const movedTo = wire.Frame.createMovedToVector(b, moved);
      const needles = wire.Frame.createNeedlesVector(b, [this.needleFrame(b, truth)]);
      const cps: number[] = [];
      for (let d = 0; d < truth.depth; d += 0.005) cps.push(truth.travel - d);
      const particles = structs(
          b,
          cps,
          40,
          4,
          (at) => wire.Particle.createParticle(
              b,
              kEntryX + at,
              bend(at),
              0,
              kEntryX + at - 0.003,
              bend(at) - 0.001,
              0,
              -0.1,
              0,
              0,
              0,
              ),
      );
      const live = !recordingTicks;
      const wanted = live && from >= 0 && tick > from ? this.ticksOf(from + 1, tick, 200) : [];
      const rows = structs(b, wanted, 56, 8, (t) => this.rowAt(b, t));
      const events = this.eventsAt(b, live ? eventsUpTo(this.eventLast, tick) : []);
      this.eventLast = tick;
      const timing = this.timing(b);
      wire.Frame.startFrame(b);
      wire.Frame.addTick(b, BigInt(tick));
      wire.Frame.addActivity(b, this.activity);
      wire.Frame.addKey(b, key);
      wire.Frame.addMovedIndex(b, movedIndex);
      wire.Frame.addMovedTo(b, movedTo);
      wire.Frame.addNeedles(b, needles);
      wire.Frame.addParticles(b, particles);
      wire.Frame.addEvents(b, events);
      wire.Frame.addRows(b, rows);
      wire.Frame.addTiming(b, timing);
      wire.Frame.addAttempt(b, this.options.recordingTicks ? 0 : this.attempt);
      return wire.Frame.endFrame(b);
    });
  }

  private needleFrame(b: flatbuffers.Builder, truth: Truth): number {
    const tip = kEntryX + truth.travel;
    const along = Array.from({length: 33}, (_, i) => truth.travel - kLength * (1 - i / 32));
    const nodes =
        structs(b, along, 12, 4, (at) => wire.Vec3.createVec3(b, kEntryX + at, bend(at), 0));
    const guard = b.createString('live');
    const v = (x: number, y = 0, z = 0) => wire.Vec3.createVec3(b, x, y, z);
    const [x, y, z] = truth.force;
    wire.NeedleFrame.startNeedleFrame(b);
    wire.NeedleFrame.addNodesM(b, nodes);
    wire.NeedleFrame.addHandlePositionM(b, v(tip - kLength));
    wire.NeedleFrame.addHandleRotation(
        b, wire.Quaternion.createQuaternion(b, Math.SQRT1_2, 0, -Math.SQRT1_2, 0));
    wire.NeedleFrame.addTipM(b, v(tip, bend(truth.travel)));
    wire.NeedleFrame.addDepthM(b, truth.depth);
    wire.NeedleFrame.addPhase(b, truth.phase);
    wire.NeedleFrame.addLayer(b, truth.depth > 0 ? 0 : 0xffffffff);
    wire.NeedleFrame.addForceN(b, v(x, y, z));
    wire.NeedleFrame.addCommandN(b, v(x, y, z));
    wire.NeedleFrame.addFrictionN(b, v(0.8 * x));
    wire.NeedleFrame.addCuttingN(b, v(0.2 * x));
    wire.NeedleFrame.addClampingN(b, v(0, y, z));
    wire.NeedleFrame.addGuard(b, guard);
    return wire.NeedleFrame.endNeedleFrame(b);
  }

  private timing(b: flatbuffers.Builder): number {
    const bins = Array.from(
        {length: 100},
        (_, i) => Math.round(this.tick * Math.exp(-((i - 12) ** 2) / 6)) + (i === 41 ? 2 : 0));
    const late = Array.from({length: 100}, (_, i) => Math.round(this.tick * Math.exp(-1.5 * i)));
    const parts = [
      wire.Timing.createTickUsVector(b, [118, 133, 151, 190, 415]),
      wire.Timing.createLateUsVector(b, [3, 6, 11, 19, 34]),
      wire.Timing.createTickBinsVector(b, bins),
      wire.Timing.createLateBinsVector(b, late),
    ];
    wire.Timing.startTiming(b);
    wire.Timing.addTicks(b, BigInt(this.tick));
    wire.Timing.addMissed(b, 0n);
    wire.Timing.addConnections(b, this.sockets.clients.size);
    wire.Timing.addTickUs(b, parts[0]);
    wire.Timing.addLateUs(b, parts[1]);
    wire.Timing.addTickBins(b, parts[2]);
    wire.Timing.addLateBins(b, parts[3]);
    wire.Timing.addBinUs(b, 10);
    return wire.Timing.endTiming(b);
  }
}

// The needle's line: bent where it is deep.
function bend(at: number): number { return at > 0 ? 1.2 * at * at : 0; }
