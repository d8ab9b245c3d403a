// SPDX-License-Identifier: Apache-2.0
// Deformation on the processor, for machines where the processor draws WebGL as well.
//
// There a vertex shader runs about four times a vertex, and each of its reads from a texture takes
// as long as a vertex here: the same map as deform() in deform.ts, once a vertex and frame. And
// what faces away costs as much as half of what is seen. Units: m; frame: world.
import type {Organ} from '../organ';
import type {Hello, Vec3} from '../protocol';

export interface Skin {
  places: Float32Array;   // 3 a vertex
  normals: Float32Array;  // 3 a vertex, outward, of any length
  move: (moved: Int16Array) => void;
  all: Uint32Array;     // corners of all triangles
  facing: Uint32Array;  // and of those that were chosen
  // Chooses those that face the eye; how many corners they have.
  face: (eye: Vec3) => number;
}

export function makeSkin(organ: Organ, hello: Hello): Skin {
  const {vertexVoxel, vertexFraction: fraction, vertexRest: rest, vertexNormal: normal} = organ;
  const [places, normals] = [rest.slice(), normal.slice()];
  const scale = hello.positionUnit / hello.voxelEdge;
  const corners = hello.corners.map((particle) => 4 * particle);
  const g = new Float64Array(9);  // columns of I + dU/dX

  const move = (moved: Int16Array) => {
    for (let i = 0; i < vertexVoxel.length; ++i) {
      const [c, v] = [8 * vertexVoxel[i], 3 * i];
      const [fx, fy, fz] = [fraction[v], fraction[v + 1], fraction[v + 2]];
      for (let k = 0; k < 3; ++k) {
        const d0 = moved[corners[c] + k], x0 = moved[corners[c + 1] + k] - d0;
        const d1 = moved[corners[c + 2] + k], x1 = moved[corners[c + 3] + k] - d1;
        const d2 = moved[corners[c + 4] + k], x2 = moved[corners[c + 5] + k] - d2;
        const d3 = moved[corners[c + 6] + k], x3 = moved[corners[c + 7] + k] - d3;
        const y0 = d0 + fx * x0, y1 = d1 + fx * x1 - y0;
        const y2 = d2 + fx * x2, y3 = d3 + fx * x3 - y2;
        const z0 = y0 + fy * y1, z1 = y2 + fy * y3 - z0;
        const [low, high] = [x0 + fy * (x1 - x0), x2 + fy * (x3 - x2)];
        places[v + k] = rest[v + k] + hello.positionUnit * (z0 + fz * z1);
        g[k] = scale * (low + fz * (high - low));
        g[3 + k] = scale * (y1 + fz * (y3 - y1));
        g[6 + k] = scale * z1;
      }
      g[0] += 1;
      g[4] += 1;
      g[8] += 1;
      const [nx, ny, nz] = [normal[v], normal[v + 1], normal[v + 2]];
      for (let k = 0; k < 3; ++k) {
        const p = (k + 1) % 3, q = (k + 2) % 3;
        normals[v + k] = nx * (g[3 + p] * g[6 + q] - g[3 + q] * g[6 + p]) +
            ny * (g[6 + p] * g[q] - g[6 + q] * g[p]) + nz * (g[p] * g[3 + q] - g[q] * g[3 + p]);
      }
    }
  };

  const {triangles} = organ;
  const facing = triangles.slice();
  const face = (eye: Vec3) => {
    let count = 0;
    for (let t = 0; t < triangles.length; t += 3) {
      const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
      const x = places[a], y = places[a + 1], z = places[a + 2];
      const ux = places[b] - x, uy = places[b + 1] - y, uz = places[b + 2] - z;
      const vx = places[c] - x, vy = places[c + 1] - y, vz = places[c + 2] - z;
      const toward = (uy * vz - uz * vy) * (eye.x - x) + (uz * vx - ux * vz) * (eye.y - y) +
          (ux * vy - uy * vx) * (eye.z - z);
      if (toward <= 0) continue;
      facing[count++] = triangles[t];
      facing[count++] = triangles[t + 1];
      facing[count++] = triangles[t + 2];
    }
    return count;
  };
  return {places, normals, move, all: triangles, facing, face};
}
