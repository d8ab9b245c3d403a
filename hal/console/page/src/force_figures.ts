// SPDX-License-Identifier: Apache-2.0
// The figures of force: against time, against depth, by cause, and of two attempts.
//
// Signs as in the paper's Fig. 9: positive along the direction of insertion. Depth is the way of
// the tip beyond the entry, so that the needle outside the tissue is left of zero.
import {prefersDark} from './dom';
import type {Curve, Figure} from './figure';
import {
  kCauseStroke,
  kFirstAttempt,
  kLateral,
  kSecondAttempt,
  kTotal,
  screenColour,
  type Stroke,
} from './palette';
import {Kind, phaseSpans} from './phases';
import {kCauses, type Row, type Score} from './protocol';
import {thin, type Column, type Series} from './series';
import type {Store} from './store';
import {texts} from './texts';

const kBuckets = 500;

function curveOf(name: string, stroke: Stroke, width: number, xs: number[], ys: number[]): Curve {
  return {name, colour: screenColour(stroke, prefersDark()), dash: stroke.dash, width, xs, ys};
}

function columns(
    series: Series, rows: number[], scale: number, x: Column, byCause: boolean): Curve[] {
  const pick = (name: Column, factor = 1) => {
    const values = series.column(name);
    return rows.map((i) => factor * values[i]);
  };
  const xs = pick(x, scale);
  const causes = kCauses.map(
      (cause) => curveOf(texts.force.causes[cause], kCauseStroke[cause], 1.4, xs, pick(cause)),
  );
  return [
    curveOf(byCause ? texts.force.total : texts.force.axial, kTotal, 1.8, xs, pick('force')),
    ...(byCause ? causes : [curveOf(texts.force.lateral, kLateral, 1.2, xs, pick('lateral'))]),
  ];
}

function phaseName(phase: 'contact'|'inserted'|'retracting'): string {
  return texts.force.phases[{contact: 1, inserted: 2, retracting: 3}[phase]];
}

// range: seconds; null: all there is.
export function timeFigure(store: Store, byCause: boolean, range: [number, number]|null): Figure {
  const {rows, period} = store;
  const first = range === null ? 0 : Math.max(0, rows.find(range[0] / period) - 1);
  const last =
      range === null ? rows.length : Math.min(rows.length, rows.find(range[1] / period) + 1);
  const shown = thin(rows.column('force'), first, last, kBuckets);
  const of = store.needle;
  return {
    title: texts.plots.time,
    xLabel: texts.plots.timeAxis,
    yLabel: texts.plots.forceAxis,
    curves: columns(rows, shown, period, 'tick', byCause),
    bands: phaseSpans(store.events, rows, of).map(({phase, from, to}) => ({
                                                    from: store.seconds(from),
                                                    to: store.seconds(to),
                                                    label: phaseName(phase),
                                                  })),
    marks: [
      ...store.events.filter((e) => e.needle === of).map((e) => ({
                                                           x: store.seconds(e.tick),
                                                           label: eventName(
                                                               store, e.eventKind, e.layer),
                                                           strong: false
                                                         })),
      ...store.marks.map((m) => ({x: store.seconds(m.tick), label: m.text, strong: true})),
    ],
  };
}

export function eventName(store: Store, kind: number, layer: number): string {
  const name = texts.plots.events[kind] ?? String(kind);
  const told = kind === Kind.Layer || kind === Kind.Puncture;
  const material = store.layerName(layer);
  return told && material !== '' ? `${name}: ${material}` : name;
}

export function depthFigure(store: Store, byCause: boolean): Figure {
  const {rows} = store;
  const shown = thin(rows.column('force'), 0, rows.length, kBuckets);
  const travel = rows.column('travel');
  const marks =
      store.events.filter((e) => e.needle === store.needle)
          .filter((e) => e.eventKind === Kind.Puncture || e.eventKind === Kind.Layer)
          .flatMap((e) => {
            const row = rows.find(e.tick);
            if (row >= rows.length) return [];
            return [
              {x: 1e3 * travel[row], label: eventName(store, e.eventKind, e.layer), strong: false}
            ];
          });
  return {
    title: texts.plots.depth,
    xLabel: texts.plots.depthAxis,
    yLabel: texts.plots.forceAxis,
    curves: columns(rows, shown, 1e3, 'travel', byCause),
    bands: [],
    marks,
  };
}

const ofScore = (score: Score, stroke: Stroke): Curve => curveOf(
    texts.scores.attempt(score.attempt),
    stroke,
    1.6,
    score.rows.map((r: Row) => 1e3 * r.travel),
    score.rows.map((r: Row) => r.force),
);

export function comparisonFigure(first: Score, second: Score): Figure {
  return {
    title: texts.compare.plot,
    xLabel: texts.plots.depthAxis,
    yLabel: texts.plots.forceAxis,
    curves: [ofScore(first, kFirstAttempt), ofScore(second, kSecondAttempt)],
    bands: [],
    marks: [],
  };
}

// One attempt against time, for the report: dark on white.
export function attemptFigure(score: Score, period: number): Figure {
  const xs = score.rows.map((r) => r.tick * period);
  return {
    title: texts.scores.attempt(score.attempt),
    xLabel: texts.plots.timeAxis,
    yLabel: texts.plots.forceAxis,
    curves: [
      {
        name: texts.force.axial,
        colour: kTotal.colour,
        dash: [],
        width: 1.6,
        xs,
        ys: score.rows.map((r) => r.force)
      },
      {
        name: texts.force.lateral,
        colour: kLateral.colour,
        dash: kLateral.dash,
        width: 1.2,
        xs,
        ys: score.rows.map((r) => r.lateral)
      },
    ],
    bands: [],
    marks: score.punctures.map((p) => ({x: p.tick * period, label: p.layer, strong: false})),
  };
}
