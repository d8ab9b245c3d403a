// SPDX-License-Identifier: Apache-2.0
// Rows of ticks as growing columns, and what of them a plot of so many pixels can show.
//
// Promises: values are kept as received (float32 in float64, so exactly); rows are in the order of
// their ticks whatever the order of arrival, each tick once.
import type {Row} from './protocol';

export const kColumns = [
  'tick',
  'depth',
  'travel',
  'force',
  'lateral',
  'stiffness',
  'cutting',
  'friction',
  'clamping',
  'obstacle',
  'tickUs',
  'lateUs',
] as const;
export type Column = (typeof kColumns)[number];

export class Series {
  length = 0;
  private columns: Float64Array[] = kColumns.map(() => new Float64Array(4096));

  clear(): void { this.length = 0; }

  column(name: Column): Float64Array {
    return this.columns[kColumns.indexOf(name)].subarray(0, this.length);
  }

  // The first row whose tick is not before `tick`.
  find(tick: number): number {
    const ticks = this.columns[0];
    let low = 0;
    let high = this.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (ticks[middle] < tick)
        low = middle + 1;
      else
        high = middle;
    }
    return low;
  }

  add(row: Row): void {
    const at = this.find(row.tick);
    const known = at < this.length && this.columns[0][at] === row.tick;
    if (!known) this.open(at);
    kColumns.forEach((name, i) => (this.columns[i][at] = row[name]));
  }

  // The row nearest to a tick; null: there is none.
  near(tick: number): Record<Column, number>|null {
    if (this.length === 0) return null;
    let at = Math.min(this.find(tick), this.length - 1);
    const ticks = this.columns[0];
    if (at > 0 && tick - ticks[at - 1] < ticks[at] - tick) --at;
    const values = kColumns.map((name, i) => [name, this.columns[i][at]] as const);
    return Object.fromEntries(values) as Record<Column, number>;
  }

  private open(at: number): void {
    if (this.length === this.columns[0].length) {
      this.columns = this.columns.map((old) => {
        const grown = new Float64Array(2 * old.length);
        grown.set(old);
        return grown;
      });
    }
    if (at < this.length) {
      for (const column of this.columns) column.copyWithin(at + 1, at, this.length);
    }
    ++this.length;
  }
}

// Indices of at most about 4 `buckets` rows of [first, last): of every bucket its first, last,
// smallest and largest in `values`, so that no peak is lost.
export function thin(
    values: Float64Array,
    first: number,
    last: number,
    buckets: number,
    ): number[] {
  const count = last - first;
  if (count <= 4 * buckets) return Array.from({length: Math.max(0, count)}, (_, i) => first + i);
  const kept: number[] = [];
  for (let b = 0; b < buckets; ++b) {
    const from = first + Math.floor((b * count) / buckets);
    const to = first + Math.floor(((b + 1) * count) / buckets);
    let [low, high] = [from, from];
    for (let i = from; i < to; ++i) {
      if (values[i] < values[low]) low = i;
      if (values[i] > values[high]) high = i;
    }
    const four = [from, Math.min(low, high), Math.max(low, high), to - 1];
    for (const i of four)
      if (kept[kept.length - 1] !== i) kept.push(i);
  }
  return kept;
}

// The shortest decimal text that is this float32 and no other.
export function exactText(value: number): string {
  for (let digits = 1; digits < 9; ++digits) {
    const text = value.toPrecision(digits);
    if (Math.fround(Number(text)) === Math.fround(value)) return String(Number(text));
  }
  return String(Number(value.toPrecision(9)));
}
