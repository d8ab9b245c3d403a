// SPDX-License-Identifier: Apache-2.0
// The phases of an attempt, for the plots: read off the events and the way of the tip.
//
// Contact and insertion begin with events of the kernel. Withdrawal has none: it begins where the
// tip was deepest, if it came back from there by more than kBack.
import type {Happened} from './protocol';
import type {Series} from './series';

export type PhaseName = 'contact'|'inserted'|'retracting';
export interface Span {
  phase: PhaseName;
  from: number;  // ticks
  to: number;
}
const kBack = 5e-3;  // m
const kHeld = 2e-4;  // m: a hand at rest moves less
// EventKind of the kernel.
export enum Kind {
  Contact,
  Release,
  Puncture,
  Reentry,
  Exit,
  Layer,
  Obstacle,
}

function turningPoint(series: Series, from: number, to: number): number|null {
  const [first, last] = [series.find(from), series.find(to + 1) - 1];
  const [ticks, travel] = [series.column('tick'), series.column('travel')];
  let deepest = first;
  let held = first;
  for (let i = first; i <= last; ++i)
    if (travel[i] >= travel[deepest]) deepest = i;
  // Of a hold at the deepest place, its end.
  for (let i = deepest; i <= last && travel[i] > travel[deepest] - kHeld; ++i) held = i;
  return last > held && travel[deepest] - travel[last] > kBack ? ticks[held] : null;
}

const isInserted = (span: Span|null): boolean => span?.phase === 'inserted';

export function phaseSpans(events: Happened[], series: Series, needle: number): Span[] {
  const ticks = series.column('tick');
  const end = ticks[ticks.length - 1] ?? 0;
  const spans: Span[] = [];
  let open: Span|null = null;
  const close = (at: number) => {
    if (open !== null) spans.push({...open, to: at});
    open = null;
  };
  for (const event of events.filter((e) => e.needle === needle)) {
    if (event.eventKind === Kind.Contact) {
      close(event.tick);
      open = {phase: 'contact', from: event.tick, to: end};
    } else if (event.eventKind === Kind.Puncture || event.eventKind === Kind.Reentry) {
      if (isInserted(open)) continue;  // of a layer further in
      close(event.tick);
      open = {phase: 'inserted', from: event.tick, to: end};
    } else if (event.eventKind === Kind.Release || event.eventKind === Kind.Exit) {
      close(event.tick);
    }
  }
  close(end);
  return spans.flatMap((span) => {
    const turn = span.phase === 'inserted' ? turningPoint(series, span.from, span.to) : null;
    if (turn === null) return [span];
    return [
      {...span, to: turn},
      {phase: 'retracting' as const, from: turn, to: span.to},
    ];
  });
}
