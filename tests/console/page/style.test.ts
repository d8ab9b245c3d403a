// SPDX-License-Identifier: Apache-2.0
// What can be seen in the sources: contrast, colours for any colour vision, no markup from strings,
// all words in one file.
//
// Sources: contrast ratio, WCAG 2.2; simulated colour vision, Machado, Oliveira and Fernandes 2009,
// severity 1; difference of colours, CIE 1976.
import assert from 'node:assert/strict';
import {readdirSync, readFileSync} from 'node:fs';
import {join} from 'node:path';
import {test} from 'node:test';

import {
  kCauseStroke,
  kFirstAttempt,
  kLateral,
  kMaterials,
  kSecondAttempt,
  kTotal,
  materialColours
} from '../../../hal/console/page/src/palette';

const css = readFileSync(join(kPage, 'src/app.css'), 'utf8');

function variables(block: string): Record<string, string> {
  return Object.fromEntries(
      [...block.matchAll(/--([\w-]+): (#[0-9a-f]{6});/g)].map((m) => [m[1], m[2]]));
}
const light = variables(css.slice(0, css.indexOf('@media')));
const dark = {
  ...light,
  ...variables(css.slice(css.indexOf('@media'), css.indexOf('* {')))
};
const kSchemes = {
  light,
  dark
};

const linear = (hex: string): number[] => [1, 3, 5].map((at) => {
  const v = parseInt(hex.slice(at, at + 2), 16) / 255;
  return v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
});
const luminance = ([r, g, b]: number[]): number => 0.2126 * r + 0.7152 * g + 0.0722 * b;

function contrast(a: string, b: string): number {
  const [high, low] = [a, b].map((c) => luminance(linear(c))).sort((x, y) => y - x);
  return (high + 0.05) / (low + 0.05);
}

test('the measure itself: black on white is 21, white on white 1', () => {
  assert.ok(Math.abs(contrast('#000000', '#ffffff') - 21) < 1e-9);
  assert.equal(contrast('#ffffff', '#ffffff'), 1);
});

test('every ink on every ground it stands on has a contrast of 4.5, edges of 3', () => {
  const inks = [
    ['ink', 'ground'],
    ['ink', 'panel'],
    ['ink', 'sunk'],
    ['ink', 'scene-top'],
    ['ink', 'scene-bottom'],
    ['ink-quiet', 'panel'],
    ['ink-quiet', 'ground'],
    ['ink-quiet', 'scene-top'],
    ['ink-quiet', 'sunk'],
    ['accent', 'panel'],
    ['accent-ink', 'accent'],
    ['accent-soft-ink', 'accent-soft'],
    ['warn-ink', 'warn'],
  ];
  const edges = [
    ['edge', 'panel'], ['edge', 'ground'], ['accent', 'ground'], ['good', 'panel'],
    ['warn', 'panel'], ['gauge', 'panel']
  ];
  for (const [scheme, colours] of Object.entries(kSchemes)) {
    for (const [pairs, least] of [[inks, 4.5], [edges, 3]] as const) {
      for (const [a, b] of pairs) {
        const ratio = contrast(colours[a], colours[b]);
        assert.ok(ratio >= least, `${scheme}: ${a} on ${b}: ${ratio.toFixed(2)}, least ${least}`);
      }
    }
  }
});

test('every curve can be seen on its ground, and is told from others by its dash, too', () => {
  const strokes = [...Object.values(kCauseStroke), kTotal, kLateral, kFirstAttempt, kSecondAttempt];
  for (const stroke of strokes) {
    assert.ok(contrast(stroke.colour, light.panel) >= 3, stroke.colour);
    assert.ok(contrast(stroke.dark, dark.panel) >= 3, stroke.dark);
  }
  const dashes = Object.values(kCauseStroke).map((stroke) => stroke.dash.join());
  assert.equal(new Set(dashes).size, dashes.length);
});

const kVision: Record<string, number[][]> = {
  all: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  protan: [
    [0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216],
    [-0.003882, -0.048116, 1.051998]
  ],
  deutan: [
    [0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.01182, 0.04294, 0.968881]
  ],
  tritan: [
    [1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.3039]
  ],
};

function lab(rgb: number[]): number[] {
  const xyz = [
    [0.4124, 0.3576, 0.1805],
    [0.2126, 0.7152, 0.0722],
    [0.0193, 0.1192, 0.9505],
  ].map((row) => row.reduce((sum, f, i) => sum + f * rgb[i], 0));
  const [x, y, z] = xyz.map((v, i) => {
    const t = v / [0.9505, 1, 1.089][i];
    return t > 216 / 24389 ? Math.cbrt(t) : (t * (24389 / 27) + 16) / 116;
  });
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

function seen(hex: string, vision: number[][]): number[] {
  const rgb = linear(hex);
  const turned = vision.map((row) => row.reduce((sum, f, i) => sum + f * rgb[i], 0));
  return lab(turned.map((v) => Math.min(1, Math.max(0, v))));
}

// Differences of 10 and more are seen at a glance; 2.3 is the least that is seen at all.
const kGlance = 10;
test('materials and causes differ at a glance for every colour vision', () => {
  const sets = {
    materials: kMaterials.slice(0, 6),
    causes: Object.values(kCauseStroke).map((s) => s.colour),
    dark: Object.values(kCauseStroke).map((s) => s.dark),
    attempts: [kFirstAttempt.colour, kSecondAttempt.colour],
  };
  for (const [name, colours] of Object.entries(sets)) {
    for (const [kind, vision] of Object.entries(kVision)) {
      colours.forEach((a, i) => colours.slice(i + 1).forEach((b) => {
        const [p, q] = [seen(a, vision), seen(b, vision)];
        const apart = Math.hypot(...p.map((v, k) => v - q[k]));
        assert.ok(
            apart >= kGlance, `${name}, ${kind}: ${a} and ${b} differ by ${apart.toFixed(1)}`);
      }));
    }
  }
});

test('a tissue has its colour in every organ, and neighbours differ at a glance', () => {
  const neighbours = [
    ['skin', 'fat', 'muscle', 'liver_capsule', 'liver', 'tumour'],
    ['muscle', 'fascia', 'fat', 'prostate', 'tumour'],
    ['skin', 'fat', 'ligament', 'ligamentum_flavum', 'epidural_fat'],
    ['liver', 'tumour'],
    ['gel'],
  ];
  const colourOf = new Map<string, string>();
  for (const names of neighbours) {
    const colours = materialColours(names);
    assert.equal(new Set(colours).size, names.length);
    const turned = materialColours([...names].reverse()).reverse();
    for (const [i, name] of names.entries()) {
      assert.equal(turned[i], colours[i], name);
      assert.equal(colourOf.get(name) ?? colours[i], colours[i], name);
      colourOf.set(name, colours[i]);
    }
    for (const vision of Object.values(kVision)) {
      colours.forEach((a, i) => colours.slice(i + 1).forEach((b) => {
        const [p, q] = [seen(a, vision), seen(b, vision)];
        assert.ok(Math.hypot(...p.map((v, k) => v - q[k])) >= kGlance, `${names}: ${a}, ${b}`);
      }));
    }
  }
  const strangers = Array.from({length: 12}, (_, i) => `tissue ${i}`);
  assert.equal(new Set(materialColours(strangers)).size, strangers.length);
});

function sources(folder: string): [string, string][] {
  return readdirSync(folder, {withFileTypes: true}).flatMap((entry): [string, string][] => {
    const path = join(folder, entry.name);
    return entry.isDirectory() ? sources(path) : [[path, readFileSync(path, 'utf8')]];
  });
}

test('nothing turns a string into markup or code', () => {
  const banned =
      /innerHTML|outerHTML|insertAdjacentHTML|document\.write|DOMParser|\beval\(|new Function/;
  for (const [path, text] of sources(join(kPage, 'src'))) {
    assert.ok(!banned.test(text), `${path}: ${banned.exec(text)?.[0]}`);
  }
});

test('words a user reads are in texts.ts', () => {
  for (const [path, text] of sources(join(kPage, 'src'))) {
    if (path.endsWith('texts.ts') || !path.endsWith('.ts')) continue;
    const code = text.replace(/\/\/.*$/gm, '');
    const found = [
      ...code.matchAll(
          /(?:say|notice|field|button|toggle|panel)\([^'`]{0,40}['`]([A-Z][a-z]+[^'`]*)['`]/g),
      ...code.matchAll(/'(?:aria-label|title|placeholder)': ['`]([A-Za-z]{2}[^'`$]*)['`]/g),
    ];
    assert.deepEqual(found.map((m) => m[1]), [], path);
  }
});
