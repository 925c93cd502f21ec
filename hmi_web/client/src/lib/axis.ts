// The axis of numbers of a chart. uPlot finds no marks for numbers with more than 17 digits before or behind the point: such
// values are drawn in units of a power of ten, and their marks say what they are.

import { tickNumber } from './format';

const LARGE = 1e12;
const SMALL = 1e-9;
const LETTER_PX = 6.5;
const TICK_PX = 14;

export type Column = readonly (number | null | undefined)[];

// The power of ten in whose units these are drawn; 1 for ordinary numbers.
export function unitOf(columns: readonly Column[]): number {
  let most = 0;
  for (const column of columns) for (const value of column) if (typeof value === 'number' && Math.abs(value) > most) most = Math.abs(value);
  const ordinary = most === 0 || !Number.isFinite(most) || (most < LARGE && most >= SMALL);
  return ordinary ? 1 : 10 ** Math.floor(Math.log10(most));
}

export const inUnits = (column: Column, unit: number): (number | null | undefined)[] =>
  unit === 1 ? column.slice() : column.map((value) => (typeof value === 'number' ? value / unit : value));

export const marks = (ticks: readonly (number | null)[], unit: number): string[] => ticks.map((tick) => tickNumber(tick === null ? null : tick * unit));

// As wide as the longest mark, and not wider than the first time while it is laid out: uPlot would never end.
export const roomFor =
  (least: number) =>
  (chart: { axes: object[] }, values: readonly string[] | null, axis: number, cycle: number): number => {
    const before = (chart.axes[axis] as { _size?: number } | undefined)?._size;
    if (cycle > 1 && before !== undefined) return before;
    return Math.max(least, TICK_PX + LETTER_PX * Math.max(0, ...(values ?? []).map((value) => value.length)));
  };
