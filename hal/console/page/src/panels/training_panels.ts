// SPDX-License-Identifier: Apache-2.0
// What teaching needs: the teacher's marks, the score card, two attempts beside each other.
import {button, el, field, panel, table} from '../dom';
import {comparisonFigure} from '../force_figures';
import {Plot} from '../plot';
import {ask, type Marked, type Score} from '../protocol';
import type {Store} from '../store';
import {texts} from '../texts';

const kMostMarkText = 120;

export class MarksPanel {
  readonly root: HTMLElement;
  readonly input =
      el('input', {type: 'text', maxlength: kMostMarkText, placeholder: texts.marks.hint});
  private readonly list = el('ol', {class: 'marks-list'});

  constructor(
      private readonly store: Store,
      send: (bytes: Uint8Array) => void,
      private readonly seek: (tick: number) => void,
  ) {
    const form = el(
        'form',
        {class: 'row'},
        field(texts.marks.label, this.input),
        el('button', {type: 'submit'}, texts.marks.add),
    );
    form.addEventListener('submit', (event) => {
      event.preventDefault();
      const words = this.input.value.trim();
      if (words === '') return;
      send(ask.mark(words));
      this.input.value = '';
    });
    this.root = panel('marks', texts.marks.heading, 'teacher', form, this.list);
    store.on(['marks', 'hello'], () => this.show());
    this.show();
  }

  private show(): void {
    const items = this.store.allMarks.map((mark) => {
      const label = markText(this.store, mark);
      const content =
          this.store.playback ? button(label, () => this.seek(mark.tick), {class: 'link'}) : label;
      return el('li', {}, content);
    });
    this.list.replaceChildren(
        ...(items.length > 0 ? items : [el('li', {class: 'empty'}, texts.marks.none)]));
  }
}

// An attempt's number stands before its marks, a recording has one attempt only.
export function markText(store: Store, mark: Marked): string {
  const words = texts.marks.goTo(store.seconds(mark.tick).toFixed(2), mark.text);
  return mark.attempt === 0 ? words : `${texts.scores.attempt(mark.attempt)}, ${words}`;
}

type Line = [name: string, text: string, number: number|null];

// One attempt's quantities: name, text, and the number to compare where there is one.
export function scoreLines(score: Score): Line[] {
  const names = texts.scores.lines;
  const {n, mm, s} = texts.units;
  const goals = score.targets.filter((t) => !t.forbidden);
  const zones = score.targets.filter((t) => t.forbidden);
  const reached = goals.filter((t) => t.reached).length;
  const touched = zones.filter((t) => t.reached).length;
  const closest = goals.length > 0 ? Math.min(...goals.map((t) => t.closest)) : null;
  return [
    [names.duration, s(score.duration), score.duration],
    [names.path, mm(score.path), score.path],
    [names.depthPath, mm(score.depthPath), score.depthPath],
    [names.punctures, String(score.punctures.length), score.punctures.length],
    [names.withdrawals, String(score.withdrawals), score.withdrawals],
    [names.targets, texts.scores.of(reached, goals.length), reached],
    [names.forbidden, texts.scores.of(touched, zones.length), touched],
    [names.closest, closest === null ? texts.scores.dash : mm(closest), closest],
    [names.peakForce, n(score.peakForce), score.peakForce],
    [names.peakLateral, n(score.peakLateral), score.peakLateral],
    [names.meanForce, n(score.meanForce), score.meanForce],
    [names.faults, String(score.faults), score.faults],
  ];
}

export const attemptName = (score: Score): string => score.trainee === '' ?
    texts.scores.attempt(score.attempt) :
    `${texts.scores.attempt(score.attempt)}, ${score.trainee}`;

export class ScorePanel {
  readonly root: HTMLElement;
  private readonly content = el('div');

  constructor(private readonly store: Store) {
    this.root = panel('score', texts.scores.heading, 'trainee teacher', this.content);
    store.on(['scores'], () => this.show());
    this.show();
  }

  private show(): void {
    const score = this.store.scores[this.store.scores.length - 1];
    if (score === undefined) {
      this.content.replaceChildren(el('p', {class: 'empty'}, texts.scores.none));
      return;
    }
    const facts = el('dl', {class: 'facts'});
    for (const [name, text] of scoreLines(score))
      facts.append(el('div', {}, el('dt', {}, name), el('dd', {}, text)));
    const punctures = score.punctures.map(
        (p) => el('li', {}, texts.scores.puncture(p.layer, texts.units.n(p.force))));
    this.content.replaceChildren(
        el('p', {class: 'attempt'}, attemptName(score)),
        facts,
        ...(punctures.length > 0 ?
                [
                  el('h3', {}, texts.scores.lines.punctures),
                  el('ul', {class: 'plain'}, ...punctures)
                ] :
                []),
    );
  }
}

export class ComparePanel {
  readonly root: HTMLElement;
  private readonly choices = [el('select'), el('select')];
  private readonly content = el('div');
  private readonly hint = el('p', {class: 'empty'}, texts.compare.need);
  private readonly body: HTMLElement;
  private readonly plot: Plot;

  constructor(private readonly store: Store) {
    this.plot = new Plot({name: 'comparison', height: 190, numbers: () => this.numbers()});
    this.body = el(
        'div',
        {hidden: true},
        el('div', {class: 'row'}, field(texts.compare.first, this.choices[0]),
           field(texts.compare.second, this.choices[1])),
        this.plot.root,
        this.content,
    );
    this.root = panel('compare', texts.compare.heading, 'teacher', this.hint, this.body);
    for (const choice of this.choices) choice.addEventListener('change', () => this.show());
    store.on(['scores'], () => this.refill());
    store.on(['view'], () => this.show());
  }

  // The newest two, unless others were chosen.
  private refill(): void {
    const {scores} = this.store;
    const ready = scores.length >= 2;
    this.hint.hidden = ready;
    this.body.hidden = !ready;
    this.choices.forEach((choice, i) => {
      choice.replaceChildren(
          ...scores.map((s) => el('option', {value: s.attempt}, attemptName(s))));
      const chosen = scores[scores.length - 2 + i];
      if (chosen) choice.value = String(chosen.attempt);
    });
    this.show();
  }

  private chosen(): [Score, Score]|null {
    const [a, b] =
        this.choices.map((c) => this.store.scores.find((s) => String(s.attempt) === c.value));
    return a && b ? [a, b] : null;
  }

  private show(): void {
    const pair = this.chosen();
    if (pair === null || this.body.hidden) return;
    this.plot.show(comparisonFigure(...pair));
    const [first, second] = pair.map(scoreLines);
    const rows = first.map(
        ([name, text, value], i) => [name, text, second[i][1], difference(value, second[i][2])]);
    const head = [texts.compare.what, ...pair.map(attemptName), texts.compare.difference];
    this.content.replaceChildren(table(head, rows));
  }

  private numbers() {
    const pair = this.chosen() ?? [];
    return {
      head: ['attempt', 'tick', 'travel_m', 'force_n', 'lateral_n'],
      columns: [
        pair.flatMap((s) => s.rows.map(() => s.attempt)),
        ...(['tick', 'travel', 'force', 'lateral'] as const)
            .map((c) => pair.flatMap((s) => s.rows.map((r) => r[c]))),
      ],
    };
  }
}

function difference(first: number|null, second: number|null): string {
  if (first === null || second === null || first === second) return texts.scores.dash;
  if (first === 0) return '';
  const share = (second - first) / Math.abs(first);
  return `${share > 0 ? '+' : ''}${texts.units.percent(share)}`;
}
