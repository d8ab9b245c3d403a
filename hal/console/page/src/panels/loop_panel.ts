// SPDX-License-Identifier: Apache-2.0
// What the engineer wants to know: how punctual the loop is, what the guard does, and what a
// picture of this page costs.
import {el, panel, say, seldom, table} from '../dom';
import {Histogram} from '../histogram';
import type {Timing} from '../protocol';
import type {Store} from '../store';
import {texts} from '../texts';
import type {View3d} from '../view3d/view3d';

export class LoopPanel {
  readonly root: HTMLElement;
  private readonly counts = el('dl', {class: 'facts'});
  private readonly quantiles = el('div');
  private readonly guard = el('dl', {class: 'facts'});
  private readonly budget = el('dl', {class: 'facts'});
  private readonly ticks = new Histogram(texts.loop.tick);
  private readonly late = new Histogram(texts.loop.late);
  private readonly redraw = seldom(500, () => this.draw());

  constructor(
      private readonly store: Store,
      private readonly view: () => View3d | null,
      private readonly plotMs: () => number,
  ) {
    this.root = panel(
        'loop',
        texts.loop.heading,
        'engineer',
        this.counts,
        el('h3', {}, texts.loop.tick),
        this.ticks.root,
        el('h3', {}, texts.loop.late),
        this.late.root,
        this.quantiles,
        el('h3', {}, texts.loop.guard),
        this.guard,
        el('h3', {}, texts.loop.page),
        this.budget,
    );
    store.on(['frame', 'view'], this.redraw);
  }

  private draw(): void {
    const {frame} = this.store;
    if (frame === null || this.store.view !== 'engineer') return;
    if (frame.timing !== null) this.drawTiming(frame.timing);
    const of = frame.needles[this.store.needle];
    if (of) {
      const named = texts.loop.flagNames.filter((_, i) => ((of.flags >>> i) & 1) === 1);
      if (of.flags >>> 31 === 1) named.push(texts.loop.kernelFault);
      const {x, y, z} = of.command;
      facts(this.guard, [
        [texts.loop.guard, of.guard || texts.scores.dash],
        [texts.loop.command, `${[x, y, z].map((v) => v.toFixed(3)).join(', ')} N`],
        [texts.loop.flags, named.join(', ') || texts.loop.none],
        [texts.loop.particles, String(frame.particles.length)],
      ]);
    }
    const budget = this.view()?.budget;
    if (!budget) return;
    facts(this.budget, [
      ...(['message', 'deform', 'bodies', 'caps', 'face', 'draw'] as const)
          .map(
              (part):
                  [string, string] => [texts.loop.parts[part], texts.loop.ms(budget.median(part))],
              ),
      [texts.loop.parts.plots, texts.loop.ms(this.plotMs())],
    ]);
  }

  private drawTiming(timing: Timing): void {
    const names = texts.loop.counts;
    const count = (name: keyof typeof names) => timing[name].toLocaleString('en');
    facts(
        this.counts,
        (Object.keys(names) as (keyof typeof names)[]).map((name) => [names[name], count(name)]),
    );
    this.ticks.show(timing.tickBins, timing.binUs);
    this.late.show(timing.lateBins, timing.binUs);
    const rows = texts.loop.quantiles.map(
        (name, i) =>
            [name,
             texts.units.us(timing.tickUs[i] ?? 0),
             texts.units.us(timing.lateUs[i] ?? 0),
    ]);
    this.quantiles.replaceChildren(
        table([texts.loop.quantile, texts.loop.tick, texts.loop.late], rows));
  }
}

function facts(list: HTMLElement, rows: [string, string][]): void {
  while (list.children.length > rows.length) list.lastChild?.remove();
  rows.forEach(([name, value], i) => {
    if (!list.children[i]) list.append(el('div', {}, el('dt'), el('dd')));
    const [term, cell] = list.children[i].children;
    say(term, name);
    say(cell, value);
  });
}
