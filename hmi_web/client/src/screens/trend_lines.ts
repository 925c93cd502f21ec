// The values of a trend in a screen: what the history has of the last minutes, and what has been seen since. Pure.

import type { Value } from '../lib/value';

// Those tags that a history has; names in any case.
export function keptOf(tags: readonly string[], kept: readonly string[]): string[] {
  const names = new Set(kept.map((name) => name.toLowerCase()));
  return tags.filter((name) => names.has(name.toLowerCase()));
}

export class TrendLines {
  times: number[] = []; // s since 1970
  columns: Value[][];

  constructor(
    count: number,
    private readonly minutes: number,
  ) {
    this.columns = Array.from({ length: count }, () => []);
  }

  // What was before what has been seen; a column that has nothing of it has gaps.
  begin(times: readonly number[], columns: readonly (readonly Value[])[]): void {
    const first = this.times[0] ?? Infinity;
    const count = times.filter((time) => time < first).length;
    this.times = [...times.slice(0, count), ...this.times];
    this.columns = this.columns.map((column, at) => [...Array.from({ length: count }, (_, row) => columns[at]?.[row] ?? null), ...column]);
  }

  // All times that have been seen are later by so much: on the clock of the server.
  shift(seconds: number): void {
    this.times = this.times.map((time) => time + seconds);
  }

  add(time: number, values: readonly Value[]): void {
    this.times.push(time);
    this.columns.forEach((column, at) => column.push(values[at] ?? null));
    const old = this.times.findIndex((each) => each >= time - 60 * this.minutes);
    if (old > 60) {
      this.times.splice(0, old);
      for (const column of this.columns) column.splice(0, old);
    }
  }
}
