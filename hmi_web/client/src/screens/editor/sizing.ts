// Making a symbol larger or smaller by one of its edges or corners, and turning it. Pure.

import { snapped } from './arrange';
import type { Item } from './model';
import { boxThrough, pointsOf, stretched, turnedPoints, type Point } from './points';
import { templateOf } from './symbols';

// The edges that a handle takes with it: "nw" the upper and the left one.
export type Grip = 'nw' | 'n' | 'ne' | 'e' | 'se' | 's' | 'sw' | 'w';
export const GRIPS: readonly Grip[] = ['nw', 'n', 'ne', 'e', 'se', 's', 'sw', 'w'];

const LEAST = 8; // of a symbol, in both directions

export const isByPoints = (item: Pick<Item, 'symbol'>): boolean => templateOf(item.symbol)?.byPoints === true;

// One direction: where it begins and how long it is, after an edge has been moved by `by` and has come to lie on the grid.
function edge(from: number, length: number, by: number, side: 'first' | 'second' | 'none', grid: number): [number, number] {
  if (side === 'none' || by === 0) return [from, length];
  if (side === 'second') return [from, Math.max(LEAST, snapped(from + length + by, grid) - from)];
  const at = Math.min(snapped(from + by, grid), from + length - LEAST);
  return [at, from + length - at];
}

// What is in it grows with it: a line that lies flat stays flat.
function withSize(item: Item, x: number, y: number, w: number, h: number): Item {
  if (!isByPoints(item)) return { ...item, x, y, w, h };
  return { ...item, x, y, w, h, params: { ...item.params, points: stretched(item.params.points ?? '', w / item.w, h / item.h) } };
}

export function sized(item: Item, grip: Grip, dx: number, dy: number, grid: number): Item {
  const across = grip.includes('w') ? 'first' : grip.includes('e') ? 'second' : 'none';
  const down = grip.includes('n') ? 'first' : grip.includes('s') ? 'second' : 'none';
  const [x, w] = edge(item.x, item.w, dx, across, grid);
  const [y, h] = edge(item.y, item.h, dy, down, grid);
  return withSize(item, x, y, w, h);
}

// To a size that was typed.
export const resized = (item: Item, w: number, h: number): Item => withSize(item, item.x, item.y, w, h);

// By a quarter around its middle, clockwise.
export function turned(item: Item): Item {
  const { x, y, w, h } = item;
  const box = { x: x + (w - h) / 2, y: y + (h - w) / 2, w: h, h: w };
  if (isByPoints(item)) return through(item, pointsOf(turnedPoints(item.params.points ?? '', h)).map((point) => ({ x: point.x + box.x, y: point.y + box.y })));
  return { ...item, ...box, turn: (item.turn + 90) % 360 };
}

// The points of a line in the drawing.
export const pointsIn = (item: Item): Point[] => pointsOf(item.params.points).map(({ x, y }) => ({ x: x + item.x, y: y + item.y }));

// The line as it goes through other points of the drawing.
export function through(item: Item, points: readonly Point[]): Item {
  const { points: text, ...box } = boxThrough(points);
  return { ...item, ...box, params: { ...item.params, points: text } };
}
