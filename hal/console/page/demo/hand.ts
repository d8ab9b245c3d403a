// SPDX-License-Identifier: Apache-2.0
// The visitor's hand: mouse, pen, finger, keys or gamepad move the aim of the needle; a gamepad and
// a telephone shake as the force does.
//
// On the picture the needle goes where finger or mouse go: along it in and out, across it aside;
// seen from behind, down is in. Keys: right is in, up is up. Wheel: in and out, finely. Units: m.
import type {Vec3} from 'stylet-wasm';

import type {Aim} from './engine';

const kMetresPerWheel = 0.02e-3;  // a unit of wheel, 100 a notch
const kKeyMetresPerS = 0.03;
const kKeyRadPerS = 1.6;
const kPadMetresPerS = 0.05;
const kPadRadPerS = 2;
const kRest = 0.12;     // of a stick: what it does by itself
const kDeepest = 0.14;  // m from the start, along the needle
const kAside = 0.03;    // m, across
const kShakeMs = 60;
const kMostForce = 6;     // N: shakes as hard as it can
const kFromBehind = 0.8;  // cosine of the angle between needle and look
const kKeys: Record<string, [keyof Way, number]> = {
  ArrowRight: ['in', 1],
  ArrowLeft: ['in', -1],
  KeyD: ['in', 1],
  KeyA: ['in', -1],
  ArrowUp: ['up', 1],
  ArrowDown: ['up', -1],
  KeyW: ['up', 1],
  KeyS: ['up', -1],
  PageUp: ['across', -1],
  PageDown: ['across', 1],
  KeyQ: ['roll', -1],
  KeyE: ['roll', 1],
};

interface Way {
  in : number;
  across: number;
  up: number;
  roll: number;
}
export interface Start {
  tip: Vec3;
  direction: Vec3;
  right: Vec3;  // across, as one looks at first
  up: Vec3;
  roll: number;  // rad
}
// Ways in the world of a pixel to the right and of one down, at the needle.
export interface Pixel {
  right: Vec3;
  down: Vec3;
}

const along = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const within = (value: number, most: number): number => Math.max(-most, Math.min(most, value));

export class Hand {
  private way: Way = {in : 0, across: 0, up: 0, roll: 0};
  private start: Start|null = null;
  private readonly held = new Map < number, {
    x: number;
    y: number
  }
  > ();
  private readonly pressed = new Set<string>();
  private last = performance.now();
  private shakenAt = 0;
  moved: () => void = () => undefined;  // for the hint that goes away

  constructor(
      private readonly canvas: HTMLElement,
      private readonly pixel: (at: Vec3) => Pixel | null,
  ) {
    canvas.addEventListener('pointerdown', (event) => this.take(event));
    canvas.addEventListener('pointermove', (event) => this.drag(event));
    for (const end of ['pointerup', 'pointercancel', 'lostpointercapture'] as const) {
      canvas.addEventListener(end, (event) => this.held.delete(event.pointerId));
    }
    canvas.addEventListener('wheel', (event) => this.wheel(event), {passive: false, capture: true});
    document.addEventListener('keydown', (event) => {
      if (!(event.code in kKeys) || event.ctrlKey || event.altKey || event.metaKey) return;
      if ((event.target as HTMLElement).matches('select, input')) return;
      event.preventDefault();
      event.stopPropagation();
      this.pressed.add(event.code);
    }, {capture: true});
    document.addEventListener('keyup', (event) => this.pressed.delete(event.code));
    window.addEventListener('blur', () => this.pressed.clear());
  }

  begin(start: Start): void {
    this.start = start;
    this.way = {in : 0, across: 0, up: 0, roll: start.roll};
    this.held.clear();
    this.pressed.clear();
  }

  get aim(): Aim|null {
    if (this.start === null) return null;
    const {tip, direction, right, up} = this.start;
    const {way} = this;
    const place =
        tip.map((at, k) => at + way.in * direction[k] + way.across * right[k] + way.up * up[k]) as
        Vec3;
    return {tip: place, direction, rollRad: way.roll};
  }

  // Once a picture.
  step(): void {
    const now = performance.now();
    const seconds = Math.min(0.1, (now - this.last) / 1e3);
    this.last = now;
    for (const code of this.pressed) {
      const [axis, sign] = kKeys[code];
      this.change({[axis]: sign * seconds * (axis === 'roll' ? kKeyRadPerS : kKeyMetresPerS)});
    }
    for (const pad of navigator.getGamepads?.() ?? [])
      if (pad?.connected) this.read(pad, seconds);
  }

  // Steady force as a fine shaking, what happens as a knock.
  shake(force: number, happened: boolean): void {
    const now = performance.now();
    if (happened) navigator.vibrate?.(25);
    if (now - this.shakenAt < kShakeMs && !happened) return;
    this.shakenAt = now;
    const weak = Math.min(1, force / kMostForce);
    for (const pad of navigator.getGamepads?.() ?? []) {
      const actuator = pad?.vibrationActuator;
      if (!actuator || (weak < 0.02 && !happened)) continue;
      void actuator
          .playEffect('dual-rumble', {
            duration: happened ? 120 : 2 * kShakeMs,
            weakMagnitude: weak,
            strongMagnitude: happened ? 1 : 0,
          })
          .catch(() => undefined);
    }
  }

  private change(by: Partial<Way>): void {
    const {way} = this;
    way.in = Math.max(-0.03, Math.min(kDeepest, way.in + (by.in ?? 0)));
    way.across = within(way.across + (by.across ?? 0), kAside);
    way.up = within(way.up + (by.up ?? 0), kAside);
    way.roll += by.roll ?? 0;
    this.moved();
  }

  private take(event: PointerEvent): void {
    if (event.pointerType === 'mouse' && event.button !== 0) return;
    this.held.set(event.pointerId, {x: event.clientX, y: event.clientY});
    this.canvas.setPointerCapture(event.pointerId);
  }

  private drag(event: PointerEvent): void {
    const from = this.held.get(event.pointerId);
    if (from === undefined) return;
    const to = {x: event.clientX, y: event.clientY};
    this.held.set(event.pointerId, to);
    if (this.held.size > 1) return;  // two fingers turn the picture
    this.follow(to.x - from.x, to.y - from.y, event.shiftKey ? 0.2 : 1);
  }

  // d: the needle as it is seen, in the plane of the picture.
  private follow(x: number, y: number, share: number): void {
    const {start, aim} = this;
    const pixel = aim && this.pixel(aim.tip);
    if (start === null || pixel === null) return;
    const {right, down} = pixel;
    const square = along(down, down);
    const [dx, dy] = [right, down].map((axis) => along(axis, start.direction) / square);
    const d = right.map((r, k) => dx * r + dy * down[k]) as Vec3;
    const shown = along(d, d);
    const way = right.map((r, k) => share * (x * r + y * down[k])) as Vec3;
    const by = along(way, start.direction) / shown;
    const aside = way.map((w, k) => w - by * d[k]) as Vec3;
    // Along a needle that points away from the eye there is no way on the picture.
    if (shown < 1 - kFromBehind * kFromBehind)
      this.change({in : share * y * Math.sqrt(square), across: along(way, start.right)});
    else
      this.change({in : by, across: along(aside, start.right), up: along(aside, start.up)});
  }

  // As long as a button of the page is held, as a key.
  press(code: string): void { this.pressed.add(code); }
  release(code: string): void { this.pressed.delete(code); }

  private wheel(event: WheelEvent): void {
    if (event.ctrlKey) return;  // nearer and away
    event.preventDefault();
    event.stopImmediatePropagation();
    if (event.shiftKey)
      this.change({roll: 0.002 * (event.deltaY + event.deltaX)});
    else
      this.change({in : kMetresPerWheel * event.deltaY});
  }

  private read(pad: Gamepad, seconds: number): void {
    const stick = (value = 0) => (Math.abs(value) < kRest ? 0 : value);
    const pressed = (i: number) => pad.buttons[i]?.value ?? 0;
    const by = {
      in : seconds * kPadMetresPerS * (pressed(7) - pressed(6)),
      across: seconds * kPadMetresPerS * stick(pad.axes[0]),
      up: -seconds * kPadMetresPerS * stick(pad.axes[1]),
      roll: seconds * kPadRadPerS * (pressed(5) - pressed(4)),
    };
    if (Object.values(by).some((value) => value !== 0)) this.change(by);
  }
}
