// SPDX-License-Identifier: Apache-2.0
// The demo: a needle in the visitor's hand, tissue that is computed in this page. The console's
// view, force and plots, fed by an engine in a worker (engine.ts) where those have a program.
import '../src/app.css';
import './demo.css';

import type {Vec3} from 'stylet-wasm';

import {button, el, panel, say} from '../src/dom';
import {readOrgan, type Organ} from '../src/organ';
import {ForcePanel} from '../src/panels/force_panel';
import {PlotPanels} from '../src/panels/plot_panels';
import {ScenePanel} from '../src/panels/scene_panel';
import {Store} from '../src/store';

import desktopHash from './organs/desktop.txt?raw';
import Engine from './engine.worker?worker&inline';
import type {Aim, FromEngine, Snapshot, ToEngine} from './engine';
import {frameOf, helloOf, sizeOf} from './frames';
import {Hand} from './hand';
import {Pace} from './pace';
import {kScenes, type Scene} from './scenes';

const kAhead = 0.008;     // m: the tip begins so far before the skin
const kSlowBelow = 0.95;  // of the time that passes
const kMostThreads = 4;   // more wait for each other
const kHints = [
  'Drag along the needle to push it in, and back to draw it out. The right button turns the view.',
  'Move a finger along the needle to push it in, and back to draw it out. Two fingers turn the ' +
      'view.',
];

const store = new Store();
const scene = new ScenePanel(store);
const force = new ForcePanel(store);
const plots = new PlotPanels(store, () => undefined, () => undefined);
const engine = new Engine();
const send = (message: ToEngine, transfer: Transferable[] = []) =>
    engine.postMessage(message, transfer);

const words = el('p', {class: 'words'});
const choice =
    el('select', {'aria-label': 'Scene: what the needle goes into'},
       ...kScenes.map(({name}, i) => el('option', {value: i}, name)));
const again = button('Start again', () => void begin(), {class: 'primary'});
const hint = el('p', {class: 'hint', role: 'status'});
const slow = el('p', {class: 'slow', hidden: true, role: 'status'});
const steps = el('span', {
  title:
      'A tick is a millisecond of simulated time if the machine is fast enough, otherwise 1.5 or ' +
      '2 milliseconds. The forces stay the same; thin skins become heavier.'
});
const hash = el('p', {class: 'hash quiet-text'});
const verdict = el('p', {role: 'status'});
const prove = button('Compute it here as well', () => void proveBits());
const proof = panel(
    'proof', 'The same bits as the desktop', 'teacher',
    el('p', {class: 'quiet-text'},
       'The program has computed an insertion of 2101 ticks into this liver, on a desktop with ' +
           'AVX instructions. This is the hash of the state at the end:'),
    hash, prove, verdict);
say(hash, desktopHash.trim());
// Held as long as it is to roll; Q and E do the same.
const rolling = el('div', {class: 'group roll', role: 'group', 'aria-label': 'Roll the needle'});
for (const [name, code] of [['Roll left', 'KeyQ'], ['Roll right', 'KeyE']]) {
  const held = button(name, () => undefined);
  held.addEventListener('pointerdown', () => hand.press(code));
  for (const end of ['pointerup', 'pointercancel', 'pointerleave', 'blur'])
    held.addEventListener(end, () => hand.release(code));
  rolling.append(held);
}

const hand = new Hand(scene.canvas, (at) => scene.view?.pixelAt(at) ?? null);
let chosen: Scene = kScenes[0];
let organ: Organ|null = null;
let sent = '';
let asked = false;  // for a frame that has not come

const cross = (a: Vec3, b: Vec3):
    Vec3 => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

// Along the way through a place of the organ's box, where it meets the surface at rest first.
function entryOf({at, direction}: Scene, of: Organ): Vec3 {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  const rest = of.vertexRest;
  for (let i = 0; i < rest.length; ++i) {
    low[i % 3] = Math.min(low[i % 3], rest[i]);
    high[i % 3] = Math.max(high[i % 3], rest[i]);
  }
  const from = at.map((share, k) => low[k] + share * (high[k] - low[k])) as Vec3;
  const outside = from.map((v, k) => v - 0.01 * direction[k]) as Vec3;
  let first = Infinity;
  for (let t = 0; t < of.triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((i) => {
      const v = 3 * of.triangles[t + i];
      return [rest[v], rest[v + 1], rest[v + 2]] as Vec3;
    });
    first = Math.min(first, hit(outside, direction, a, b, c));
  }
  return Number.isFinite(first) ? outside.map((v, k) => v + first * direction[k]) as Vec3 : from;
}

// Distance to a triangle along a direction: Moeller and Trumbore 1997.
function hit(from: Vec3, along: Vec3, a: Vec3, b: Vec3, c: Vec3): number {
  const minus = (p: Vec3, q: Vec3) => p.map((v, k) => v - q[k]) as Vec3;
  const dot = (p: Vec3, q: Vec3) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
  const [e1, e2, s] = [minus(b, a), minus(c, a), minus(from, a)];
  const p = cross(along, e2);
  const det = dot(e1, p);
  if (Math.abs(det) < 1e-14) return Infinity;
  const u = dot(s, p) / det;
  const q = cross(s, e1);
  const v = dot(along, q) / det;
  const at = dot(e2, q) / det;
  return u >= 0 && v >= 0 && u + v <= 1 && at > 0 ? at : Infinity;
}

async function begin(): Promise<void> {
  chosen = kScenes[Number(choice.value)];
  say(words, chosen.tells);
  rolling.hidden = chosen.needle.bevel_per_m === undefined;
  const bytes = await (await fetch(chosen.organ)).arrayBuffer();
  organ = readOrgan(bytes.slice(0));
  const entry = entryOf(chosen, organ);
  const tip = entry.map((v, k) => v - kAhead * chosen.direction[k]) as Vec3;
  const up: Vec3 = [0, 1, 0];
  const {direction, roll} = chosen;
  hand.begin({tip, direction, right: cross(direction, up), up, roll});
  const aim: Aim = {tip, direction, rollRad: roll};
  hint.classList.remove('gone');
  say(hint, kHints[matchMedia('(pointer: coarse)').matches ? 1 : 0]);
  opening = {entry};
  const byGpu = scene.view?.byGpu ?? true;
  // One processor is for the page: a helper that it keeps from running keeps the tick waiting.
  const threads = Math.max(1, Math.min(kMostThreads, navigator.hardwareConcurrency - 1));
  send({kind: 'open', organ: bytes, needle: chosen.needle, aim, byGpu, threads}, [bytes]);
}

let opening: {entry: Vec3} = {entry: [0, 0, 0]};
engine.addEventListener('message', (event: MessageEvent<FromEngine>) => {
  const message = event.data;
  if (message.kind === 'failed') {
    stopped(message.why);
  } else if (message.kind === 'opened') {
    asked = false;
    const {threads} = message;
    say(steps,
        `${Math.round(1 / message.period)} ticks a second by ${threads} ` +
            (threads === 1 ? 'thread' : 'threads'));
    store.organ = null;
    store.take(helloOf(message, chosen.name, opening.entry, chosen.direction));
    store.organ = organ;
    store.tell('organ');
    scene.setLook({xray: chosen.xray, cut: chosen.cut});
    scene.view?.preset(chosen.look, true);
  } else if (message.kind === 'frame') {
    show(message);
  }
});

engine.addEventListener('error', (event) => stopped(event.message));

function stopped(why: string): void {
  hint.classList.remove('gone');
  say(hint, `The simulation stopped: ${why}`);
}

function show(frame: Snapshot): void {
  asked = false;
  if (store.hello === null || frame.moved.length !== store.hello.rest.length) return;
  pace.see(performance.now(), frame.speed);
  store.take(frameOf(frame, chosen.direction));
  hand.shake(sizeOf(frame.out), frame.events.length > 0);
  slow.hidden = frame.speed >= kSlowBelow;
  if (!slow.hidden)
    say(slow, `This machine computes at ${Math.round(100 * frame.speed)} % of real time`);
}

async function proveBits(): Promise<void> {
  prove.disabled = true;
  say(verdict, 'Computing ...');
  const worker = new Engine();
  const bytes = await (await fetch(kScenes[0].organ)).arrayBuffer();
  worker.addEventListener('message', (event: MessageEvent<FromEngine>) => {
    const found = event.data.kind === 'proved' ? event.data.hash : 'no result';
    const same = found === desktopHash.trim();
    verdict.className = same ? 'same' : 'other';
    say(verdict,
        same ? `This browser: ${found}. The same, bit for bit.` :
               `This browser: ${found}. It should be the same: please report it.`);
    prove.disabled = false;
    worker.terminate();
  });
  const message: ToEngine = {kind: 'prove', organ: bytes};
  worker.postMessage(message, [bytes]);
}

hand.moved = () => hint.classList.add('gone');
choice.addEventListener('change', () => void begin());
document.addEventListener('keydown', (event) => {
  if (event.key === 'r' && !event.ctrlKey && !event.metaKey) void begin();
});
scene.root.append(hint, slow);
scene.root.querySelector('.scene-numbers')?.append(steps);
scene.root.querySelector('.scene-tools')?.prepend(rolling);
document.body.append(
    el('header', {class: 'demo-top'}, el('h1', {}, 'Stylet'), choice, again, words),
    el('main', {class: 'demo', id: 'main'}, scene.root,
       el('div', {class: 'side'}, force.root, proof, plots.root)));
// The teacher's picture, and the forces by cause, which the console shows to the engineer.
document.body.dataset.view = 'teacher';
force.root.querySelector('.causes')?.removeAttribute('data-in');
store.select('teacher');
if (scene.begin()) {
  // The left button and one finger hold the needle; the right one and two turn the picture.
  const {controls} = scene.view!.cameraMan;
  Object.assign(controls.mouseButtons, {LEFT: null, RIGHT: 0});
  Object.assign(controls.touches, {ONE: null, TWO: 3});
} else {
  say(hint, 'This browser has no WebGL 2: the page shows forces and plots, but no 3D view.');
}
const pace = new Pace(scene.view?.byGpu ?? true);
void begin();

function picture(): void {
  requestAnimationFrame(picture);
  if (!pace.due(performance.now())) return;
  hand.step();
  const {aim} = hand;
  const text = JSON.stringify(aim);
  if (aim !== null && text !== sent) {
    send({kind: 'aim', aim});
    sent = text;
  }
  if (!asked) send({kind: 'show'});
  asked = true;
  store.flush();
  if (scene.view === null) return;
  scene.view.scale = pace.scale;
  scene.view.step();
}
requestAnimationFrame(picture);

// For tests: what the page holds.
Object.assign(window, {stylet: {store, hand, view: () => scene.view}});
