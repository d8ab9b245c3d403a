// SPDX-License-Identifier: Apache-2.0
// A figure on the screen (uPlot), with its legend, cursor and ways to save it.
//
// Curves may go back and forth in x (force against depth), so uPlot's mode of free points is used
// for all. Keys: arrows move the cursor, where the plot has one that can be moved.
import 'uplot/dist/uPlot.min.css';

import uPlot from 'uplot';

import {button, el, prefersDark, save, say} from './dom';

import {
  csv,
  figureCanvas,
  figureSvg,
  rangeOf,
  ticksOf,
  xRangeOf,
  type Curve,
  type Figure,
} from './figure';
import {paperColour} from './palette';
import {exactText} from './series';
import {texts} from './texts';

export interface Numbers {
  head: string[];
  columns: ArrayLike<number>[];
}
interface PlotOptions {
  name: string;  // of saved files
  height: number;
  numbers: () => Numbers;                    // for the CSV: all of it, not only what is drawn
  seek?: (x: number, now: boolean) => void;  // the user moved the cursor there
  step?: (direction: number) => void;        // ... by a key
  zoom?: (range: [number, number]|null) => void;
}

const ink = () => (prefersDark() ? '#c3ccd6' : '#43505e');
const grid = () => (prefersDark() ? '#2b343e' : '#e2e7ed');
const shade = (i: number) =>
    (prefersDark() ? ['#1c232b', '#222a33'] : ['#f4f6f9', '#eaeef3'])[i % 2];

function lines(u: uPlot, index: number): uPlot.Series.Paths|null {
  const path = new Path2D();
  uPlot.orient(u, index, (_s, xs, ys, sx, sy, toX, toY, left, top, width, height) => {
    const [dx, dy] = [xs as number[], ys as unknown as number[]];
    for (let i = 0; i < dx.length; ++i) {
      path.lineTo(toX(dx[i], sx, width, left), toY(dy[i], sy, height, top));
    }
    return null;
  });
  return {stroke: path} as uPlot.Series.Paths;
}

export class Plot {
  readonly root: HTMLElement;
  private readonly place = el('div', {class: 'plot-place'});
  private readonly legend = el('ul', {class: 'legend', 'aria-label': texts.plots.legend});
  private readonly summary = el('p', {class: 'quiet-text'});
  private u: uPlot|null = null;
  private figure: Figure|null = null;
  private shape = '';
  private cursor: number|null = null;
  private range: [number, number]|null = null;

  constructor(private readonly options: PlotOptions) {
    const {png, svg, csv: numbers} = texts.plots;
    const tools = el(
        'div',
        {class: 'plot-tools'},
        button(png, () => this.savePng(), {'aria-label': texts.plots.exportLabel(png)}),
        button(svg, () => this.saveSvg(), {'aria-label': texts.plots.exportLabel(svg)}),
        button(numbers, () => this.saveCsv(), {'aria-label': texts.plots.exportLabel(numbers)}),
    );
    this.root =
        el('div', {class: 'plot'}, this.place, el('div', {class: 'plot-foot'}, this.legend, tools),
           this.summary);
    this.listen();
    new ResizeObserver(() => this.fit()).observe(this.place);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
      this.shape = '';
      if (this.figure !== null) this.show(this.figure);
    });
  }

  get visible(): boolean { return this.place.offsetParent !== null; }

  show(figure: Figure): void {
    this.figure = figure;
    if (!this.visible) return;
    const shape = figure.curves.map((c) => c.name + c.colour).join() + figure.xLabel;
    const data = [null, ...figure.curves.map((c) => [c.xs, c.ys])] as unknown as uPlot.AlignedData;
    if (this.u === null || shape !== this.shape) {
      this.shape = shape;
      this.u?.destroy();
      this.u = new uPlot(this.uplotOptions(figure), data, this.place);
      this.drawLegend(figure.curves);
    } else {
      this.u.setData(data);
    }
    const peak = Math.max(0, ...figure.curves.slice(0, 1).map((c) => largest(c.ys)));
    const words = texts.plots.description(figure.title, figure.curves[0]?.xs.length ?? 0, peak);
    say(this.summary, this.options.step ? `${words} ${texts.plots.keyboard}` : words);
  }

  setCursor(x: number|null): void {
    if (this.cursor === x) return;
    this.cursor = x;
    if (this.visible) this.u?.redraw(false);
  }

  setRange(range: [number, number]|null): void {
    this.range = range;
    if (this.figure !== null) this.show(this.figure);
  }

  private uplotOptions(figure: Figure): uPlot.Options {
    const axis = (label: string, size: number): uPlot.Axis => ({
      label,
      labelSize: 18,
      size,
      font: '11px system-ui, sans-serif',
      labelFont: '12px system-ui, sans-serif',
      stroke: ink,
      grid: {stroke: grid, width: 1},
      ticks: {stroke: grid, width: 1, size: 4},
      gap: 3,
      splits: (_u, _i, low, high) => ticksOf(low, high, label === figure.xLabel ? 6 : 5),
      values: (_u, splits) => splits.map(String),
    });
    const curve = (c: Curve): uPlot.Series => ({
      label: c.name,
      stroke: c.colour,
      width: c.width,
      dash: c.dash,
      paths: lines,
      facets: [
        {scale: 'x', auto: true},
        {scale: 'y', auto: true},
      ],
    });
    return {
      mode: 2,
      width: Math.max(120, this.place.clientWidth),
      height: this.options.height,
      legend: {show: false},
      padding: [8, 10, 0, 0],
      cursor: {show: false},
      scales: {
        x: {time: false, range: () => this.range ?? xRangeOf(this.now())},
        y: {range: () => rangeOf(this.now().curves.map((c) => c.ys))},
      },
      axes: [axis(figure.xLabel, 30), axis(figure.yLabel, 38)],
      series: [{}, ...figure.curves.map(curve)] as uPlot.Series[],
      hooks: {drawClear: [(u) => this.drawBands(u)], draw: [(u) => this.drawMarks(u)]},
    };
  }

  private now(): Figure {
    return this.figure ?? {title: '', xLabel: '', yLabel: '', curves: [], bands: [], marks: []};
  }

  private drawBands(u: uPlot): void {
    const {ctx, bbox} = u;
    const ratio = devicePixelRatio;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    ctx.font = `${10.5 * ratio}px system-ui, sans-serif`;
    ctx.textAlign = 'center';
    this.now().bands.forEach((band, i) => {
      const [from, to] = [u.valToPos(band.from, 'x', true), u.valToPos(band.to, 'x', true)];
      ctx.fillStyle = shade(i);
      ctx.fillRect(from, bbox.top, to - from, bbox.height);
      const middle = (Math.max(from, bbox.left) + Math.min(to, bbox.left + bbox.width)) / 2;
      if (to - from < (ctx.measureText(band.label).width + 8 * ratio)) return;
      ctx.fillStyle = ink();
      ctx.fillText(band.label, middle, bbox.top + bbox.height - 5 * ratio);
    });
    ctx.restore();
  }

  private drawMarks(u: uPlot): void {
    const {ctx, bbox} = u;
    const ratio = devicePixelRatio;
    const upright = (x: number, colour: string, dash: number[], width: number) => {
      ctx.strokeStyle = colour;
      ctx.lineWidth = width * ratio;
      ctx.setLineDash(dash.map((d) => d * ratio));
      ctx.beginPath();
      ctx.moveTo(x, bbox.top);
      ctx.lineTo(x, bbox.top + bbox.height);
      ctx.stroke();
    };
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    ctx.font = `${10.5 * ratio}px system-ui, sans-serif`;
    ctx.textAlign = 'left';
    let free = [-Infinity, -Infinity];  // right end of the last label of each of two lines
    for (const mark of this.now().marks) {
      const x = u.valToPos(mark.x, 'x', true);
      upright(x, ink(), mark.strong ? [] : [2, 3], 1);
      const line = free.findIndex((end) => end < x);
      if (line < 0) continue;
      ctx.fillStyle = ink();
      ctx.fillText(mark.label, x + 3 * ratio, bbox.top + (11 + 13 * line) * ratio);
      free = free.map(
          (end, i) => (i === line ? x + ctx.measureText(mark.label).width + 8 * ratio : end));
    }
    if (this.cursor !== null) {
      upright(u.valToPos(this.cursor, 'x', true), prefersDark() ? '#ffffff' : '#101820', [], 1.5);
    }
    ctx.restore();
  }

  private drawLegend(curves: Curve[]): void {
    this.legend.replaceChildren(
        ...curves.map((c) => {
          const swatch = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
          const line = document.createElementNS('http://www.w3.org/2000/svg', 'line');
          const set = (of: Element, values: Record<string, string>) =>
              Object.entries(values).forEach(([name, value]) => of.setAttribute(name, value));
          set(swatch, {viewBox: '0 0 24 8', class: 'swatch', 'aria-hidden': 'true'});
          set(line, {x1: '0', x2: '24', y1: '4', y2: '4', stroke: c.colour});
          set(line, {'stroke-width': String(c.width), 'stroke-dasharray': c.dash.join(' ')});
          swatch.append(line);
          return el('li', {}, swatch, c.name);
        }),
    );
  }

  private fit(): void {
    const width = this.place.clientWidth;
    if (width === 0) return;
    if (this.u === null || this.shape === '') {
      if (this.figure !== null) this.show(this.figure);
    } else if (Math.abs(this.u.width - width) > 1) {
      this.u.setSize({width, height: this.options.height});
    }
  }

  private xAt(event: MouseEvent): number|null {
    if (this.u === null) return null;
    return this.u.posToVal(event.clientX - this.u.over.getBoundingClientRect().left, 'x');
  }

  private listen(): void {
    const {seek, step, zoom} = this.options;
    if (step !== undefined) {
      this.place.tabIndex = 0;
      this.place.setAttribute('role', 'group');
      this.place.addEventListener('keydown', (event) => {
        const direction = {ArrowLeft: -1, ArrowRight: 1, PageDown: -50, PageUp: 50}[event.key];
        if (direction === undefined) return;
        event.preventDefault();
        step(direction);
      });
    }
    if (seek !== undefined) {
      const go = (event: PointerEvent, now: boolean) => {
        const x = this.xAt(event);
        if (x !== null) seek(x, now);
      };
      this.place.addEventListener('pointerdown', (event) => {
        this.place.setPointerCapture(event.pointerId);
        go(event, true);
      });
      this.place.addEventListener(
          'pointermove', (event) => event.buttons === 1 && go(event, false));
      this.place.addEventListener('pointerup', (event) => go(event, true));
    }
    if (zoom === undefined) return;
    this.place.addEventListener('dblclick', () => zoom(null));
    this.place.addEventListener(
        'wheel',
        (event) => {
          const x = this.xAt(event);
          if (x === null || !event.ctrlKey) return;
          event.preventDefault();
          const [low, high] = this.range ?? xRangeOf(this.now());
          const factor = event.deltaY < 0 ? 0.7 : 1.4;
          zoom([x - (x - low) * factor, x + (high - x) * factor]);
        },
        {passive: false},
    );
  }

  private savePng(): void {
    if (this.figure === null) return;
    figureCanvas(this.printed()).toBlob((blob) => {
      if (blob !== null) save(`${this.options.name}.png`, 'image/png', blob);
    });
  }

  private saveSvg(): void {
    if (this.figure !== null)
      save(`${this.options.name}.svg`, 'image/svg+xml', figureSvg(this.printed()));
  }

  private saveCsv(): void {
    const {head, columns} = this.options.numbers();
    save(`${this.options.name}.csv`, 'text/csv', csv(head, columns, exactText));
  }

  // Colours of the dark screen are too light for paper.
  private printed(): Figure {
    const figure = this.now();
    return {...figure, curves: figure.curves.map((c) => ({...c, colour: paperColour(c.colour)}))};
  }
}

const largest = (values: number[]): number => values.reduce((a, b) => Math.max(a, Math.abs(b)), 0);
