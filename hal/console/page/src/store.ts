// SPDX-License-Identifier: Apache-2.0
// What the page knows, in one place; everything that shows it listens for what changed.
import type {Organ} from './organ';
import {
  Activity,
  type Frame,
  type FromServer,
  type Happened,
  type Hello,
  type Marked,
  type Score,
} from './protocol';
import {Series} from './series';

export type ViewName = 'trainee'|'teacher'|'engineer'|'report';
export type Topic =|'link'   // connection came, went or waits
    |'hello'                 // another scene or recording
    |'organ'|'frame'|'rows'  // series, events or marks changed
    |'marks'|'scores'        // of attempts
    |'view'                  // trainee, teacher, engineer, report
    |'needle';               // which needle the plots show

export class Store {
  hello: Hello|null = null;
  organ: Organ|null = null;
  frame: Frame|null = null;
  moved = new Int16Array();  // x y z 0 of each particle, in Hello.positionUnit
  series: Series[] = [];     // one a needle
  events: Happened[] = [];
  allMarks: Marked[] = [];  // of every attempt
  scores: Score[] = [];
  view: ViewName = 'trainee';
  needle = 0;
  private readonly untold = new Set<Topic>();
  private listeners = new Map<Topic, (() => void)[]>();

  on(topics: Topic[], listener: () => void): void {
    for (const topic of topics) {
      this.listeners.set(topic, [...(this.listeners.get(topic) ?? []), listener]);
    }
  }

  tell(topic: Topic): void {
    for (const listener of this.listeners.get(topic) ?? []) listener();
  }

  get playback(): boolean { return (this.hello?.recordingTicks ?? 0) > 0; }

  // Of the attempt that rows and events are of.
  get marks(): Marked[] {
    const attempt = this.frame?.attempt ?? 0;
    return this.allMarks.filter((mark) => mark.attempt === attempt);
  }

  get period(): number { return this.hello?.period ?? 1e-3; }

  get rows(): Series { return this.series[this.needle] ?? kNoRows; }

  seconds(tick: number): number { return tick * this.period; }

  layerName(layer: number): string { return this.organ?.materials[layer] ?? ''; }

  take(message: FromServer): void {
    switch (message.kind) {
      case 'hello':
        this.begin(message);
        break;
      case 'frame':
        this.advance(message);
        break;
      case 'rows':
        for (const row of message.rows) this.series[row.needle]?.add(row);
        this.addEvents(message.events);
        this.tell('rows');
        break;
      case 'score':
        this.scores = [...this.scores.filter((s) => s.attempt !== message.attempt), message];
        this.tell('scores');
        break;
      case 'marked':
        this.allMarks =
            [...this.allMarks, message].sort((a, b) => a.attempt - b.attempt || a.tick - b.tick);
        this.tell('marks');
        this.tell('rows');
        break;
      case 'refused':
        break;  // shown by status.ts
    }
  }

  select(view: ViewName): void {
    this.view = view;
    this.tell('view');
  }

  private begin(hello: Hello): void {
    this.hello = hello;
    this.moved = new Int16Array(4 * hello.particles);
    this.frame = null;
    this.needle = Math.min(this.needle, hello.needles.length - 1);
    this.series = hello.needles.map(() => new Series());
    this.events = [];
    this.allMarks = [];  // the server tells all of them again
    this.tell('hello');
    this.tell('rows');
  }

  private advance(frame: Frame): void {
    if (this.hello === null) return;
    const before = this.frame;
    // A new attempt begins where ticks begin anew; a recording may be sought to and fro.
    if (!this.playback && before !== null && frame.tick < before.tick) this.forget();
    this.frame = frame;
    this.move(frame);
    for (const row of frame.rows) this.series[row.needle]?.add(row);
    this.addEvents(frame.events);
    this.untold.add('frame');
    if (frame.rows.length > 0 || frame.events.length > 0) this.untold.add('rows');
  }

  // Once a picture: tells what frames brought since the last time. More frames than pictures then
  // cost no more than being read.
  flush(): void {
    const topics = [...this.untold];
    this.untold.clear();
    for (const topic of topics) this.tell(topic);
  }

  private move(frame: Frame): void {
    const {movedIndex, movedTo, key} = frame;
    const count = movedTo.length / 3;
    for (let i = 0; i < count; ++i) {
      const particle = key ? i : movedIndex[i];
      if (4 * particle + 3 >= this.moved.length) continue;  // not one of ours
      for (let k = 0; k < 3; ++k) this.moved[4 * particle + k] = movedTo[3 * i + k];
    }
  }

  private forget(): void {
    for (const series of this.series) series.clear();
    this.events = [];
    this.tell('rows');
  }

  private addEvents(events: Happened[]): void {
    if (events.length === 0) return;
    const name = (e: Happened) => `${e.tick} ${e.eventKind} ${e.needle}`;
    const known = new Set(this.events.map(name));
    const fresh = events.filter((e) => !known.has(name(e)));
    this.events = [...this.events, ...fresh].sort((a, b) => a.tick - b.tick);
  }
}

const kNoRows = new Series();

export const isBusy = (activity: Activity): boolean =>
    activity === Activity.Running || activity === Activity.Paused;
