// SPDX-License-Identifier: Apache-2.0
// The simulation, in a worker of its own: ticks as time passes, the hand's way to its aim in
// between, and a frame for each that the page asks for: it asks when it can draw one.
//
// A tick is a millisecond where the machine has room for that beside what it draws, else 1.5 or 2.
// Up to there tissue keeps its mass but for a thin skin's (of the liver: 1, 1.00 and 1.05 times its
// own, of its capsule 1, 1.08 and 1.65), and forces do not change; with longer ticks it would not.
//
// The hand is a spring and a damper between the aim (the pointer's) and the needle: as tissue
// pushes back, the needle stays behind the aim, and that is what an eye takes for force. Only the
// frames depend on time; what the kernel computes depends on the poses alone.
// Units: SI; frame: world.
import {
  load,
  type ConstraintParticle,
  type Event,
  type Needle,
  type Organ,
  type Output,
  type Pose,
  type Quat,
  type Simulation,
  type Stylet,
  type Vec3
} from 'stylet-wasm';

export interface Aim {
  tip: Vec3;        // of a needle that nothing holds back
  direction: Vec3;  // of insertion, unit
  rollRad: number;  // about it
}
export type ToEngine =|{
  kind: 'open';
  organ: ArrayBuffer;
  needle: Partial<Needle>;
  aim: Aim;
  byGpu: boolean;
  threads: number  // that may share a tick
}
|{
  kind: 'aim';
  aim: Aim
}
|{kind: 'show'}|{
  kind: 'prove';
  organ: ArrayBuffer
};
export interface Opened {
  kind: 'opened';
  version: string;
  build: string;
  edge: number;
  period: number;
  threads: number;     // that share a tick
  rest: Float32Array;  // of particles
  corners: Uint32Array;
  needle: Needle;
}
export interface Tick {
  tick: number;
  out: Output;
  handle: Pose;
  travel: number;
  us: number;  // of a tick
}
export interface Snapshot extends Tick {
  kind: 'frame';
  rows: Tick[];
  moved: Float32Array;
  nodes: Float32Array;
  particles: ConstraintParticle[];
  events: Event[];
  speed: number;  // simulated time over time that passed
}
export type FromEngine =|Opened|Snapshot|{
  kind: 'proved';
  hash: string
}
|{
  kind: 'failed';
  why: string
};

const kPeriodsS = [1e-3, 1.5e-3, 2e-3];
const kRoom = 0.85;        // share of a processor that ticks may take, where a card draws,
const kRoomBeside = 0.75;  // and where a processor does
const kInside = 1.15;      // times as long as with its needle away takes a tick
const kTriedTicks = 10, kTries = 12;
const kSpringNPerM = 350;   // of the hand: 3 N hold the needle 9 mm behind the aim
const kFollowS = 0.03;      // the needle comes after the aim in about this time
const kFastestMPerS = 0.3;  // of the needle
const kMostDueS = 0.1;      // what passed while the page was asleep is left out
const kRowEvery = 4;        // ticks
const kHeardMs = 8;         // the page is heard at least so often
const kAsleepMs = 1000;
const kLookMs = 100;    // whether it is awake again
const kSpeedOverS = 1;  // told of the time before

let stylet: Stylet|null = null;
let session: Session|null = null;

// Calls back as soon as the messages that wait were heard.
const channel = new MessageChannel();
const kNothing = () => undefined;
let waiting: () => void = kNothing;
channel.port1.onmessage = () => {
  const work = waiting;
  waiting = kNothing;  // once: the message of a session that has ended must not wake the next twice
  work();
};
function wake(work: () => void): void {
  waiting = work;
  channel.port2.postMessage(null);
}

const add = (a: Vec3, b: Vec3, factor = 1):
    Vec3 => [a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]];
const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

function times(a: Quat, b: Quat): Quat {
  return {
    w: a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
    x: a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
    y: a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
    z: a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
  };
}

class Session {
  private readonly organ: Organ;
  private readonly period: number;
  private simulation: Simulation;
  private readonly needle: Needle;
  private readonly from: Vec3;
  private aim: Aim;
  private tip: Vec3;
  private out: Output|null = null;
  private pose: Pose;
  private rotation: Quat;
  private rows: Tick[] = [];
  private due = 0;  // s of simulated time
  private last = performance.now();
  private us = 0;
  private wanted = false;  // a frame
  private pictureAt = 0;
  private heardAt = performance.now();
  private speed = 1;
  private simulated = 0;  // s since the last picture
  private events = 0;
  private ended = false;

  constructor(
      private readonly library: Stylet, organ: ArrayBuffer, needle: Partial<Needle>, aim: Aim,
      byGpu: boolean) {
    this.organ = library.organ(organ);
    this.needle = library.needle(needle);
    this.simulation = this.simulationOf(kPeriodsS[0]);
    this.aim = aim;
    this.tip = this.from = aim.tip;
    this.rotation = this.rotationOf(aim);
    this.pose = this.poseAt();
    this.period = this.choosePeriod(byGpu ? kRoom : kRoomBeside);
    post(this.opened());
    this.last = this.heardAt = performance.now();
    this.run();
  }

  private simulationOf(period_s: number): Simulation {
    return this.library.simulation(this.organ, {config: {period_s}, needles: [this.needle]});
  }

  // The shortest for which this machine has room, by ticks with the needle away.
  private choosePeriod(room: number): number {
    const each: number[] = [];
    for (let i = 0; i < kTries; ++i) {
      const began = performance.now();
      for (let tick = 0; tick < kTriedTicks; ++tick) this.simulation.tick([this.pose]);
      each.push(1e-3 * (performance.now() - began) / kTriedTicks);
    }
    const half = each.slice(kTries / 2).sort((a, b) => a - b);  // without those while it compiles
    const tick = half[half.length >> 1];
    const last = kPeriodsS[kPeriodsS.length - 1];
    const period = kPeriodsS.find((p) => kInside * tick < room * p) ?? last;
    this.simulation.free();
    this.simulation = this.simulationOf(period);
    return period;
  }

  set target(aim: Aim) {
    this.aim = aim;
    this.rotation = this.rotationOf(aim);
  }

  want(): void {
    this.wanted = true;
    const now = performance.now();
    if (this.asleep(now)) {
      this.last = now;
      this.pictureAt = 0;
    }
    this.heardAt = now;
  }

  // A page that is hidden asks for no frames; nothing happens there that nobody sees.
  private asleep(now: number): boolean { return now - this.heardAt > kAsleepMs; }

  end(): void {
    this.ended = true;
    this.simulation.free();
    this.organ.free();
  }

  private opened(): Opened {
    const {info, voxels} = this.organ;
    const corners = this.simulation.voxel_corners();
    const rest = new Float32Array(this.simulation.particles().length);
    voxels.forEach(({x, y, z}, v) => {
      for (let corner = 0; corner < 8; ++corner) {
        const place = [x + (corner & 1), y + ((corner >> 1) & 1), z + (corner >> 2)];
        for (let k = 0; k < 3; ++k) {
          rest[3 * corners[8 * v + corner] + k] = info.origin_m[k] + place[k] * info.voxel_edge_m;
        }
      }
    });
    return {
      kind: 'opened',
      version: this.library.version,
      build: this.library.build,
      edge: info.voxel_edge_m,
      period: this.period,
      threads: this.library.threads,
      rest,
      corners,
      needle: this.needle,
    };
  }

  private rotationOf({direction, rollRad}: Aim): Quat {
    const {rotation} = this.library.pose_of_tip([0, 0, 0], direction, this.needle.length_m);
    const half = rollRad / 2;
    return times(rotation, {w: Math.cos(half), x: 0, y: 0, z: -Math.sin(half)});
  }

  private poseAt(): Pose {
    const handle = add(this.tip, this.aim.direction, -this.needle.length_m);
    return {position_m: handle, rotation: this.rotation};
  }

  // A step of the hand: it pulls the needle to the aim, tissue pushes back.
  private moveHand(seconds: number): void {
    const damper = kSpringNPerM * kFollowS;
    const force = this.out?.force_n ?? [0, 0, 0];
    const pull = add(this.aim.tip, this.tip, -1).map((d, k) => kSpringNPerM * d + force[k]);
    const velocity = pull.map((f) => f / damper) as Vec3;
    const size = Math.sqrt(dot(velocity, velocity));
    const share = Math.min(1, kFastestMPerS / Math.max(size, 1e-9));
    this.tip = add(this.tip, velocity, share * seconds);
  }

  private ticks(count: number, period: number): void {
    const began = performance.now();
    for (let i = 0; i < count; ++i) {
      this.moveHand(period);
      this.pose = this.poseAt();
      [this.out] = this.simulation.tick([this.pose]);
      if (this.out.tick % kRowEvery === 0) this.rows.push(this.now());
    }
    if (count === 0) return;
    this.us += 0.2 * (1e3 * (performance.now() - began) / count - this.us);
  }

  private now(): Tick {
    const travel = dot(add(this.out!.tip_m, this.from, -1), this.aim.direction);
    return {tick: this.out!.tick, out: this.out!, handle: this.pose, travel, us: this.us};
  }

  private run(): void {
    if (this.ended) return;
    try {
      this.step();
    } catch (why) {
      return post({kind: 'failed', why: String(why)});
    }
    // A timer waits 4 ms at least, which a machine that is behind has not.
    if (this.due >= this.period)
      wake(() => this.run());
    else
      setTimeout(() => this.run(), this.asleep(this.last) ? kLookMs : 1);
  }

  private step(): void {
    const {period} = this;
    const now = performance.now();
    if (this.asleep(now)) {
      this.last = now;
      this.due = 0;
      return;
    }
    this.due = Math.min(kMostDueS, this.due + (now - this.last) / 1e3);
    this.last = now;
    // Where this machine is slower than time, the simulation is, too, and says so.
    const most = this.us > 0 ? Math.max(1, Math.floor(1e3 * kHeardMs / this.us)) : 1;
    const count = Math.min(most, Math.floor(this.due / period));
    this.ticks(count, period);
    this.due -= count * period;
    this.simulated += count * period;
    if (this.wanted && this.out !== null) this.show(now);
  }

  private show(now: number): void {
    const passed = (now - this.pictureAt) / 1e3;
    const speed = this.pictureAt > 0 ? Math.min(1, this.simulated / passed) : 1;
    this.speed += Math.min(1, passed / kSpeedOverS) * (speed - this.speed);
    const all = this.simulation.events();
    const fresh = this.out!.events - this.events;
    this.events = this.out!.events;
    const moved = this.simulation.particles();
    const frame: Snapshot = {
      kind: 'frame',
      ...this.now(),
      rows: this.rows,
      moved,
      nodes: this.simulation.needle_shape(),
      particles: this.simulation.constraint_particles(),
      events: fresh > 0 ? all.slice(-fresh) : [],
      speed: this.speed,
    };
    post(frame, [moved.buffer]);
    this.rows = [];
    this.simulated = 0;
    this.pictureAt = now;
    this.wanted = false;
  }
}

// The insertion of the example in C (hal/hosts/c/examples/insert.c), tick by tick as there: the
// hash of the state in the end. Math.fround: as C counts in float.
function prove(library: Stylet, bytes: ArrayBuffer): string {
  const organ = library.organ(bytes);
  const {low_m: low, high_m: high} = organ.info;
  const simulation = library.simulation(organ, {needles: [{bending_nm2: 0.02}]});
  const {length_m: length} = library.needle();
  const f = Math.fround;
  const [x, y] = [0, 1].map((k) => f(f(low[k] + high[k]) / 2));
  const above = f(high[2] + f(0.01));
  const skin = organ.raycast([x, y, above], [0, 0, -1]) ?? 0;
  const begin = f(above - f(skin - f(1e-3)));
  const perTick = f(f(10e-3) * f(1e-3));
  for (let tick = 0; tick <= 2100; ++tick) {
    const tip = f(begin - f(perTick * tick));
    simulation.tick([library.pose_of_tip([x, y, tip], [0, 0, -1], length)]);
  }
  return simulation.hash();
}

function post(message: FromEngine, transfer: Transferable[] = []): void {
  (self as unknown as Worker).postMessage(message, transfer);
}

// `shared`: address of the library for threads.
export function serve(wasm: Promise<ArrayBuffer>, shared: string): void {
  self.addEventListener('message', (event: MessageEvent<ToEngine>) => {
    const message = event.data;
    if (message.kind === 'aim') {
      if (session) session.target = message.aim;
      return;
    }
    if (message.kind === 'show') {
      session?.want();
      return;
    }
    void (async () => {
      try {
        const threads = message.kind === 'open' ? message.threads : 1;
        stylet ??= await load(wasm, {threads, shared});
        session?.end();
        session = null;
        if (message.kind === 'prove')
          post({kind: 'proved', hash: prove(stylet, message.organ)});
        else
          session = new Session(stylet, message.organ, message.needle, message.aim, message.byGpu);
      } catch (why) {
        post({kind: 'failed', why: String(why)});
      }
    })();
  });
}
