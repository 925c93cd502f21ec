// The values of a trend in a screen: what the history has of the last minutes, and what has been seen since. Pure.

import type { Value } from '../lib/value';
import type { History } from '../records/records';

// Those tags that a history has; names in any case.
export function keptOf(tags: readonly string[], kept: readonly string[]): string[] {
  const names = new Set(kept.map((name) => name.toLowerCase()));
  return tags.filter((name) => names.has(name.toLowerCase()));
}

// Of a column its extremes, in the order in which the line goes on from `before`, and its last value. What held at its begin is
// drawn already.
function stepsOf(least: Value, greatest: Value, last: Value, before: Value): Value[] {
  if (least === null || greatest === null || (least === last && greatest === last)) return [last];
  const falls = last === least || (last !== greatest && before !== null && Math.abs(before - greatest) < Math.abs(before - least));
  const [first, second] = falls ? [greatest, least] : [least, greatest];
  return [...(first === before ? [] : [first]), ...(second === last ? [] : [second]), last];
}

export interface Rows {
  times: number[]; // s since 1970
  columns: Value[][];
}

// What the history knows, as rows for these tags. Where it does not know yet, at its end, there are none.
export function rowsOf({ from_ms, column_ms, known_ms, series }: History, tags: readonly string[]): Rows {
  const found = tags.map((tag) => series.find((one) => one.tag.toLowerCase() === tag.toLowerCase()));
  const count = Math.max(0, ...series.map(({ last }) => last.length));
  const rows: Rows = { times: [], columns: tags.map(() => []) };
  for (let at = 0; at < count && from_ms + at * column_ms <= known_ms; at++) {
    const steps = found.map((one, tag) => stepsOf(one?.least[at] ?? null, one?.greatest[at] ?? null, one?.last[at] ?? null, rows.columns[tag]?.at(-1) ?? null));
    const most = Math.max(...steps.map(({ length }) => length));
    for (let row = 0; row < most; row++) {
      rows.times.push(Math.min(from_ms + (at + (row + 1) / most) * column_ms, known_ms) / 1000);
      rows.columns.forEach((column, tag) => column.push(steps[tag]?.[row] ?? steps[tag]?.at(-1) ?? null));
    }
  }
  return rows;
}

export class TrendLines {
  times: number[] = []; // s since 1970
  columns: Value[][];
  private past = 0; // rows of the history

  constructor(
    count: number,
    private readonly minutes: number,
  ) {
    this.columns = Array.from({ length: count }, () => []);
  }

  // When something was seen for the first time; null: nothing was.
  get seenSince(): number | null {
    return this.times[this.past] ?? null;
  }

  // What was before what has been seen, in place of what was known of it until now; a column that has nothing of it has gaps.
  begin(times: readonly number[], columns: readonly (readonly Value[])[]): void {
    const first = this.seenSince ?? Infinity;
    const count = times.filter((time) => time < first).length;
    this.times = [...times.slice(0, count), ...this.times.slice(this.past)];
    this.columns = this.columns.map((column, at) => [...Array.from({ length: count }, (_, row) => columns[at]?.[row] ?? null), ...column.slice(this.past)]);
    this.past = count;
  }

  // All times that have been seen are later by so much: on the clock of the server.
  shift(seconds: number): void {
    this.times = this.times.map((time) => time + seconds);
  }

  add(time: number, values: readonly Value[]): void {
    // A page that has just opened has no values yet: that is no gap.
    if (this.seenSince === null && values.every((value) => value === null)) return;
    this.times.push(time);
    this.columns.forEach((column, at) => column.push(values[at] ?? null));
    const old = this.times.findIndex((each) => each >= time - 60 * this.minutes);
    if (old > 60) {
      this.times.splice(0, old);
      for (const column of this.columns) column.splice(0, old);
      this.past = Math.max(0, this.past - old);
    }
  }
}

// What a tag is drawn on: TRUTH, or the unit of its numbers.
export const TRUTH = '@';
export interface Scales {
  of: string[]; // of each tag: a lane of its own, or the scale that all numbers of its unit share
  lanes: string[];
  units: string[]; // each once, in the order of the tags
}
export const scaleOfUnit = (unit: string): string => `unit ${unit}`;
export function scalesOf(kinds: readonly string[]): Scales {
  let lane = 0;
  const of = kinds.map((kind) => (kind === TRUTH ? `@${lane++}` : scaleOfUnit(kind)));
  return { of, lanes: of.filter((_, at) => kinds[at] === TRUTH), units: [...new Set(kinds.filter((kind) => kind !== TRUTH))] };
}

const LANE = 0.12; // of the height of a trend with numbers, of one truth value
const LANES = 0.5; // of all of them at most
const EDGE = 0.15; // of a lane, above and below its steps

// The scale by which the truth value number `at` of `count` is a step in a lane of its own, from the bottom up. `alone`: there are no
// numbers.
export function laneOf(at: number, count: number, alone: boolean): [least: number, greatest: number] {
  const height = alone ? 1 / count : Math.min(LANE, LANES / count);
  const zero = height * (at + EDGE);
  const whole = 1 / (height * (1 - 2 * EDGE));
  return [-zero * whole, (1 - zero) * whole];
}
