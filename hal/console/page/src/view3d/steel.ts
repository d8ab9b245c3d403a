// SPDX-License-Identifier: Apache-2.0
// Steel: a mirror of a studio that is computed, with a mark at every centimetre from the tip.
//
// The studio hangs on the camera: dark floor, bright ceiling, one long lamp. So a needle has a
// bright line along it wherever one looks from, and shows where it bends. Lit once a pixel: a
// needle has few. Attribute `along`: m from the tip; without it (a define less) there are no marks.
import * as THREE from 'three';

const kVertex = /* glsl */ `
precision highp float;
in vec3 position;
in vec3 normal;
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
uniform mat3 normalMatrix;
out vec3 vNormal;
out vec3 vView;
#ifdef MARKED
in float along;
out float vCentimetres;
#endif
void main() {
  vec4 view = modelViewMatrix * vec4(position, 1.0);
  vNormal = normalMatrix * normal;
  vView = view.xyz;
#ifdef MARKED
  vCentimetres = 100.0 * along;
#endif
  gl_Position = projectionMatrix * view;
}`;

const kFragment = /* glsl */ `
precision highp float;
in vec3 vNormal;
in vec3 vView;
uniform vec3 ink;
out vec4 colour;
#ifdef MARKED
in float vCentimetres;
#endif

float studio(vec3 way) {
  float ceiling = smoothstep(-0.3, 1.0, way.y);
  float lamp = exp(-40.0 * (way.y - 0.5) * (way.y - 0.5));
  return 0.30 + 0.45 * ceiling + 0.70 * lamp;
}

void main() {
  vec3 n = normalize(vNormal);
  vec3 eye = normalize(vView);
  float rim = 1.0 - abs(dot(n, eye));
  float light = studio(reflect(eye, n)) + 0.25 * rim * rim * rim;
  colour = vec4(ink * light, 1.0);
#ifdef MARKED
  float off = abs(fract(vCentimetres + 0.5) - 0.5);
  float soft = 0.5 * fwidth(vCentimetres);
  float fifth = step(abs(fract(0.2 * vCentimetres + 0.5) - 0.5), 0.05);
  float mark = 1.0 - smoothstep(-soft, soft, off - mix(0.035, 0.08, fifth));
  colour.rgb *= 1.0 - 0.72 * mark * step(0.5, vCentimetres);
#endif
}`;

export function steel(colour: string, marked: boolean): THREE.RawShaderMaterial {
  return new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3,
    vertexShader: kVertex,
    fragmentShader: kFragment,
    defines: marked ? {MARKED: 1} : {},
    uniforms: {ink: {value: new THREE.Color(colour)}},
  });
}
