// The attributes by which an element of a drawing lives (hmi_web/doc/drawings.md), and what values make of it. Pure.

import { fixed, isTime, UNKNOWN } from '../lib/format';
import type { TagNote, Value } from '../lib/protocol';
import { hasDecimals, nameOr, told, toldNumber } from '../lib/tag_notes';
import { isLongInteger, numberOr, type TagValue } from '../lib/value';

export type Switch = 'on' | 'warn' | 'alarm' | 'show';
export type Range = 'fill' | 'move' | 'turn';

interface Named {
  name: string;
}
export interface TextBinding extends Named {
  kind: 'text';
  digits: number | null; // null: as many as carry meaning
  unit: string; // empty: that of the tag
}
export interface SwitchBinding extends Named {
  kind: Switch;
  negated: boolean;
}
export interface RangeBinding extends Named {
  kind: Range;
  from: number;
  to: number;
  x: number; // of a move
  y: number;
  degrees: number; // of a turn
}
// Of something on a floor, in m and rad. `name` is that of its x.
export interface PoseBinding extends Named {
  kind: 'pose';
  y: string;
  heading: string; // empty: it has none
  floor: FloorScale;
}
export type Binding = TextBinding | SwitchBinding | RangeBinding | PoseBinding;

// Where the floor's origin is in the drawing, and how long a metre is there. Its y goes upwards.
export interface FloorScale {
  x: number;
  y: number;
  scale: number;
}

// In the element's own coordinates.
export interface Box {
  x: number;
  y: number;
  width: number;
  height: number;
}

const SWITCHES: Switch[] = ['on', 'warn', 'alarm', 'show'];
const RANGES: Range[] = ['fill', 'move', 'turn'];

// The attributes, without `data-`, that name a value.
export const NAMING: readonly string[] = ['text', ...SWITCHES, ...RANGES, 'pose-x', 'pose-y', 'pose-heading'];

// Of a face, which stands for many: what each copy fills in. Where somebody has not, it stays in the names: "{pump}.running".
export const fieldsIn = (text: string): string[] => [...new Set([...text.matchAll(/\{(\w+)\}/g)].map(([, name = '']) => name))];

// All values that a binding is made of.
export const namesOf = (binding: Binding): string[] =>
  binding.kind === 'pose' ? [binding.name, binding.y, binding.heading].filter((name) => name !== '') : [binding.name];

// `read`: an attribute by its name without `data-`; `around`: the same of the element or the nearest around it that has a
// floor. The server has checked what is there.
export function bindingsOf(read: (attribute: string) => string | null, around: (attribute: string) => string | null = read): Binding[] {
  const found: Binding[] = [];
  const number = (attribute: string, usual: number) => {
    const value = Number(read(attribute) ?? usual);
    return Number.isFinite(value) ? value : usual;
  };
  const text = read('text');
  if (text) found.push({ kind: 'text', name: text, digits: read('digits') === null ? null : number('digits', 0), unit: read('unit') ?? '' });
  for (const kind of SWITCHES) {
    const name = read(kind);
    if (name) found.push({ kind, name: name.replace(/^!/, ''), negated: name.startsWith('!') });
  }
  for (const kind of RANGES) {
    const name = read(kind);
    if (name) found.push({ kind, name, from: number('from', 0), to: number('to', 100), x: number('x', 0), y: number('y', 0), degrees: number('degrees', 0) });
  }
  const [x, y] = [read('pose-x'), read('pose-y')];
  if (x && y) {
    const place = (attribute: string) => Number(around(attribute) ?? 0) || 0;
    found.push({ kind: 'pose', name: x, y, heading: read('pose-heading') ?? '', floor: { x: place('floor-x'), y: place('floor-y'), scale: place('floor-scale') } });
  }
  return found;
}

// The place that an element drawn around (0, 0) and facing right has then; null where it is not known.
export function poseTransform({ floor, heading }: PoseBinding, values: readonly Value[]): string | null {
  const [x, y, angle] = values;
  if (x === null || x === undefined || y === null || y === undefined) return null;
  if (heading !== '' && (angle === null || angle === undefined)) return null;
  const digits = (value: number) => Number(value.toFixed(3));
  const turned = heading === '' ? '' : ` rotate(${digits((-(angle ?? 0) * 180) / Math.PI)})`;
  return `translate(${digits(floor.x + x * floor.scale)} ${digits(floor.y - y * floor.scale)})${turned}`;
}

// A value of the cell, with what is said of it.
export interface Found {
  value: TagValue;
  type: string;
  note?: TagNote | undefined;
  names?: Record<string, string> | undefined; // of the values of an enumeration
}

// As people read it. Decimals and unit of the drawing come before those of the cell; a text has no quotes.
export function textOf(found: Found | null, digits: number | null = null, unit = ''): string {
  if (found === null || found.value === null) return UNKNOWN;
  const { value, type, note, names } = found;
  if (typeof value === 'string') return isLongInteger(type) ? told(value, type, { name: '', unit: unit || note?.unit || '' }) : value;
  const named = nameOr(value, names, note);
  if (typeof named === 'string') return named;
  const said = unit || note?.unit || '';
  const decimals = digits ?? note?.decimals;
  if (decimals === undefined || !hasDecimals(type)) return told(value, type, { name: '', unit: said });
  return said === '' ? fixed(value, decimals) : `${fixed(value, decimals)} ${said}`;
}

// The same for who does not see how far it is filled or turned: as many digits as carry meaning.
export function spokenOf(found: Found | null): string {
  const isCounted = typeof found?.value === 'number' && found.type !== 'BOOL';
  return isCounted ? toldNumber(numberOr(found.value), found.note, found.names, isTime(found.type) ? found.type : '') : textOf(found);
}

// What is not known is neither true nor false.
export function isTrue(binding: SwitchBinding, value: Value): boolean {
  return value !== null && value > 0.5 !== binding.negated;
}

// 0 to 1.
export function shareOf(binding: RangeBinding, value: number): number {
  return Math.min(1, Math.max(0, (value - binding.from) / (binding.to - binding.from)));
}

// What follows the element's own transform. A value that is not known leaves it as it was drawn.
export function transformOf(binding: RangeBinding, value: Value, box: Box): string {
  if (value === null) return '';
  const share = shareOf(binding, value);
  if (binding.kind === 'move') return `translate(${binding.x * share} ${binding.y * share})`;
  if (binding.kind === 'turn') return `rotate(${binding.degrees * share} ${box.x + box.width / 2} ${box.y + box.height / 2})`;
  // From the lower edge upwards.
  return `translate(0 ${(box.y + box.height) * (1 - share)}) scale(1 ${share})`;
}
