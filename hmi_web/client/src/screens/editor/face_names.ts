// What the parameters of a face are for: the names of values that it makes of them, or text alone. Pure.

import { fieldsIn, NAMING } from '../../drawing/bindings';
import { NAMING_OF_PARTS } from '../parts';
import type { Faces, Item } from './model';
import type { Params } from './template';

const NAMES = new RegExp(` data-(?:${[...NAMING, ...NAMING_OF_PARTS].join('|')})="([^"]*)"`, 'g');

// Those names in a face in which a parameter stands: "{pump}.running".
export function patternsOf(inner: string, param: string): string[] {
  const names = [...inner.matchAll(NAMES)].flatMap(([, text = '']) => text.split(';').map((each) => each.trim().replace(/^!/, '')));
  return [...new Set(names)].filter((name) => fieldsIn(name).includes(param));
}

// What they are with all parameters of a copy; those in which one is still open are none yet.
export const namesBy = (patterns: readonly string[], params: Params): string[] =>
  patterns.map((pattern) => pattern.replace(/\{(\w+)\}/g, (whole, name: string) => params[name]?.trim() || whole)).filter((name) => !name.includes('{'));

// What can stand for a parameter so that every name that it alone makes is one of `known`.
export function offersOf(patterns: readonly string[], param: string, known: readonly string[]): string[] {
  const place = `{${param}}`;
  const alone = patterns.filter((pattern) => fieldsIn(pattern).length === 1 && pattern.split(place).length === 2);
  const fitting = alone.map((pattern) => {
    const [before = '', after = ''] = pattern.toLowerCase().split(place.toLowerCase());
    const fits = (name: string) => name.length > before.length + after.length && name.toLowerCase().startsWith(before) && name.toLowerCase().endsWith(after);
    return known.filter(fits).map((name) => name.slice(before.length, name.length - after.length));
  });
  const [first = [], ...others] = fitting;
  const sets = others.map((names) => new Set(names.map((name) => name.toLowerCase())));
  return [...new Set(first)].filter((name) => sets.every((names) => names.has(name.toLowerCase())));
}

// A copy of a face in which something is not filled in yet.
export interface Unfilled {
  item: Item;
  face: string;
  fields: string[];
}
export const unfilledIn = (items: readonly Item[], faces: Faces): Unfilled[] =>
  items.flatMap((item) => {
    const face = item.symbol === 'face' ? faces.get(item.params.face ?? '') : undefined;
    const fields = face?.params.filter((name) => !item.params[name]?.trim()) ?? [];
    return face && fields.length > 0 ? [{ item, face: face.name, fields }] : [];
  });
