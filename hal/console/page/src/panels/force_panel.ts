// SPDX-License-Identifier: Apache-2.0
// The force now, or at the cursor of a recording: a gauge, and numbers that can be read; exactly as
// it came each is told by the pointer that rests on it.
import {el, field, panel, say} from '../dom';
import {kCauseStroke} from '../palette';
import {kCauses, kNoLayer, type NeedleFrame, type Vec3} from '../protocol';
import {exactText} from '../series';
import type {Store} from '../store';
import {texts} from '../texts';

const kDigits = 3;  // of newtons: mN

const size = (v: Vec3): number => Math.hypot(v.x, v.y, v.z);

export class ForcePanel {
  readonly root: HTMLElement;
  private readonly big = el('output', {class: 'big'});
  private readonly bar = el('div', {class: 'bar-fill'});
  private readonly meter =
      el('div', {class: 'bar', role: 'meter', 'aria-label': texts.force.onHand}, this.bar);
  private readonly facts = el('dl', {class: 'facts'});
  private readonly causes = el('ul', {class: 'causes'});
  private readonly fault = el('p', {class: 'fault', role: 'alert', hidden: true});
  private readonly choice = el('select');
  private readonly choiceField = field(texts.force.needle, this.choice);
  private readonly cells = new Map<string, HTMLElement>();

  constructor(private readonly store: Store) {
    const exact = el('dl', {class: 'facts exact', 'data-in': 'teacher engineer'});
    this.addFacts(this.facts, ['depth', 'phase', 'layer']);
    this.addFacts(exact, ['tick', 'time', 'vector', 'axial', 'lateral']);
    for (const cause of kCauses) this.causes.append(this.causeBar(cause));
    this.causes.dataset.in = 'engineer';
    this.root = panel(
        'force',
        texts.force.heading,
        'trainee teacher engineer',
        this.choiceField,
        el('div', {class: 'gauge'}, this.big, this.meter),
        this.fault,
        this.facts,
        this.causes,
        exact,
    );
    this.choice.addEventListener('change', () => {
      store.needle = Number(this.choice.value);
      store.tell('needle');
    });
    store.on(['hello'], () => this.begin());
    store.on(['frame', 'needle', 'rows', 'organ'], () => this.show());
  }

  private addFacts(
      list: HTMLElement,
      names: ('depth'|'phase'|'layer'|'tick'|'time'|'vector'|'axial'|'lateral')[]): void {
    for (const name of names) {
      const cell = el('dd', {'data-value': name});
      this.cells.set(name, cell);
      list.append(el('div', {}, el('dt', {}, texts.force[name]), cell));
    }
  }

  private causeBar(cause: (typeof kCauses)[number]): HTMLElement {
    const value = el('span', {class: 'cause-value'});
    const fill = el('span', {class: 'cause-fill'});
    fill.style.setProperty('--light', kCauseStroke[cause].colour);
    fill.style.setProperty('--dark', kCauseStroke[cause].dark);
    this.cells.set(cause, value);
    this.cells.set(`${cause}-fill`, fill);
    return el(
        'li', {}, el('span', {}, texts.force.causes[cause]), el('span', {class: 'cause-bar'}, fill),
        value);
  }

  private begin(): void {
    const needles = this.store.hello?.needles ?? [];
    this.choice.replaceChildren(
        ...needles.map((_, i) => el('option', {value: i}, texts.force.needleNumber(i))),
    );
    this.choice.value = String(this.store.needle);
    this.choiceField.hidden = needles.length < 2;
  }

  private show(): void {
    const {frame, hello, needle} = this.store;
    const of = frame?.needles[needle];
    const info = hello?.needles[needle];
    if (!frame || !of || !info) return;
    const most = info.maxForce > 0 ? info.maxForce : 10;
    const force = size(of.force);
    say(this.big, texts.units.n(force));
    const share = Math.min(1, force / most);
    this.bar.style.transform = `scaleX(${share.toFixed(4)})`;
    this.meter.dataset.level = share > 0.9 ? 'high' : share > 0.6 ? 'raised' : 'low';
    this.meter.setAttribute('aria-valuemin', '0');
    this.meter.setAttribute('aria-valuemax', most.toFixed(1));
    this.meter.setAttribute('aria-valuenow', force.toFixed(2));
    this.meter.setAttribute('aria-valuetext', texts.force.gauge(force, most));
    say(this.fault, of.fault === '' ? '' : texts.force.fault(of.fault));
    this.fault.hidden = of.fault === '';
    this.showFacts(of, most);
  }

  private put(name: string, text: string): void {
    const cell = this.cells.get(name);
    if (cell) say(cell, text);
  }

  private tellExactly(name: string, text: string): void {
    const cell = this.cells.get(name);
    if (cell && cell.title !== text) cell.title = text;
  }

  private showFacts(of: NeedleFrame, most: number): void {
    const {frame, hello, needle} = this.store;
    const axis = hello?.needles[needle]?.direction;
    if (!frame || !axis) return;
    this.put('depth', texts.units.mm(of.depth));
    this.put('phase', texts.force.phases[of.phase] ?? '');
    this.put('layer', of.layer === kNoLayer ? texts.force.outside : this.store.layerName(of.layer));
    this.put('tick', String(frame.tick));
    this.put('time', texts.units.s(this.store.seconds(frame.tick), 3));
    const {x, y, z} = of.force;
    this.put('vector', `${[x, y, z].map((v) => v.toFixed(kDigits)).join(', ')} N`);
    this.tellExactly('vector', `${[x, y, z].map(exactText).join(', ')} N`);
    const along = (v: Vec3) => v.x * axis.x + v.y * axis.y + v.z * axis.z;
    const row = this.store.rows.near(frame.tick);
    const known = row !== null && row.tick === frame.tick;
    this.put('axial', texts.units.n(known ? row.force : -along(of.force), kDigits));
    this.tellExactly('axial', known ? `${exactText(row.force)} N` : '');
    this.put('lateral', known ? texts.units.n(row.lateral, kDigits) : texts.scores.dash);
    this.tellExactly('lateral', known ? `${exactText(row.lateral)} N` : '');
    for (const cause of kCauses) {
      const value = size(of.causes[cause]);
      this.put(cause, texts.units.n(value));
      const fill = this.cells.get(`${cause}-fill`);
      if (fill) fill.style.transform = `scaleX(${Math.min(1, value / most).toFixed(4)})`;
    }
  }
}
