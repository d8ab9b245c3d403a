// SPDX-License-Identifier: Apache-2.0
// The organ's surface and its voxel lattice, deformed on the GPU: solid, as an x-ray, or cut open.
//
// Colours go to the screen as they are (no colour management), so the shading is kept plain: light
// from the camera and from above. Where a plane cuts, the far inside is drawn flat and dark: it
// looks like the cut face and hides nothing that lies in it.
import * as THREE from 'three';
import {outerEdges, type Organ} from '../organ';
import {kBody, materialColour} from '../palette';
import type {Hello} from '../protocol';
import {kDeform, kDeformSurface, surfaceGeometry, type Deformation} from './deform';

const kVertex = /* glsl */ `
precision highp float;
${kDeformSurface}
in vec3 position;
in vec3 normal;
in vec3 colour;
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
uniform mat3 normalMatrix;
out vec3 vNormal;
out vec3 vPlace;
out vec3 vView;
out vec3 vColour;
void main() {
  vec3 turned;
  deform(position, normal, vPlace, turned);
  vec4 view = modelViewMatrix * vec4(vPlace, 1.0);
  vNormal = normalMatrix * turned;
  vView = view.xyz;
  vColour = colour;
  gl_Position = projectionMatrix * view;
}`;

const kFragment = /* glsl */ `
precision highp float;
in vec3 vNormal;
in vec3 vPlace;
in vec3 vView;
in vec3 vColour;
uniform vec4 plane;  // what lies beyond it is not drawn
uniform float clear; // 0 solid, 1 x-ray
uniform vec3 inside;
uniform vec3 upward;
out vec4 colour;
void main() {
  if (dot(plane.xyz, vPlace) > plane.w) discard;
  if (!gl_FrontFacing) {
    if (clear > 0.5) discard;
    colour = vec4(mix(inside, vColour, 0.25), 1.0);
    return;
  }
  vec3 n = normalize(vNormal);
  float facing = max(0.0, -dot(n, normalize(vView)));
  float lit = 0.36 + 0.44 * facing + 0.22 * (0.5 + 0.5 * dot(n, upward));
  float shine = facing * facing;
  shine *= shine;
  shine *= shine;
  shine *= shine;
  vec3 shaded = vColour * lit + 0.10 * shine;
  float rim = 1.0 - facing;
  float alpha = mix(1.0, 0.16 + 0.62 * rim * rim, clear);
  colour = vec4(shaded, alpha);
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

export interface Surface {
  mesh: THREE.Mesh<THREE.BufferGeometry, THREE.RawShaderMaterial>;
  lattice: THREE.LineSegments<THREE.BufferGeometry, THREE.RawShaderMaterial>;
}

function vertexColours(organ: Organ): Float32Array {
  const table = organ.materials.map((_, i) => new THREE.Color(materialColour(i)).toArray());
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
    ): Surface {
  const geometry = surfaceGeometry(organ, hello);
  geometry.setAttribute('colour', new THREE.BufferAttribute(vertexColours(organ), 3));
  const material = new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3,
    vertexShader: kVertex,
    fragmentShader: kFragment,
    uniforms: {
      ...deformation.uniforms,
      plane,
      clear: {value: 0},
      inside: {value: new THREE.Color(kBody.inside)},
      upward: {value: new THREE.Vector3(0, 1, 0)},
    },
  });
  const mesh = new THREE.Mesh(geometry, material);
  mesh.frustumCulled = false;
  mesh.renderOrder = 2;
  return {mesh, lattice: makeLattice(organ, hello, deformation, plane)};
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

// cut: the clipping plane is on, so that insides can be seen.
export function setLook(surface: Surface, xray: boolean, cut: boolean): void {
  const material = surface.mesh.material;
  material.uniforms.clear.value = xray ? 1 : 0;
  material.transparent = xray;
  material.depthWrite = !xray;
  material.side = cut ? THREE.DoubleSide : THREE.FrontSide;
  material.needsUpdate = true;
}
