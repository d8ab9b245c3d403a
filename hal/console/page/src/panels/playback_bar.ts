// SPDX-License-Identifier: Apache-2.0
// A recording's scrub bar: seek, play at any speed, to the next event or tick.
//
// While the user drags, only the newest place is asked for, and no sooner than the last came.
import {button, el, field, say} from '../dom';
import {ask} from '../protocol';
import type {Store} from '../store';
import {texts} from '../texts';

const kSpeeds = [-1, 0.1, 0.25, 0.5, 1, 2, 4, 8];
const kPatienceMs = 400;  // a place that was asked for and did not come

export class PlaybackBar {
  readonly root: HTMLElement;
  private readonly bar = el('input', {
    type: 'range',
    min: 0,
    max: 0,
    step: 1,
    value: 0,
    class: 'scrub',
    'aria-label': texts.playback.position,
  });
  private readonly play = button(texts.playback.play, () => this.toggle(), {class: 'primary'});
  private readonly time = el('span', {class: 'clock'});
  private readonly speed = el('select');
  private readonly flags = el('div', {class: 'flags', 'aria-hidden': 'true'});
  private playing = false;
  private wanted: number|null = null;
  private askedAt = -Infinity;
  private asked = -1;
  private rowAsked = -1;

  constructor(
      private readonly store: Store,
      private readonly send: (bytes: Uint8Array) => void,
  ) {
    this.speed.append(...kSpeeds.map((s) => el('option', {value: s}, texts.playback.speedOf(s))));
    this.speed.value = '1';
    this.root = el(
        'section',
        {class: 'playback', 'aria-label': texts.playback.heading, hidden: true},
        this.play,
        button('|<', () => this.toEvent(-1), {'aria-label': texts.playback.lastEvent}),
        button('<', () => this.seek(this.tick - 1), {'aria-label': texts.playback.back}),
        button('>', () => this.seek(this.tick + 1), {'aria-label': texts.playback.forward}),
        button('>|', () => this.toEvent(1), {'aria-label': texts.playback.nextEvent}),
        el('div', {class: 'scrub-place'}, this.bar, this.flags),
        this.time,
        field(texts.playback.speed, this.speed),
    );
    this.bar.addEventListener('input', () => this.seek(Number(this.bar.value)));
    this.speed.addEventListener('change', () => this.playing && this.sendSpeed());
    store.on(['hello'], () => this.begin());
    store.on(['rows'], () => this.drawFlags());
    store.on(['frame'], () => this.show());
  }

  private get last(): number { return this.store.hello?.recordingTicks ?? 0; }

  private get tick(): number { return this.wanted ?? this.store.frame?.tick ?? 0; }

  toggle(): void {
    if (!this.store.playback) return;
    if (!this.playing && this.tick >= this.last && Number(this.speed.value) > 0) this.seek(0);
    this.setPlaying(!this.playing);
    this.sendSpeed();
  }

  seek(tick: number): void {
    if (!this.store.playback) return;
    this.wanted = Math.round(Math.min(this.last, Math.max(0, tick)));
    if (this.playing) {
      this.setPlaying(false);
      this.sendSpeed();
    }
    this.ask();
  }

  private ask(): void {
    const waiting = this.asked !== this.store.frame?.tick;
    if (waiting && performance.now() - this.askedAt < kPatienceMs) return;
    if (this.wanted === null) return;
    this.asked = this.wanted;
    this.askedAt = performance.now();
    this.send(ask.seek(this.wanted));
  }

  private setPlaying(playing: boolean): void {
    this.playing = playing;
    say(this.play, playing ? texts.playback.hold : texts.playback.play);
  }

  private sendSpeed(): void { this.send(ask.play(this.playing ? Number(this.speed.value) : 0)); }

  private toEvent(direction: number): void {
    const stops =
        [...this.store.events, ...this.store.marks].map((e) => e.tick).sort((a, b) => a - b);
    const next = direction > 0 ? stops.find((tick) => tick > this.tick) :
                                 stops.reverse().find((tick) => tick < this.tick);
    this.seek(next ?? (direction > 0 ? this.last : 0));
  }

  private begin(): void {
    this.root.hidden = !this.store.playback;
    this.bar.max = String(this.last);
    this.wanted = null;
    this.asked = -1;
    this.setPlaying(false);
    this.drawFlags();
  }

  private show(): void {
    const {frame} = this.store;
    if (frame === null || !this.store.playback) return;
    if (this.wanted === frame.tick)
      this.wanted = null;
    else if (this.wanted !== null)
      this.ask();
    if (this.wanted === null) this.bar.value = String(frame.tick);
    if (this.wanted === null && !this.playing) this.askExactRow(frame.tick);
    if (this.playing && frame.tick >= this.last && Number(this.speed.value) > 0)
      this.setPlaying(false);
    const [now, end] = [frame.tick, this.last].map((t) => this.store.seconds(t).toFixed(3));
    say(this.time, texts.playback.at(now, end));
    this.bar.setAttribute('aria-valuetext', texts.playback.at(now, end));
  }

  // Rows for the plots are thinned; at the cursor there must be the one of this very tick.
  private askExactRow(tick: number): void {
    if (tick === this.rowAsked || this.store.rows.near(tick)?.tick === tick) return;
    this.rowAsked = tick;
    this.send(ask.rows(tick, tick, 1));
  }

  private drawFlags(): void {
    if (this.last === 0) return;
    const flag = (tick: number, kind: string) => {
      const made = el('span', {class: kind});
      made.style.left = `${((100 * tick) / this.last).toFixed(3)}%`;
      return made;
    };
    this.flags.replaceChildren(
        ...this.store.events.map((e) => flag(e.tick, 'flag')),
        ...this.store.marks.map((m) => flag(m.tick, 'flag mark')),
    );
  }
}
