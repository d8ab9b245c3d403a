// SPDX-License-Identifier: Apache-2.0
// The session's report: every attempt on paper. Drawn when its view is opened or printed.
import {button, el, panel, table} from '../dom';
import {figureCanvas} from '../figure';
import {attemptFigure} from '../force_figures';
import type {Score} from '../protocol';
import type {Store} from '../store';
import {texts} from '../texts';
import {attemptName, markText, scoreLines} from './training_panels';

const kAttemptsAcross = 4;  // of a table on paper: more columns are cut off at its edge

export class ReportPanel {
  readonly root: HTMLElement;
  private readonly content = el('div', {class: 'paper'});

  constructor(private readonly store: Store) {
    this.root = panel(
        'report',
        texts.report.heading,
        'report',
        el('div', {class: 'panel-tools'},
           button(texts.report.print, () => window.print(), {class: 'primary'})),
        this.content,
    );
    store.on(['view', 'scores', 'marks', 'hello'], () => this.show());
    window.addEventListener('beforeprint', () => this.draw());
  }

  private show(): void {
    if (this.store.view === 'report') this.draw();
  }

  private draw(): void {
    const {hello, scores, allMarks: marks} = this.store;
    const made = new Date().toLocaleString('en-GB', {dateStyle: 'long', timeStyle: 'short'});
    const head =
        [hello?.scene ?? '', texts.report.made(made), texts.report.version(hello?.version ?? '')];
    this.content.replaceChildren(
        el('p', {class: 'report-head'}, head.join(' · ')),
        ...(scores.length > 0 ? this.attempts(scores) :
                                [el('p', {class: 'empty'}, texts.report.none)]),
        ...(marks.length > 0 ?
                [
                  el('h3', {}, texts.report.marks),
                  el('ol', {}, ...marks.map((m) => el('li', {}, markText(this.store, m)))),
                ] :
                []),
        el('p', {class: 'signature'}, texts.report.signature),
    );
  }

  private attempts(scores: Score[]): HTMLElement[] {
    const tables: HTMLElement[] = [];
    for (let first = 0; first < scores.length; first += kAttemptsAcross)
      tables.push(this.attemptTable(scores.slice(first, first + kAttemptsAcross)));
    return [
      el('h3', {}, texts.report.attempts),
      ...tables,
      el('h3', {}, texts.report.curves),
      ...scores.filter((s) => s.rows.length > 1).map((s) => this.curve(s)),
      ...scores.filter((s) => s.targets.length > 0).map((s) => this.targets(s)),
    ];
  }

  private attemptTable(scores: Score[]): HTMLElement {
    const names = scoreLines(scores[0]).map(([name]) => name);
    const columns = scores.map((s) => scoreLines(s).map(([, text]) => text));
    const rows = [
      [texts.scores.lines.trainee, ...scores.map((s) => s.trainee || texts.scores.dash)],
      [
        texts.scores.lines.began,
        ...scores.map((s) => s.began.replace('T', ' ') || texts.scores.dash)
      ],
      ...names.map((name, i) => [name, ...columns.map((column) => column[i])]),
      [texts.scores.lines.recording, ...scores.map((s) => s.recording || texts.scores.notKept)],
    ];
    const head = ['', ...scores.map((s) => texts.scores.attempt(s.attempt))];
    return el('div', {class: 'wide'}, table(head, rows));
  }

  private curve(score: Score): HTMLElement {
    const canvas = figureCanvas(attemptFigure(score, this.store.period));
    canvas.setAttribute('role', 'img');
    canvas.setAttribute('aria-label', `${texts.report.curves}: ${attemptName(score)}`);
    return el('figure', {}, canvas);
  }

  private targets(score: Score): HTMLElement {
    const {kinds, yes, no} = texts.report;
    const rows = score.targets.map(
        (t) =>
            [t.name,
             t.forbidden ? kinds.forbidden : kinds.target,
             texts.units.mm(t.closest),
             t.reached ? yes : no,
    ]);
    const head =
        [texts.report.target, texts.report.kind, texts.report.closest, texts.report.reached];
    return el(
        'div', {class: 'wide'},
        table(head, rows, `${texts.report.targets}: ${attemptName(score)}`));
  }
}
