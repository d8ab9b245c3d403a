// SPDX-License-Identifier: Apache-2.0
// The 3D view: puts surface, bodies and camera on a canvas, and measures what a picture costs.
//
// Draws only when something changed. Where a processor draws, edges are smooth only in a picture
// that rests: smooth ones in every picture would take as long again. Budget: medians over the last
// pictures, ms by part; `draw` is the time to hand over the work, or with `finish` also to wait for
// it.
import * as THREE from 'three';
import type {Frame, Vec3} from '../protocol';
import type {Store} from '../store';
import {Bodies, disposeAll} from './bodies';
import {aimAt, CameraMan, type Preset} from './camera';
import {Caps} from './caps';
import {makeDeformation, readBack, upload, type Deformation} from './deform';
import {makeGround} from './ground';
import {makeSkin} from './skin';
import {
  faceSurface,
  makeSurface,
  moveSurface,
  setLook,
  touchSurface,
  type Surface
} from './surface';

export interface Look {
  xray: boolean;
  lattice: boolean;
  particles: boolean;
  surface: boolean;
  cut: boolean;
  cutAt: number;  // 0 to 1 of the way through
}

// Whether a processor draws WebGL: SwiftShader, Mesa's llvmpipe, Windows' Basic Render Driver.
function drawnByProcessor(): boolean {
  const gl = document.createElement('canvas').getContext('webgl2');
  if (gl === null) return false;
  const info = gl.getExtension('WEBGL_debug_renderer_info');
  const name = String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  gl.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

export type Part = 'message'|'deform'|'bodies'|'caps'|'face'|'draw';
const kKept = 60;
const kMostPixelRatio = 2;
const kRestMs = 300;
const kBehindNeedle = 2;  // radii
const kSeenM = 30e-6;     // less is no pixel's width from where one sees an organ
const kSeenN = 0.01;

class Budget {
  pictures = 0;  // since the page was opened
  private kept:
      Record<Part, number[]> = {message: [], deform: [], bodies: [], caps: [], face: [], draw: []};
  private drawn: number[] = [];

  time<T>(part: Part, work: () => T): T {
    const began = performance.now();
    const out = work();
    const list = this.kept[part];
    list.push(performance.now() - began);
    if (list.length > kKept) list.shift();
    return out;
  }
  // Forgets what was measured.
  clear(): void { this.kept = {message: [], deform: [], bodies: [], caps: [], face: [], draw: []}; }
  tick(): void {
    ++this.pictures;
    this.drawn.push(performance.now());
    while (this.drawn.length > 2 * kKept) this.drawn.shift();
  }
  // Pictures of the last second.
  perSecond(): number {
    const since = performance.now() - 1000;
    return this.drawn.filter((at) => at > since).length;
  }
  median(part: Part): number {
    const sorted = [...this.kept[part]].sort((a, b) => a - b);
    return sorted[sorted.length >> 1] ?? 0;
  }
}

export class View3d {
  readonly budget = new Budget();
  readonly byGpu = !drawnByProcessor();
  readonly cameraMan: CameraMan;
  look:
      Look = {xray: false, lattice: false, particles: false, surface: true, cut: false, cutAt: 0.5};
  finish = false;  // wait for the GPU after each picture: for measuring
  always = false;  // draw every picture anew: for measuring
  scale = 1;       // of pixels each way, while pictures move
  drawn: () => void = () => undefined;
  private readonly renderer: THREE.WebGLRenderer;
  private readonly scene = new THREE.Scene();
  private readonly plane = {value: new THREE.Vector4(0, 0, 0, 1)};
  private deformation: Deformation|null = null;
  private surface: Surface|null = null;
  private caps: Caps|null = null;
  private bodies: Bodies|null = null;
  private ground: THREE.Mesh|null = null;
  private stale = true;
  private movedAt = 0;     // performance.now() of the last picture that something had changed for
  private rested = false;  // the picture of rest is drawn
  private drawnFrame: Frame|null = null;  // of the last picture
  private drawnMoved = new Int16Array();
  private fresh = false;     // a frame that is not uploaded yet
  private capsStale = true;  // faces of the cut are of another frame or plane

  constructor(
      readonly canvas: HTMLCanvasElement,
      private readonly store: Store,
      still: () => boolean,
  ) {
    THREE.ColorManagement.enabled = false;
    this.renderer = new THREE.WebGLRenderer({
      canvas,
      antialias: this.byGpu,
      alpha: true,
      powerPreference: 'high-performance',
      preserveDrawingBuffer: false,
      stencil: true,
    });
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    this.renderer.setClearColor(0x000000, 0);
    this.cameraMan = new CameraMan(canvas, still, () => (this.stale = true));
    this.cameraMan.camera.add(new THREE.DirectionalLight('#ffffff', 1.5)
                                  .translateX(-0.5)
                                  .translateY(0.7)
                                  .translateZ(0.8));
    this.scene.add(this.cameraMan.camera, new THREE.AmbientLight('#ffffff', 1.1));
    store.on(['organ'], () => this.rebuild());
    store.on(['frame'], () => {
      if (this.seenToMove()) this.fresh = this.stale = true;
    });
    new ResizeObserver(() => this.resize()).observe(canvas);
    canvas.addEventListener('webglcontextlost', (event) => event.preventDefault());
    canvas.addEventListener('webglcontextrestored', () => this.rebuild());
  }

  setLook(change: Partial<Look>): void {
    Object.assign(this.look, change);
    this.applyLook();
  }

  preset(preset: Preset, atOnce = this.cameraMan.still()): void {
    const {frame, needle} = this.store;
    this.cameraMan.look(preset, frame?.needles[needle]?.tip ?? null, atOnce);
    this.stale = true;
  }

  // Where a place of the world is on the canvas, in CSS pixels; null: behind the camera.
  project(place: {x: number; y: number; z: number}): {x: number; y: number}|null {
    const p = new THREE.Vector3(place.x, place.y, place.z).project(this.cameraMan.camera);
    if (p.z > 1) return null;
    const {clientWidth, clientHeight} = this.canvas;
    return {x: ((p.x + 1) / 2) * clientWidth, y: ((1 - p.y) / 2) * clientHeight};
  }

  // Ways in the world of a pixel of CSS to the right and of one down, at a place.
  pixelAt(place: [number, number, number]):
      {right: [number, number, number], down: [number, number, number]} {
    const {camera} = this.cameraMan;
    const away = new THREE.Vector3(...place).applyMatrix4(camera.matrixWorldInverse).z;
    const size = 2 * -away * Math.tan((camera.fov * Math.PI) / 360) / this.canvas.clientHeight;
    const [right, up] = [new THREE.Vector3(), new THREE.Vector3()];
    camera.matrixWorld.extractBasis(right, up, new THREE.Vector3());
    return {
      right: right.multiplyScalar(size).toArray(),
      down: up.multiplyScalar(-size).toArray(),
    };
  }

  // Places of all vertices, or normals, as the GPU computes them or as the processor does.
  deformedVertices(byGpu: boolean, normals = false): Float32Array {
    const {organ, hello, moved} = this.store;
    if (organ === null || hello === null || this.deformation === null) return new Float32Array();
    if (byGpu) {
      upload(this.deformation, moved);
      return readBack(this.renderer, organ, hello, this.deformation, normals);
    }
    const skin = makeSkin(organ, hello);
    skin.move(moved);
    return normals ? skin.normals : skin.places;
  }

  private rebuild(): void {
    const {hello, organ} = this.store;
    const counters = this.surface?.counters ?? [];
    for (const thing
             of [this.bodies?.group, this.caps?.group, this.surface?.mesh, this.surface?.lattice,
                 this.ground, ...counters]) {
      if (!thing) continue;
      this.scene.remove(thing);
      disposeAll(thing);
    }
    this.deformation?.texture.dispose();
    if (hello === null || organ === null) return;
    this.deformation = makeDeformation(hello);
    this.surface = makeSurface(organ, hello, this.deformation, this.plane, this.byGpu);
    this.bodies = new Bodies(hello);
    this.caps = new Caps(organ, hello, this.surface.open);
    this.scene.add(
        this.surface.mesh, this.surface.lattice, ...this.surface.counters, this.caps.group,
        this.bodies.group);
    this.look.cutAt = this.besideNeedle();
    const aim = aimAt(hello);
    this.ground = makeGround(hello.rest, aim.up);
    this.scene.add(this.ground);
    this.surface.mesh.material.uniforms.upward.value.copy(aim.up);
    this.cameraMan.setScene(aim);
    this.resize();
    this.applyLook();
    this.drawnFrame = null;
    this.fresh = this.store.frame !== null;
  }

  // The plane is parallel to the needle and faces the side preset's camera.
  private applyLook(): void {
    this.stale = true;
    if (this.surface === null || this.bodies === null || this.caps === null) return;
    const {xray, lattice, particles, surface, cut, cutAt} = this.look;
    setLook(this.surface, xray, cut);
    this.caps.setLook(xray, cut, surface);
    this.surface.mesh.visible = surface;
    for (const counter of this.surface.counters) counter.visible &&= surface;
    this.surface.lattice.visible = lattice;
    this.bodies.showParticles(particles);
    const {across, low, high} = this.acrossNeedle();
    const at = cut ? high - cutAt * (high - low) : 1e3;
    this.plane.value.set(across.x, across.y, across.z, at);
    this.capsStale = true;
  }

  // The direction that the plane moves in, and the organ's extent along it.
  private acrossNeedle(): {across: THREE.Vector3; low: number; high: number} {
    const {hello} = this.store;
    const across = new THREE.Vector3();
    if (hello === null) return {across, low: 0, high: 1};
    const {direction, up} = aimAt(hello);
    across.crossVectors(direction, up).normalize();
    let [low, high] = [Infinity, -Infinity];
    for (let i = 0; i < hello.rest.length; i += 3) {
      const at =
          across.x * hello.rest[i] + across.y * hello.rest[i + 1] + across.z * hello.rest[i + 2];
      low = Math.min(low, at);
      high = Math.max(high, at);
    }
    return {across, low, high};
  }

  // Just behind the needle, so that it lies on the face of the cut.
  private besideNeedle(): number {
    const needle = this.store.hello?.needles[0];
    const {across, low, high} = this.acrossNeedle();
    if (!needle || !(high > low)) return 0.5;
    const {x, y, z} = needle.entry;
    const at = across.dot(new THREE.Vector3(x, y, z)) - kBehindNeedle * needle.outerRadius;
    return Math.min(0.98, Math.max(0.02, (high - at) / (high - low)));
  }

  private resize(): void {
    const {clientWidth, clientHeight} = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.cameraMan.camera.aspect = clientWidth / clientHeight;
    this.cameraMan.camera.updateProjectionMatrix();
    this.stale = true;
  }

  // Whether a frame would make another picture than the last that was drawn. Where nothing moves
  // any more, the picture can rest.
  private seenToMove(): boolean {
    const {frame, moved} = this.store;
    const {drawnFrame, drawnMoved} = this;
    if (frame === null || drawnFrame === null || moved.length !== drawnMoved.length) return true;
    if (frame.particles.length !== drawnFrame.particles.length) return true;
    const apart = (a: Vec3, b: Vec3) => Math.hypot(a.x - b.x, a.y - b.y, a.z - b.z);
    const needleMoved = frame.needles.some(({nodes, handle, force}, i) => {
      const was = drawnFrame.needles[i];
      return nodes.length !== was?.nodes.length || apart(handle, was.handle) > kSeenM ||
          apart(force, was.force) > kSeenN ||
          nodes.some((node, n) => apart(node, was.nodes[n]) > kSeenM);
    });
    if (needleMoved) return true;
    const most = kSeenM / (this.store.hello?.positionUnit ?? 1);
    return moved.some((at, i) => Math.abs(at - drawnMoved[i]) > most);
  }

  // Once a picture of the browser.
  step(): void {
    if (this.always) this.fresh = this.stale = this.store.frame !== null;
    if (this.cameraMan.move(performance.now())) this.stale = true;
    if (this.canvas.clientWidth === 0) return;
    const resting = !this.stale && performance.now() - this.movedAt > kRestMs;
    if (!this.stale && (!resting || this.rested)) return;
    if (this.stale) this.movedAt = performance.now();
    this.rested = resting;
    this.setSharpness(resting);
    this.stale = false;
    const {frame} = this.store;
    if (this.fresh && frame !== null && this.deformation !== null) {
      const deformation = this.deformation;
      this.budget.time('deform', () => {
        upload(deformation, this.store.moved);
        if (this.surface) moveSurface(this.surface, this.store.moved);
      });
      this.budget.time('bodies', () => this.bodies?.show(frame));
      const {hello} = this.store;
      if (this.surface && hello) touchSurface(this.surface, hello, frame.needles);
      this.fresh = false;
      this.capsStale = true;
      this.drawnFrame = frame;
      this.drawnMoved = this.store.moved.slice();
    }
    if (this.capsStale) {
      this.budget.time('caps', () => this.caps?.move(this.store.moved, this.plane.value));
      this.capsStale = false;
    }
    this.budget.time('face', () => {
      if (this.surface) faceSurface(this.surface, this.cameraMan.camera.position);
    });
    this.budget.time('draw', () => {
      this.renderer.render(this.scene, this.cameraMan.camera);
      if (this.finish) this.waitForGpu();
    });
    this.budget.tick();
    this.drawn();
  }

  // Changes the canvas only where that changes something, as it is made anew then.
  private setSharpness(resting: boolean): void {
    const own = Math.min(window.devicePixelRatio, kMostPixelRatio);
    const moving = this.scale * (this.byGpu ? own : Math.min(own, 1));
    const ratio = !resting ? moving : this.byGpu ? own : kMostPixelRatio;
    if (this.renderer.getPixelRatio() !== ratio) this.renderer.setPixelRatio(ratio);
  }

  private waitForGpu(): void {
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }
}
