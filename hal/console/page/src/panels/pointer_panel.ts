// SPDX-License-Identifier: Apache-2.0
// No device: the pointer is the needle. Drag pushes, wheel rolls, keys do both; one finger pushes,
// two that turn about each other roll.
//
// Sends the handle's pose in the frame of a device (x right, y up, -z the way in, from its start),
// at most once a picture. Shown only where a needle's device is "pointer:".
import {button, el, panel, say} from '../dom';
import {Activity, ask, type Quaternion, type Vec3} from '../protocol';
import type {Store} from '../store';
import {texts} from '../texts';

const kMetresPerPixel = 0.25e-3;
const kRollPerWheel = 0.15;  // degrees a unit of wheel, 100 a notch
const kKeyMetresPerS = 0.02;
const kKeyDegreesPerS = 90;
const kSlow = 0.2;
const kFarthest = 0.3;  // m, of any coordinate

type Axis = 'x'|'y'|'z'|'roll';
const kKeys: Record<string, [Axis, number]> = {
  KeyW: ['z', -1],
  KeyS: ['z', 1],
  KeyA: ['x', -1],
  KeyD: ['x', 1],
  KeyR: ['y', 1],
  KeyF: ['y', -1],
  KeyQ: ['roll', 1],
  KeyE: ['roll', -1],
};

export function rollOf(degrees: number): Quaternion {
  const half = (degrees * Math.PI) / 360;
  return {w: Math.cos(half), x: 0, y: 0, z: Math.sin(half)};
}

const kKept = 'stylet.pointer';
interface Kept {
  scene: string;
  place: Vec3;
  roll: number;
}

const within = (value: number): number => Math.min(kFarthest, Math.max(-kFarthest, value));

interface Spot {
  x: number;
  y: number;
}
const kFullTurn = 360;

// From where the second finger was, seen from the first, to where it is: degrees, the shorter way.
function turnBetween(from: Spot, to: Spot): number {
  const degrees = ((Math.atan2(to.y, to.x) - Math.atan2(from.y, from.x)) * 180) / Math.PI;
  return degrees - kFullTurn * Math.round(degrees / kFullTurn);
}

export class PointerPanel {
  readonly root: HTMLElement;
  private readonly pad = el('div', {
    class: 'pad',
    tabindex: 0,
    role: 'application',
    'aria-label': texts.pointer.pad,
  });
  private readonly stem = el('div', {class: 'stem', 'aria-hidden': 'true'});
  private readonly pull = el('div', {class: 'pull', 'aria-hidden': 'true'});
  private readonly words = el('p', {class: 'pad-words'});
  private place: Vec3 = {x: 0, y: 0, z: 0};
  private roll = 0;
  private activity = Activity.Ready;
  private readonly held = new Map<number, Spot>();  // pointers that are down
  private readonly pressed = new Set<string>();
  private slow = false;
  private stale = false;
  private last = 0;

  constructor(
      private readonly store: Store,
      private readonly send: (bytes: Uint8Array) => void,
  ) {
    this.pad.append(this.pull, this.stem, this.words);
    this.root = panel(
        'pointer',
        texts.pointer.heading,
        'trainee engineer',
        this.pad,
        el('p', {class: 'quiet-text'}, texts.pointer.help),
        button(texts.pointer.home, () => this.home()),
    );
    this.root.hidden = true;
    this.listen();
    store.on(['hello'], () => this.begin());
    store.on(['frame'], () => {
      this.homeWhenReset();
      this.showForce();
    });
    requestAnimationFrame((now) => this.step(now));
  }

  // The needle that the pointer holds; -1: none.
  private get needle(): number {
    const needles = this.store.hello?.needles ?? [];
    return needles.findIndex((n) => n.device.startsWith('pointer:'));
  }

  private begin(): void {
    this.root.hidden = this.needle < 0 || this.store.playback || !this.store.hello?.mayControl;
    this.activity = Activity.Running;  // unless the first frame says otherwise
    this.takeUp();
  }

  // A page that is loaded again in an attempt goes on from where the needle was held.
  private keep(): void {
    const kept: Kept = {scene: this.store.hello?.scene ?? '', place: this.place, roll: this.roll};
    window.sessionStorage.setItem(kKept, JSON.stringify(kept));
  }

  private takeUp(): void {
    try {
      const kept = JSON.parse(window.sessionStorage.getItem(kKept) ?? '{}') as Partial<Kept>;
      const {x = 0, y = 0, z = 0} = kept.place ?? {};
      const numbers = [x, y, z, kept.roll ?? 0];
      if (kept.scene !== this.store.hello?.scene || !numbers.every(Number.isFinite))
        return this.home();
      this.place = {x: within(x), y: within(y), z: within(z)};
      this.roll = kept.roll ?? 0;
      this.changed();
    } catch {
      this.home();  // not what this page writes
    }
  }

  // How far the tip is past the entry is read off the needle itself, not off the pointer's way.
  private showWords(): void {
    const tip = this.store.frame?.needles[this.needle]?.tip;
    const info = this.store.hello?.needles[this.needle];
    if (!tip || !info) return say(this.words, texts.pointer.roll(this.roll));
    const {entry, direction: d} = info;
    const past = d.x * (tip.x - entry.x) + d.y * (tip.y - entry.y) + d.z * (tip.z - entry.z);
    say(this.words, `${texts.pointer.advance(1e3 * past)}\n${texts.pointer.roll(this.roll)}`);
  }

  // A reset puts the needle back to its start, so the pointer must not hold it elsewhere.
  private homeWhenReset(): void {
    const activity = this.store.frame?.activity ?? Activity.Ready;
    if (activity === Activity.Ready && this.activity !== Activity.Ready) this.home();
    this.activity = activity;
  }

  private home(): void {
    this.place = {x: 0, y: 0, z: 0};
    this.roll = 0;
    this.changed();
  }

  private changed(): void {
    this.stale = true;
    this.showWords();
    this.keep();
    const {x, z} = this.place;
    const [right, up] = [x, -z].map((v) => Math.max(-60, Math.min(60, 600 * v)));
    this.stem.style.transform = `translate(${right}px, ${- up}px) rotate(${this.roll}deg)`;
  }

  private drag(event: PointerEvent): void {
    const from = this.held.get(event.pointerId);
    if (from === undefined) return;
    const to = {x: event.clientX, y: event.clientY};
    this.held.set(event.pointerId, to);
    if (this.held.size === 1) {
      const scale = kMetresPerPixel * (event.shiftKey ? kSlow : 1);
      this.place.x = within(this.place.x + scale * (to.x - from.x));
      this.place.z = within(this.place.z + scale * (to.y - from.y));
    } else {
      const [, other] = [...this.held].find(([id]) => id !== event.pointerId) ?? [0, to];
      const seen = (spot: Spot) => ({x: spot.x - other.x, y: spot.y - other.y});
      this.roll += turnBetween(seen(from), seen(to));
    }
    this.changed();
  }

  private listen(): void {
    const {pad} = this;
    pad.addEventListener('pointerdown', (event) => {
      this.held.set(event.pointerId, {x: event.clientX, y: event.clientY});
      pad.setPointerCapture(event.pointerId);
      pad.classList.add('held');
      this.stale = true;
    });
    // A browser that began to drag the picture of the needle would take the pointer away.
    pad.addEventListener('dragstart', (event) => event.preventDefault());
    for (const end of ['pointerup', 'pointercancel', 'lostpointercapture'] as const) {
      pad.addEventListener(end, (event) => {
        this.held.delete(event.pointerId);
        pad.classList.toggle('held', this.held.size > 0);
        this.stale = true;
      });
    }
    pad.addEventListener('pointermove', (event) => this.drag(event));
    pad.addEventListener(
        'wheel',
        (event) => {
          event.preventDefault();
          this.roll += kRollPerWheel * event.deltaY;
          this.changed();
        },
        {passive: false},
    );
    pad.addEventListener('keydown', (event) => {
      this.slow = event.shiftKey;
      if (!(event.code in kKeys) || event.ctrlKey || event.altKey || event.metaKey) return;
      event.preventDefault();
      event.stopPropagation();
      this.pressed.add(event.code);
    });
    pad.addEventListener('keyup', (event) => {
      this.slow = event.shiftKey;
      this.pressed.delete(event.code);
    });
    pad.addEventListener('blur', () => this.pressed.clear());
  }

  private step(now: number): void {
    requestAnimationFrame((next) => this.step(next));
    const seconds = Math.min(0.1, (now - this.last) / 1000);
    this.last = now;
    const factor = seconds * (this.slow ? kSlow : 1);
    for (const code of this.pressed) {
      const [axis, sign] = kKeys[code];
      if (axis === 'roll')
        this.roll += sign * factor * kKeyDegreesPerS;
      else
        this.place[axis] = within(this.place[axis] + sign * factor * kKeyMetresPerS);
      this.changed();
    }
    if (!this.stale || this.root.hidden) return;
    this.stale = false;
    const buttons = this.held.size > 0 || this.pressed.size > 0 ? 1 : 0;
    this.send(ask.pointer(this.needle, this.place, rollOf(this.roll), buttons));
  }

  // The force the hand would feel, as a shadow that pushes back.
  private showForce(): void {
    const of = this.store.frame?.needles[this.needle];
    const info = this.store.hello?.needles[this.needle];
    if (!of || !info || this.root.hidden) return;
    this.showWords();
    const {x, y, z} = of.force;
    const share = Math.min(1, Math.hypot(x, y, z) / (info.maxForce || 10));
    this.pull.style.transform = `scaleY(${share.toFixed(3)})`;
  }
}
