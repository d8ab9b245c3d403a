// SPDX-License-Identifier: Apache-2.0
// A histogram of times (uPlot): counts on a logarithmic scale, so that the one late tick shows.
import uPlot from 'uplot';

import {el, prefersDark, say} from './dom';
import {ticksOf} from './figure';
import {texts} from './texts';

const kHeight = 110;
const kFewestBins = 20;
const kFloor = 0.6;  // below one count, where bars begin

export class Histogram {
  readonly root: HTMLElement;
  private readonly place = el('div', {class: 'plot-place'});
  private readonly summary = el('p', {class: 'quiet-text'});
  private u: uPlot|null = null;

  constructor(private readonly name: string) {
    this.root = el('div', {class: 'plot'}, this.place, this.summary);
    new ResizeObserver(() => {
      const width = this.place.clientWidth;
      if (this.u !== null && width > 0) this.u.setSize({width, height: kHeight});
    }).observe(this.place);
  }

  show(bins: Uint32Array, binUs: number): void {
    if (this.place.clientWidth === 0) return;
    let last = kFewestBins;
    bins.forEach((count, i) => {
      if (count > 0) last = Math.max(last, i + 1);
    });
    const shown = Array.from(bins.subarray(0, last));
    const xs = shown.map((_, i) => (i + 0.5) * binUs);
    const ys = shown.map((count) => (count > 0 ? count : null));
    const total = shown.reduce((a, b) => a + b, 0);
    const largest = last * binUs;
    say(this.summary,
        `${this.name}: ${total} ${texts.loop.ticksAxis}, < ${largest} ${texts.loop.usAxis}`);
    if (this.u === null)
      this.u = new uPlot(this.options(), [xs, ys], this.place);
    else
      this.u.setData([xs, ys]);
  }

  private options(): uPlot.Options {
    const ink = () => (prefersDark() ? '#c3ccd6' : '#43505e');
    const axis: uPlot.Axis = {
      stroke: ink,
      font: '11px system-ui, sans-serif',
      grid: {show: false},
      ticks: {size: 3, stroke: ink, width: 1},
      gap: 3,
    };
    return {
      width: this.place.clientWidth,
      height: kHeight,
      legend: {show: false},
      cursor: {show: false},
      padding: [6, 10, 0, 0],
      scales: {
        x: {time: false, range: (_u, _low, high) => [0, high]},
        y: {distr: 3, range: (_u, _low, high) => [kFloor, Math.max(10, 2 * high)]},
      },
      axes: [
        {
          ...axis,
          size: 22,
          splits: (_u, _i, low, high) => ticksOf(low, high, 6),
          values: (_u, splits) => splits.map((v) => `${v} ${texts.loop.usAxis}`),
        },
        {
          ...axis,
          size: 44,
          splits: (_u, _i, _low, high) =>
              Array.from({length: Math.floor(Math.log10(high)) + 1}, (_, i) => 10 ** i),
          values: (_u, splits) => splits.map(
              (v) =>
                  (v === null  ? '' :
                       v < 1e4 ? String(v) :
                                 v.toExponential(0))),
        },
      ],
      series: [
        {},
        {
          fill: () => (prefersDark() ? '#56b4e9' : '#0072b2'),
          width: 0,
          points: {show: false},
          paths: uPlot.paths.bars?.({size: [0.9, 40]}),
        },
      ],
    };
  }
}

// uPlot leaves some of a logarithmic axis without a number.
function countText(count: number|null): string {
  if (count === null) return '';
  return count < 1e4 ? String(count) : count.toExponential(0).replace('+', '');
}
