// SPDX-License-Identifier: Apache-2.0
// What there is to push a needle into. Organs come from the build (build.mjs --demo), where
// stylet-organ made them.
import type {Needle, Vec3} from 'stylet-wasm';

import type {Preset} from '../src/view3d/camera';

import gel from './organs/gel.organ?url';
import liver from './organs/liver.organ?url';
import wall from './organs/wall.organ?url';

export interface Scene {
  name: string;
  tells: string;
  organ: string;  // address
  needle: Partial<Needle>;
  // Where it goes in, as shares of the organ's box, and the way.
  at: Vec3;
  direction: Vec3;
  look: Preset;  // from where, at first
  cut: boolean;  // open beside the needle, at first
  xray: boolean;
  roll: number;  // of the needle, rad, at first
}

// Bending stiffness of steel needles by gauge: PHYSICS 6.
const k18G = {
  outer_radius_m: 0.635e-3,
  bending_nm2: 20.7e-3,
  rods: 32
};
// Nitinol, 0.58 mm thick, with a bevelled tip, as in hal/scenes/fig10-steering.toml.
const kBevelled = {
  length_m: 0.15,
  outer_radius_m: 0.29e-3,
  bending_nm2: 0.417e-3,
  rods: 48,
  unit_m: 2.5e-3,
  bevel_per_m: 10
};

export const kScenes: Scene[] = [
  {
    name: 'Liver',
    tells: 'A liver with its capsule, made of 10 702 voxels, and an 18 gauge needle. The capsule ' +
        'is dented until it breaks; after that you feel cutting and friction along the shaft.',
    organ: liver,
    needle: k18G,
    at: [0, 0.5, 0.52],
    direction: [1, 0, 0],
    look: 'oblique',
    cut: false,
    xray: false,
    roll: 0,
  },
  {
    name: 'Abdominal wall',
    tells: 'Skin, fat and muscle over a liver. Each layer feels different: the force falls in ' +
        'fat and rises in muscle.',
    organ: wall,
    needle: k18G,
    at: [0, 0.5, 0.5],
    direction: [1, 0, 0],
    look: 'oblique',
    cut: true,
    xray: false,
    roll: 0,
  },
  {
    name: 'Steering',
    tells:
        'A wire with a bevelled tip, in stiff gel. Its path bends to one side. You steer it by ' +
        'rolling it while it goes in (hold the buttons, or Q and E, or Shift and the wheel).',
    organ: gel,
    needle: kBevelled,
    at: [0, 0.5, 0.5],
    direction: [1, 0, 0],
    look: 'side',
    cut: false,
    xray: true,
    roll: Math.PI / 2,
  },
];
