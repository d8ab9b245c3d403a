// SPDX-License-Identifier: Apache-2.0
// The two plots of force: against time, which follows or sets the cursor, and against depth.
import {el, panel, seldom, setOn, toggle} from '../dom';
import type {Figure} from '../figure';
import {depthFigure, timeFigure} from '../force_figures';
import {Plot, type Numbers} from '../plot';
import {ask} from '../protocol';
import {kColumns} from '../series';
import type {Store} from '../store';
import {texts} from '../texts';

const kRedrawMs = 150;
const kWindowSeconds = 20;
const kAskedPoints = 2000;

export class PlotPanels {
  readonly root: HTMLElement;
  drawMs = 0;  // of the last drawing of both, for the budget
  private readonly time: Plot;
  private readonly depth: Plot;
  private readonly causeSwitch: HTMLButtonElement;
  private readonly windowSwitch: HTMLButtonElement;
  private byCause = false;
  private recent = false;
  private zoomed: [number, number]|null = null;
  private readonly redraw = seldom(kRedrawMs, () => this.draw());

  constructor(
      private readonly store: Store,
      private readonly send: (bytes: Uint8Array) => void,
      seek: (tick: number) => void,
  ) {
    const numbers = (): Numbers => ({
      head: ['tick', 'time_s', ...kNames],
      columns: [
        store.rows.column('tick'),
        store.rows.column('tick').map((t) => Number((t * store.period).toPrecision(9))),
        ...kColumns.slice(1).map((c) => store.rows.column(c)),
      ],
    });
    this.time = new Plot({
      name: 'force-time',
      height: 176,
      numbers,
      seek: (x) => store.playback && seek(x / store.period),
      step: (direction) => store.playback && seek((store.frame?.tick ?? 0) + 20 * direction),
      zoom: (range) => this.zoom(range),
    });
    this.depth = new Plot({name: 'force-depth', height: 176, numbers});
    this.causeSwitch = toggle(texts.plots.byCause, (on) => {
      this.byCause = on;
      this.redraw();
    });
    this.windowSwitch = toggle(texts.plots.window, (on) => {
      this.recent = on;
      this.redraw();
    });
    this.root = panel(
        'plots',
        texts.plots.time,
        'teacher engineer',
        el('div', {class: 'panel-tools'}, this.causeSwitch, this.windowSwitch),
        this.time.root,
        el('h2', {}, texts.plots.depth),
        this.depth.root,
    );
    store.on(['rows', 'needle', 'organ'], this.redraw);
    store.on(['frame'], () => this.follow());
    store.on(['hello'], () => this.begin());
    store.on(['view'], () => {
      setOn(this.causeSwitch, store.view === 'engineer', (on) => (this.byCause = on));
      this.redraw();
    });
  }

  private begin(): void {
    this.zoomed = null;
    this.windowSwitch.hidden = this.store.playback;
    if (this.store.playback) this.askRows(0, this.store.hello?.recordingTicks ?? 0);
    this.redraw();
  }

  private askRows(first: number, last: number): void {
    this.send(ask.rows(Math.max(0, Math.floor(first)), Math.ceil(last), kAskedPoints));
  }

  private zoom(range: [number, number]|null): void {
    const end = this.store.seconds(this.store.hello?.recordingTicks ?? 0);
    this.zoomed = range;
    if (range !== null && this.store.playback) {
      const [from, to] = [Math.max(0, range[0]), Math.min(end, range[1])];
      this.zoomed = [from, to];
      this.askRows(from / this.store.period, to / this.store.period);
    }
    this.redraw();
  }

  private follow(): void {
    const {frame, playback} = this.store;
    if (!playback || frame === null) return;
    this.time.setCursor(this.store.seconds(frame.tick));
    const row = this.store.rows.near(frame.tick);
    this.depth.setCursor(row === null ? null : 1e3 * row.travel);
  }

  private range(): [number, number]|null {
    if (this.zoomed !== null) return this.zoomed;
    const ticks = this.store.rows.column('tick');
    const end = this.store.seconds(ticks[ticks.length - 1] ?? 0);
    return this.recent && !this.store.playback ? [Math.max(0, end - kWindowSeconds), end] : null;
  }

  private draw(): void {
    const began = performance.now();
    const range = this.range();
    const show = (plot: Plot, figure: () => Figure) => plot.visible && plot.show(figure());
    this.time.setRange(range);
    show(this.time, () => timeFigure(this.store, this.byCause, range));
    show(this.depth, () => depthFigure(this.store, this.byCause));
    this.follow();
    this.drawMs = performance.now() - began;
  }
}

const kUnits: Partial<Record<(typeof kColumns)[number], string>> = {
  depth: 'depth_m',
  travel: 'travel_m',
  tickUs: 'tick_us',
  lateUs: 'late_us',
};
const kNames = kColumns.slice(1).map((name) => kUnits[name] ?? `${name}_n`);
