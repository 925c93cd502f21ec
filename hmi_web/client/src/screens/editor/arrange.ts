// Arranging symbols: moving, aligning, grouping, copying, front and back. Pure.

import { nextKey, type Item } from './model';

export interface Box {
  x: number;
  y: number;
  width: number;
  height: number;
}
// The box that an item fills; what other programs have drawn is measured.
export type Measure = (item: Item) => Box;
export type Keys = ReadonlySet<string>;
type Items = readonly Item[];

export const ownBox: Measure = ({ x, y, w, h }) => ({ x, y, width: w, height: h });

// With everything that is grouped with what is chosen.
export function withGroups(items: Items, keys: Keys): Set<string> {
  const groups = new Set(items.filter(({ key, group }) => group !== '' && keys.has(key)).map(({ group }) => group));
  return new Set(items.filter(({ key, group }) => keys.has(key) || groups.has(group)).map(({ key }) => key));
}

export const moved = (items: Items, keys: Keys, dx: number, dy: number): Item[] =>
  items.map((item) => (keys.has(item.key) ? { ...item, x: item.x + dx, y: item.y + dy } : item));

export const snapped = (value: number, grid: number): number => (grid > 0 ? Math.round(value / grid) * grid : Number(value.toFixed(1)));

export function boundsOf(items: Items, measure: Measure): Box | null {
  if (items.length === 0) return null;
  const boxes = items.map(measure);
  const x = Math.min(...boxes.map((box) => box.x));
  const y = Math.min(...boxes.map((box) => box.y));
  return { x, y, width: Math.max(...boxes.map((box) => box.x + box.width)) - x, height: Math.max(...boxes.map((box) => box.y + box.height)) - y };
}

export type Edge = 'left' | 'middle' | 'right' | 'top' | 'centre' | 'bottom';

export function aligned(items: Items, keys: Keys, edge: Edge, measure: Measure): Item[] {
  const bounds = boundsOf(items.filter(({ key }) => keys.has(key)), measure);
  if (!bounds) return [...items];
  return items.map((item) => {
    if (!keys.has(item.key)) return item;
    const box = measure(item);
    const dx = { left: bounds.x - box.x, middle: bounds.x + bounds.width / 2 - box.x - box.width / 2, right: bounds.x + bounds.width - box.x - box.width }[edge as 'left'] ?? 0;
    const dy = { top: bounds.y - box.y, centre: bounds.y + bounds.height / 2 - box.y - box.height / 2, bottom: bounds.y + bounds.height - box.y - box.height }[edge as 'top'] ?? 0;
    return { ...item, x: item.x + dx, y: item.y + dy };
  });
}

// The same distance between the middles, the outer ones where they are.
export function spread(items: Items, keys: Keys, axis: 'x' | 'y', measure: Measure): Item[] {
  const size = axis === 'x' ? 'width' : 'height';
  const middle = (item: Item) => measure(item)[axis] + measure(item)[size] / 2;
  const chosen = items.filter(({ key }) => keys.has(key)).sort((a, b) => middle(a) - middle(b));
  const [first, last] = [chosen[0], chosen.at(-1)];
  if (!first || !last || chosen.length < 3) return [...items];
  const step = (middle(last) - middle(first)) / (chosen.length - 1);
  const shift = new Map(chosen.map((item, at) => [item.key, middle(first) + at * step - middle(item)]));
  return items.map((item) => (shift.has(item.key) ? { ...item, [axis]: item[axis] + (shift.get(item.key) ?? 0) } : item));
}

export function grouped(items: Items, keys: Keys): Item[] {
  const taken = new Set(items.map(({ group }) => group));
  let number = 1;
  while (taken.has(`g${number}`)) number += 1;
  return items.map((item) => (keys.has(item.key) ? { ...item, group: `g${number}` } : item));
}

export const ungrouped = (items: Items, keys: Keys): Item[] => items.map((item) => (keys.has(item.key) ? { ...item, group: '' } : item));

export const ordered = (items: Items, keys: Keys, to: 'front' | 'back'): Item[] => {
  const [chosen, rest] = [items.filter(({ key }) => keys.has(key)), items.filter(({ key }) => !keys.has(key))];
  return to === 'front' ? [...rest, ...chosen] : [...chosen, ...rest];
};

// By one symbol towards the front (1) or the back (-1).
export function stepped(items: Items, keys: Keys, by: 1 | -1): Item[] {
  const result = by === 1 ? [...items].reverse() : [...items];
  for (let at = 1; at < result.length; at++) {
    const [before, here] = [result[at - 1] as Item, result[at] as Item];
    if (keys.has(here.key) && !keys.has(before.key)) [result[at - 1], result[at]] = [here, before];
  }
  return by === 1 ? result.reverse() : result;
}

// As often as it takes: no copy lies exactly on a symbol of its kind, where nobody would see it.
function beside(items: Items, copies: Items, offset: number): number {
  const lies = (shift: number) => copies.some((copy) => items.some(({ symbol, x, y }) => symbol === copy.symbol && x === copy.x + shift && y === copy.y + shift));
  let shift = offset;
  while (lies(shift)) shift += offset;
  return shift;
}

// Copies with names and groups of their own, a little beside.
export function pasted(items: Items, copies: Items, offset: number): { items: Item[]; keys: Set<string> } {
  const result = [...items];
  const shift = beside(items, copies, offset);
  const keys = new Set<string>();
  const groups = new Map<string, string>();
  const taken = new Set(items.map(({ group }) => group));
  for (const copy of copies) {
    const key = nextKey(result);
    if (copy.group !== '' && !groups.has(copy.group)) {
      let number = 1;
      while (taken.has(`g${number}`)) number += 1;
      taken.add(`g${number}`);
      groups.set(copy.group, `g${number}`);
    }
    keys.add(key);
    result.push({ ...copy, key, group: groups.get(copy.group) ?? '', x: copy.x + shift, y: copy.y + shift });
  }
  return { items: result, keys };
}

export const touches = (a: Box, b: Box): boolean => a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;

const APART = 20; // from what is there: labels stick out of their symbols

// The middle of the place nearest to the middle of a screen where a symbol of that size lies on nothing; null: it is full.
export function freePlace(taken: readonly Box[], size: { width: number; height: number }, room: { width: number; height: number }): { x: number; y: number } | null {
  const distance = (x: number, y: number) => Math.hypot(x - room.width / 2, y - room.height / 2);
  let best: { x: number; y: number } | null = null;
  const [across, down] = [size.width / 2, size.height / 2];
  // From the middle outwards, so that the first symbol of a screen stands there.
  const columns = Math.floor((room.width / 2 - across) / APART);
  const rows = Math.floor((room.height / 2 - down) / APART);
  for (let row = -rows; row <= rows; row++) {
    for (let column = -columns; column <= columns; column++) {
      const [x, y] = [room.width / 2 + column * APART, room.height / 2 + row * APART];
      if (best && distance(x, y) >= distance(best.x, best.y)) continue;
      const box = { x: x - across - APART, y: y - down - APART, width: size.width + 2 * APART, height: size.height + 2 * APART };
      if (!taken.some((each) => touches(each, box))) best = { x, y };
    }
  }
  return best;
}
