// A histogram with two logarithmic axes: durations to the right, how many upwards. Pure.

import { micros } from '../lib/format';
import { t } from './detail_texts';
import type { Bucket, Spread } from './figures';

export const WIDTH = 320;
export const HEIGHT = 176;
export const TOP = 54; // room for four marks
export const BOTTOM = 158;

export interface Bar {
  x: number;
  width: number;
  y: number;
  height: number;
  title: string;
}

export interface Mark {
  name: string;
  x: number;
  y: number; // of its label
  left: boolean; // the label stands to the left of its line
  label: string;
}

export interface Tick {
  x: number;
  label: string;
}

export interface Picture {
  bars: Bar[];
  marks: Mark[];
  ticks: Tick[];
}

const SHORTEST_US = 0.008; // the first bucket begins at 0, which has no logarithm, and ends at 0.016
const MARK_STEP = 12;

const log = (us: number) => Math.log10(Math.max(us, SHORTEST_US));

function tickLabel(us: number): string {
  if (us < 1) return `${Math.round(us * 1000)} ns`;
  if (us < 1_000) return `${us} µs`;
  return us < 1_000_000 ? `${us / 1_000} ms` : `${us / 1_000_000} s`;
}

// Null if nothing was counted.
export function drawHistogram(spread: Spread): Picture | null {
  const buckets: Bucket[] = spread.buckets ?? [];
  const most = buckets.reduce((least, [, , count]) => Math.max(least, count), 0);
  const first = buckets[0];
  const last = buckets.at(-1);
  if (!first || !last || most === 0) return null;
  // At least a decade, so that one single bucket is no wall.
  let low = log(first[0]);
  let high = log(last[1]);
  if (high - low < 1) [low, high] = [(low + high) / 2 - 0.5, (low + high) / 2 + 0.5];
  const at = (us: number) => ((Math.min(high, Math.max(low, log(us))) - low) / (high - low)) * WIDTH;
  const share = (count: number) => Math.log10(1 + count) / Math.log10(1 + most);

  const bars = buckets
    .filter(([, , count]) => count > 0)
    .map(([from, to, count]) => {
      const height = Math.max(2, share(count) * (BOTTOM - TOP));
      return {
        x: at(from),
        width: Math.max(1, at(to) - at(from) - 0.8),
        y: BOTTOM - height,
        height,
        title: t('bar', { from: micros(from), to: micros(to), count }),
      };
    });
  const named: [string, number][] = [
    ['p50', spread.p50_us],
    ['p99', spread.p99_us],
    [t('p999'), spread.p999_us],
    [t('max'), spread.max_us],
  ];
  const marks = named.map(([name, us], row) => {
    const x = at(us);
    return { name, x, y: 10 + row * MARK_STEP, left: x > WIDTH * 0.6, label: `${name} ${micros(us)}` };
  });
  const ticks: Tick[] = [];
  for (let decade = Math.ceil(low - 1e-9); decade <= high + 1e-9; ++decade) {
    const us = 10 ** decade;
    ticks.push({ x: at(us), label: tickLabel(us) });
  }
  return { bars, marks, ticks };
}

// The same for those who do not see it.
export function tellHistogram(what: string, spread: Spread): string {
  const count = (spread.buckets ?? []).reduce((sum, [, , one]) => sum + one, 0);
  return t('histogram', {
    what,
    count,
    p50: micros(spread.p50_us),
    p99: micros(spread.p99_us),
    p999: micros(spread.p999_us),
    max: micros(spread.max_us),
  });
}
