// SPDX-License-Identifier: Apache-2.0
// Deformation on the GPU: displacements of all particles in one integer texture, read by vertices.
//
// A vertex of the surface knows the eight particles of its voxel and its place between them; what
// draws it and what reads it back for tests share kDeform. Normals follow from the gradient of the
// same trilinear map (cofactors of I + dU/dX), so they cost no further reads.
// Units: displacements in `unit` metres, all else in m; frame: world.
import * as THREE from 'three';
import type {Organ} from '../organ';
import type {Hello} from '../protocol';

const kTextureWidth = 256;  // a power of two, so that the shader needs no division

export const kDeform = /* glsl */ `
precision highp int;
precision highp isampler2D;
uniform isampler2D moved;
uniform float unit;

vec3 movedOf(uint particle) {
  return vec3(texelFetch(moved, ivec2(int(particle & 255u), int(particle >> 8u)), 0).xyz);
}
`;

export const kDeformSurface = /* glsl */ `
${kDeform}
uniform float perEdge; // 1 / edge of a voxel
in uvec4 low;          // particles at z = 0 of the voxel, then those at z = 1
in uvec4 high;
in vec3 fraction;

void deform(vec3 rest, vec3 restNormal, out vec3 place, out vec3 normal) {
  vec3 d0 = movedOf(low.x), d1 = movedOf(low.y), d2 = movedOf(low.z), d3 = movedOf(low.w);
  vec3 d4 = movedOf(high.x), d5 = movedOf(high.y), d6 = movedOf(high.z), d7 = movedOf(high.w);
  vec3 f = fraction;
  vec3 y0 = mix(d0, d1, f.x), y1 = mix(d2, d3, f.x);
  vec3 y2 = mix(d4, d5, f.x), y3 = mix(d6, d7, f.x);
  vec3 z0 = mix(y0, y1, f.y), z1 = mix(y2, y3, f.y);
  place = rest + unit * mix(z0, z1, f.z);
  float scale = unit * perEdge;
  vec3 a = scale * mix(mix(d1 - d0, d3 - d2, f.y), mix(d5 - d4, d7 - d6, f.y), f.z);
  vec3 b = scale * mix(y1 - y0, y3 - y2, f.z);
  vec3 c = scale * (z1 - z0);
  a.x += 1.0;
  b.y += 1.0;
  c.z += 1.0;
  normal = restNormal.x * cross(b, c) + restNormal.y * cross(c, a) + restNormal.z * cross(a, b);
}
`;

export interface Deformation {
  texture: THREE.DataTexture;
  uniforms: {moved: {value: THREE.DataTexture}; unit: {value: number}; perEdge: {value: number};};
}

export function makeDeformation(hello: Hello): Deformation {
  const rows = Math.max(1, Math.ceil(hello.particles / kTextureWidth));
  const texture = new THREE.DataTexture(
      new Int16Array(4 * kTextureWidth * rows),
      kTextureWidth,
      rows,
      THREE.RGBAIntegerFormat,
      THREE.ShortType,
  );
  texture.internalFormat = 'RGBA16I';
  texture.minFilter = texture.magFilter = THREE.NearestFilter;
  texture.generateMipmaps = false;
  texture.unpackAlignment = 1;
  texture.needsUpdate = true;
  return {
    texture,
    uniforms: {
      moved: {value: texture},
      unit: {value: hello.positionUnit},
      perEdge: {value: 1 / hello.voxelEdge},
    },
  };
}

export function upload(deformation: Deformation, moved: Int16Array): void {
  (deformation.texture.image.data as unknown as Int16Array).set(moved);
  deformation.texture.needsUpdate = true;
}

// The surface's geometry: rest place and normal, and what deform() needs.
export function surfaceGeometry(organ: Organ, hello: Hello): THREE.BufferGeometry {
  const count = organ.vertexVoxel.length;
  const low = new Uint32Array(4 * count);
  const high = new Uint32Array(4 * count);
  for (let i = 0; i < count; ++i) {
    const eight = hello.corners.subarray(8 * organ.vertexVoxel[i], 8 * organ.vertexVoxel[i] + 8);
    low.set(eight.subarray(0, 4), 4 * i);
    high.set(eight.subarray(4, 8), 4 * i);
  }
  const integers = (array: Uint32Array) => {
    const attribute = new THREE.BufferAttribute(array, 4);
    attribute.gpuType = THREE.IntType;
    return attribute;
  };
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(organ.vertexRest, 3));
  geometry.setAttribute('normal', new THREE.BufferAttribute(organ.vertexNormal, 3));
  geometry.setAttribute('fraction', new THREE.BufferAttribute(organ.vertexFraction, 3));
  geometry.setAttribute('low', integers(low));
  geometry.setAttribute('high', integers(high));
  geometry.setIndex(new THREE.BufferAttribute(organ.triangles, 1));
  return geometry;
}

// Places of all surface vertices as the GPU computes them, or normals of any length, x y z each:
// the proof that what is drawn is what the kernel says.
export function readBack(
    renderer: THREE.WebGLRenderer,
    organ: Organ,
    hello: Hello,
    deformation: Deformation,
    normals: boolean,
    ): Float32Array {
  const count = organ.vertexVoxel.length;
  const [width, height] = [kTextureWidth, Math.ceil(count / kTextureWidth)];
  const target = new THREE.WebGLRenderTarget(width, height, {
    type: THREE.FloatType,
    minFilter: THREE.NearestFilter,
    magFilter: THREE.NearestFilter,
    depthBuffer: false,
  });
  const material = new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3,
    uniforms: {...deformation.uniforms, size: {value: new THREE.Vector2(width, height)}},
    vertexShader: `precision highp float;
      ${kDeformSurface}
      in vec3 position;
      in vec3 normal;
      uniform vec2 size;
      out vec3 at;
      void main() {
        vec3 place, turned;
        deform(position, normal, place, turned);
        at = ${normals ? 'turned' : 'place'};
        vec2 cell = vec2(float(gl_VertexID & 255), float(gl_VertexID >> 8));
        gl_Position = vec4((cell + 0.5) / size * 2.0 - 1.0, 0.0, 1.0);
        gl_PointSize = 1.0;
      }`,
    fragmentShader: `precision highp float;
      in vec3 at;
      out vec4 colour;
      void main() { colour = vec4(at, 1.0); }`,
    depthTest: false,
    depthWrite: false,
    blending: THREE.NoBlending,
  });
  const geometry = surfaceGeometry(organ, hello).setIndex(null);
  const points = new THREE.Points(geometry, material);
  points.frustumCulled = false;
  const scene = new THREE.Scene();
  scene.add(points);
  renderer.setRenderTarget(target);
  renderer.render(scene, new THREE.Camera());
  const pixels = new Float32Array(4 * width * height);
  renderer.readRenderTargetPixels(target, 0, 0, width, height, pixels);
  renderer.setRenderTarget(null);
  for (const thing of [target, material, geometry]) thing.dispose();
  const places = new Float32Array(3 * count);
  for (let i = 0; i < count; ++i) places.set(pixels.subarray(4 * i, 4 * i + 3), 3 * i);
  return places;
}
