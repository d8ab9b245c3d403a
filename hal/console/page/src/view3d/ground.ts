// SPDX-License-Identifier: Apache-2.0
// The shade of an organ on a table just below it, so that it lies and does not float. Made once, of
// the organ at rest; seen from above only. Units: m; frame: world.
import * as THREE from 'three';

const kCells = 48;     // of the picture of the shade, each way
const kMargin = 0.35;  // of the organ's extent, around it
const kSoftCells = 3;  // half of what the shade is smeared over, three times
const kDark = 0.3;     // where the organ covers all

// Mean of the cells within kSoftCells, along rows; turned, so that twice is along both ways.
function smeared(cells: Float32Array): Float32Array {
  const out = new Float32Array(cells.length);
  for (let row = 0; row < kCells; ++row) {
    for (let at = 0; at < kCells; ++at) {
      let sum = 0;
      for (let by = -kSoftCells; by <= kSoftCells; ++by) {
        const from = at + by;
        if (from >= 0 && from < kCells) sum += cells[kCells * row + from];
      }
      out[kCells * at + row] = sum / (2 * kSoftCells + 1);
    }
  }
  return out;
}

export function makeGround(rest: Float32Array, up: THREE.Vector3): THREE.Mesh {
  const right = new THREE.Vector3(up.y, up.z, up.x);  // another axis, as up is one
  const away = new THREE.Vector3().crossVectors(up, right);
  const along = (axis: THREE.Vector3, i: number) =>
      axis.x * rest[i] + axis.y * rest[i + 1] + axis.z * rest[i + 2];
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < rest.length; i += 3) {
    [right, away, up].forEach((axis, k) => {
      low[k] = Math.min(low[k], along(axis, i));
      high[k] = Math.max(high[k], along(axis, i));
    });
  }
  const size = (1 + 2 * kMargin) * Math.max(high[0] - low[0], high[1] - low[1], 1e-3);
  const middle = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2];
  let cells: Float32Array = new Float32Array(kCells * kCells);
  for (let i = 0; i < rest.length; i += 3) {
    const [x, y] = [right, away].map(
        (axis, k) => Math.floor(kCells * ((along(axis, i) - middle[k]) / size + 0.5)));
    cells[kCells * y + x] = 1;
  }
  for (let pass = 0; pass < 6; ++pass) cells = smeared(cells);
  const pixels = new Uint8Array(4 * cells.length);
  cells.forEach((covered, i) => (pixels[4 * i + 3] = 255 * kDark * covered));
  const texture = new THREE.DataTexture(pixels, kCells, kCells);
  texture.minFilter = texture.magFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  const material =
      new THREE.MeshBasicMaterial({map: texture, transparent: true, depthWrite: false});
  material.addEventListener('dispose', () => texture.dispose());
  const ground = new THREE.Mesh(new THREE.PlaneGeometry(size, size), material);
  ground.matrixAutoUpdate = false;
  ground.matrix.makeBasis(right, away, up);
  const at = right.clone().multiplyScalar(middle[0]).addScaledVector(away, middle[1]);
  ground.matrix.setPosition(at.addScaledVector(up, low[2]));
  ground.renderOrder = -1;
  return ground;
}
