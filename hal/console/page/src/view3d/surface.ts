// SPDX-License-Identifier: Apache-2.0
// The organ's surface and its voxel lattice, deformed on the GPU: solid, as an x-ray, or cut open.
//
// Colours go to the screen as they are (no colour management). Light: a large lamp above the left
// shoulder, the sky, and a little from the camera; tissue in the shade is redder, wet, and pale
// where it is stretched, as skin is; near a needle it is darker. Where a plane cuts a closed
// surface, a stencil counts on each pixel how often one looks into it and out again: what remains
// is where caps.ts draws the face.
import * as THREE from 'three';
import {isOpen, outerEdges, type Organ} from '../organ';
import {kBody, materialColours} from '../palette';
import type {Hello, NeedleFrame} from '../protocol';
import {kDeform, kDeformSurface, surfaceGeometry, type Deformation} from './deform';
import {makeSkin, type Skin} from './skin';

// Lit once a vertex: the triangles are small, and a processor that draws feels every pixel.
const kVertex = /* glsl */ `
precision highp float;
in vec3 position;
in vec3 normal;
in vec3 colour;
#ifdef BY_GPU
${kDeformSurface}
#endif
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
uniform mat3 normalMatrix;
uniform float clear;  // 0 solid, 1 x-ray
uniform vec3 upward;
uniform vec4 touched[NEEDLES];  // where a needle meets the surface, and how far its shade goes
uniform vec3 outward[NEEDLES];  // along the needle
out vec4 vColour;
#ifdef CUT
out vec3 vPlace;
out vec3 vInside;
uniform vec3 inside;
#endif

const vec3 kLamp = vec3(-0.4767, 0.6674, 0.5721);
const vec3 kPale = vec3(1.0, 0.90, 0.84);

// How much light comes past the needles.
float besideNeedles(vec3 place) {
  float light = 1.0;
  for (int i = 0; i < NEEDLES; ++i) {
    vec3 from = place - touched[i].xyz;
    from -= max(0.0, dot(from, outward[i])) * outward[i];
    light *= 1.0 - 0.55 * exp(-dot(from, from) / (touched[i].w * touched[i].w));
  }
  return light;
}

void main() {
  vec3 place = position;
  vec3 turned = normal;
#ifdef BY_GPU
  deform(position, normal, place, turned);
#endif
  vec4 view = modelViewMatrix * vec4(place, 1.0);
  float stretch = length(turned);  // of the surface, by area: normals at rest have length 1
  vec3 n = normalMatrix * turned / stretch;
  vec3 eye = -normalize(view.xyz);
  float facing = max(0.0, dot(n, eye));
  float lamp = max(0.0, (dot(n, kLamp) + 0.4) / 1.4);
  float sky = 0.5 + 0.5 * dot(n, normalMatrix * upward);
  float lit = 0.32 + 0.26 * facing + 0.38 * lamp * lamp + 0.12 * sky;
  float shine = max(0.0, dot(n, normalize(kLamp + eye)));
  shine *= shine;
  shine *= shine;
  shine *= shine;
  shine *= shine * shine;  // to the 24th
  float rim = 1.0 - facing;
  vec3 tissue = mix(colour, kPale, 0.6 * smoothstep(0.02, 0.4, stretch - 1.0));
  tissue *= 1.0 - 0.4 * smoothstep(0.02, 0.5, 1.0 - stretch);
  tissue = mix(tissue * tissue, tissue, min(1.0, 0.25 + 0.85 * lit));
  float past = besideNeedles(place);
  vColour = vec4(past * (tissue * lit + 0.22 * shine), mix(1.0, 0.16 + 0.62 * rim * rim, clear));
#ifdef CUT
  vPlace = place;
  vInside = mix(inside, colour, 0.25);
#endif
  gl_Position = projectionMatrix * view;
}`;

const kFragment = /* glsl */ `
precision mediump float;
in vec4 vColour;
out vec4 colour;
#ifdef CUT
in highp vec3 vPlace;
in vec3 vInside;
uniform highp vec4 plane;  // what lies beyond it is not drawn
uniform highp float clear;
#endif
void main() {
  colour = vColour;
#ifdef CUT
  if (dot(plane.xyz, vPlace) > plane.w) discard;
  if (gl_FrontFacing || clear > 0.5) return;
  colour = vec4(vInside, 1.0);
#endif
}`;

const kLatticeVertex = /* glsl */ `
precision highp float;
${kDeform}
in vec3 position;
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
out vec3 vPlace;
void main() {
  vPlace = position + unit * movedOf(uint(gl_VertexID));
  gl_Position = projectionMatrix * modelViewMatrix * vec4(vPlace, 1.0);
}`;

const kLatticeFragment = /* glsl */ `
precision highp float;
in vec3 vPlace;
uniform vec4 plane;
uniform vec3 ink;
out vec4 colour;
void main() {
  if (dot(plane.xyz, vPlace) > plane.w) discard;
  colour = vec4(ink, 0.45);
}`;

const kNoShade = 1e-6;    // m
const kShadeEdges = 1.3;  // of voxels: what vertices can show
const kShadeRadii = 6;    // of a needle

export interface Surface {
  skin: Skin|null;  // null: deformed on the GPU
  open: boolean;    // its inside can be seen
  mesh: THREE.Mesh<THREE.BufferGeometry, THREE.RawShaderMaterial>;
  lattice: THREE.LineSegments<THREE.BufferGeometry, THREE.RawShaderMaterial>;
  counters: THREE.Mesh<THREE.BufferGeometry, THREE.RawShaderMaterial>[];  // of the stencil
}

function vertexColours(organ: Organ): Float32Array {
  const table = materialColours(organ.materials).map((c) => new THREE.Color(c).toArray());
  const colours = new Float32Array(3 * organ.vertexVoxel.length);
  organ.vertexVoxel.forEach((voxel, i) => {
    colours.set(table[organ.voxelMaterial[voxel]] ?? [0.5, 0.5, 0.5], 3 * i);
  });
  return colours;
}

export function makeSurface(
    organ: Organ,
    hello: Hello,
    deformation: Deformation,
    plane: {value: THREE.Vector4},
    byGpu: boolean,
    ): Surface {
  const skin = byGpu ? null : makeSkin(organ, hello);
  const geometry = skin ? skinGeometry(organ, skin) : surfaceGeometry(organ, hello);
  geometry.setAttribute('colour', new THREE.BufferAttribute(vertexColours(organ), 3));
  const needles = Math.max(1, hello.needles.length);
  const material = new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3,
    vertexShader: kVertex,
    fragmentShader: kFragment,
    defines: {NEEDLES: needles, ...(byGpu ? {BY_GPU: 1} : {})},
    uniforms: {
      ...deformation.uniforms,
      plane,
      clear: {value: 0},
      inside: {value: new THREE.Color(kBody.inside)},
      upward: {value: new THREE.Vector3(0, 1, 0)},
      touched: {value: Array.from({length: needles}, () => new THREE.Vector4(0, 0, 0, kNoShade))},
      outward: {value: Array.from({length: needles}, () => new THREE.Vector3())},
    },
  });
  const mesh = new THREE.Mesh(geometry, material);
  mesh.frustumCulled = false;
  mesh.renderOrder = 2;
  const open = isOpen(organ.triangles);
  const counters = [THREE.BackSide, THREE.FrontSide].map((side) => makeCounter(mesh, side));
  return {skin, open, mesh, counters, lattice: makeLattice(organ, hello, deformation, plane)};
}

// Draws nothing; adds one to the stencil for each way in, takes one for each way out.
function makeCounter(of: Surface['mesh'], side: THREE.Side): Surface['mesh'] {
  const material = of.material.clone();
  material.uniforms = of.material.uniforms;
  material.defines = {...of.material.defines, CUT: 1};
  material.side = side;
  material.colorWrite = material.depthWrite = material.depthTest = false;
  material.stencilWrite = true;
  const step =
      side === THREE.BackSide ? THREE.IncrementWrapStencilOp : THREE.DecrementWrapStencilOp;
  material.stencilZPass = material.stencilZFail = step;
  const counter = new THREE.Mesh(of.geometry, material);
  counter.frustumCulled = false;
  counter.visible = false;
  counter.renderOrder = 1.5;
  return counter;
}

function skinGeometry(organ: Organ, skin: Skin): THREE.BufferGeometry {
  const geometry = new THREE.BufferGeometry();
  for (const [name, values] of [['position', skin.places], ['normal', skin.normals]] as const) {
    const attribute = new THREE.BufferAttribute(values, 3);
    attribute.usage = THREE.DynamicDrawUsage;
    geometry.setAttribute(name, attribute);
  }
  const facing = new THREE.BufferAttribute(skin.facing, 1);
  facing.usage = THREE.DynamicDrawUsage;
  geometry.setIndex(facing);
  return geometry;
}

// Before each picture: leaves out what cannot be seen, where that is quicker than drawing it.
export function faceSurface({skin, mesh}: Surface, eye: THREE.Vector3): void {
  const {geometry} = mesh;
  if (skin === null || geometry.index === null) return;
  const insides = mesh.material.side === THREE.DoubleSide;
  if (insides) skin.facing.set(skin.all);
  geometry.setDrawRange(0, insides ? skin.facing.length : skin.face(eye));
  geometry.index.needsUpdate = true;
}

// Brings the surface to where a frame moved the particles; the GPU's reads `deformation` itself.
export function moveSurface({skin, mesh}: Surface, moved: Int16Array): void {
  if (skin === null) return;
  skin.move(moved);
  for (const name of ['position', 'normal']) mesh.geometry.getAttribute(name).needsUpdate = true;
}

// Where a needle enters, or its tip on the way there, and the way back to the hand.
function entryOf({nodes, depth}: NeedleFrame): {at: THREE.Vector3; outward: THREE.Vector3} {
  const at = new THREE.Vector3();
  const outward = new THREE.Vector3();
  let left = depth;
  for (let i = nodes.length - 1; i > 0; --i) {
    at.copy(nodes[i] as THREE.Vector3);
    outward.copy(nodes[i - 1] as THREE.Vector3).sub(at);
    const length = outward.length();
    outward.divideScalar(Math.max(length, 1e-9));
    at.addScaledVector(outward, Math.min(left, length));
    if (left <= length) break;
    left -= length;
  }
  return {at, outward};
}

// Where the needles of a frame meet the surface.
export function touchSurface({mesh}: Surface, hello: Hello, needles: NeedleFrame[]): void {
  const {touched, outward} = mesh.material.uniforms;
  needles.forEach((needle, i) => {
    if (touched.value[i] === undefined || needle.nodes.length < 2) return;
    const entry = entryOf(needle);
    const radius = kShadeRadii * (hello.needles[i]?.outerRadius ?? 0);
    const reach = Math.max(radius, kShadeEdges * hello.voxelEdge);
    touched.value[i].set(entry.at.x, entry.at.y, entry.at.z, reach);
    outward.value[i].copy(entry.outward);
  });
}

function makeLattice(
    organ: Organ,
    hello: Hello,
    deformation: Deformation,
    plane: {value: THREE.Vector4},
    ): Surface['lattice'] {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(hello.rest, 3));
  geometry.setIndex(new THREE.BufferAttribute(outerEdges(organ, hello.corners), 1));
  const material = new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3,
    vertexShader: kLatticeVertex,
    fragmentShader: kLatticeFragment,
    uniforms: {...deformation.uniforms, plane, ink: {value: new THREE.Color(kBody.lattice)}},
    transparent: true,
  });
  const lattice = new THREE.LineSegments(geometry, material);
  lattice.frustumCulled = false;
  lattice.renderOrder = 3;
  return lattice;
}

// cut: the clipping plane is on, so that insides can be seen, as those of an open surface always.
export function setLook(surface: Surface, xray: boolean, cut: boolean): void {
  const material = surface.mesh.material;
  const insides = cut || surface.open;
  material.uniforms.clear.value = xray ? 1 : 0;
  material.transparent = xray;
  material.depthWrite = !xray;
  material.side = insides ? THREE.DoubleSide : THREE.FrontSide;
  const {CUT: _, ...defines} = material.defines;
  material.defines = insides ? {...defines, CUT: 1} : defines;
  material.needsUpdate = true;
  for (const counter of surface.counters) counter.visible = cut && !surface.open;
}
