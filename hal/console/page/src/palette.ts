// SPDX-License-Identifier: Apache-2.0
// Colours that people with any colour vision tell apart.
//
// Those of figures, with a dash each so that colour is never the only sign, are in hal/palette.csv;
// materials from Tol's muted scheme (2021).
import {kFigureStrokes} from '../generated/palette';

import type {Cause} from './protocol';

export interface Stroke {
  colour: string;
  dark: string;  // on a dark ground
  dash: number[];
}

const {total, ...causes} = kFigureStrokes;
export const kCauseStroke: Record<Cause, Stroke> = causes;
export const kTotal: Stroke = total;

export const kMaterials = [
  '#cc6677',
  '#ddcc77',
  '#88ccee',
  '#44aa99',
  '#999933',
  '#aa4499',
  '#117733',
  '#332288',
  '#882255',
];

// What a tissue has in every organ, as long as no other there has it; tissues as in
// offline/src/asset/materials.cpp. Tissues that lie beside each other have one of the first six
// each.
const kUsual: Record<string, number> = {
  liver: 8,
  kidney: 0,
  spleen: 0,
  pancreas: 0,
  stomach: 0,
  prostate: 0,
  gel: 0,
  fat: 1,
  epidural_fat: 4,
  skin: 2,
  liver_capsule: 0,
  prostate_capsule: 3,
  fascia: 3,
  ligamentum_flavum: 3,
  tumour: 4,
  muscle: 5,
  vessel: 6,
  ligament: 0,
  bone: 2,
};

// The same colour, nearer to white or to black: share from 0 to 1.
function mixed(colour: string, with255: number, share: number): string {
  const parts = [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16));
  const out = parts.map((part) => Math.round(part + share * (with255 - part)));
  return `#${out.map((part) => part.toString(16).padStart(2, '0')).join('')}`;
}

// More tissues than Tol's scheme has colours: the same again, lighter, then darker.
const kManyMaterials = [
  ...kMaterials,
  ...kMaterials.map((colour) => mixed(colour, 255, 0.55)),
  ...kMaterials.map((colour) => mixed(colour, 0, 0.45)),
];

// A colour for each material of an organ, no two the same among the first 27.
export function materialColours(names: string[]): string[] {
  const taken = new Set<number>();
  const own = names.map((name) => {
    const wish = kUsual[name];
    if (wish === undefined || taken.has(wish)) return -1;
    taken.add(wish);
    return wish;
  });
  const free = kManyMaterials.map((_, i) => i).filter((i) => !taken.has(i));
  let next = 0;
  return own.map(
      (at, i) => kManyMaterials[at >= 0 ? at : free[next++] ?? i % kManyMaterials.length]);
}

// Of the bodies in the 3D view, the same on light and dark ground.
export const kBody = {
  needle: '#a9b4c2',
  handle: '#6f7b8a',
  lattice: '#b3261e',
  particle: '#2fa84f',
  goal: '#f0e442',
  obstacle: '#9aa3ad',
  target: '#0072b2',
  forbidden: '#d55e00',
  force: '#e69f00',
  inside: '#7c3b47',
};

export const kLateral: Stroke = {
  colour: '#6b7785',
  dark: '#93a0ae',
  dash: [5, 3]
};
export const kFirstAttempt: Stroke = {
  colour: '#0072b2',
  dark: '#56b4e9',
  dash: []
};
export const kSecondAttempt: Stroke = {
  colour: '#c24e00',
  dark: '#ff8c42',
  dash: [7, 3]
};

const kStrokes = [kTotal, kLateral, kFirstAttempt, kSecondAttempt, ...Object.values(kCauseStroke)];

export const screenColour = (stroke: Stroke, dark: boolean): string =>
    dark ? stroke.dark : stroke.colour;

// The same stroke's colour on white paper.
export const paperColour = (screen: string): string =>
    kStrokes.find((stroke) => stroke.dark === screen)?.colour ?? screen;
