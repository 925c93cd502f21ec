// How numbers become text. A value that is not known is a dash, never a zero.

import type { Value } from './protocol';

export const UNKNOWN = '–';

export function fixed(value: Value | undefined, digits: number): string {
  return value === null || value === undefined ? UNKNOWN : value.toFixed(digits);
}

// Of a difference: "+0.03", "−0.20", "0".
export function signed(value: number, digits: number): string {
  const size = Math.abs(value).toFixed(digits);
  return Number(size) === 0 ? '0' : `${value > 0 ? '+' : '−'}${size}`;
}

// As many digits as carry meaning: 0.42, 7.3, 128.
export function short(value: Value | undefined): string {
  if (value === null || value === undefined) return UNKNOWN;
  const size = Math.abs(value);
  if (Number.isInteger(value)) return String(value);
  return value.toFixed(size >= 100 ? 0 : size >= 10 ? 1 : 2);
}

// "1:02.5" of seconds.
export function clock(seconds: Value | undefined): string {
  if (seconds === null || seconds === undefined) return UNKNOWN;
  const tenths = Math.round(seconds * 10);
  const minutes = Math.floor(tenths / 600);
  const rest = (tenths % 600) / 10;
  const hours = Math.floor(minutes / 60);
  const tail = rest.toFixed(1).padStart(4, '0');
  return hours > 0 ? `${hours}:${String(minutes % 60).padStart(2, '0')}:${tail}` : `${minutes}:${tail}`;
}

export function micros(value: Value | undefined): string {
  if (value === null || value === undefined) return UNKNOWN;
  if (value >= 1_000_000) return `${(value / 1_000_000).toFixed(2)} s`;
  return value >= 1_000 ? `${(value / 1_000).toFixed(2)} ms` : `${short(value)} µs`;
}

// A tag's value by its IEC type.
export function tagValue(value: Value | undefined, type: string): string {
  if (value === null || value === undefined) return UNKNOWN;
  if (type === 'BOOL') return value > 0 ? 'TRUE' : 'FALSE';
  if (type === 'TIME' || type === 'LTIME') return `${short(value / 1e9)} s`;
  if (type === 'REAL' || type === 'LREAL') return value.toFixed(3);
  return String(value);
}

// "(unload v1 a1 level8)" -> "unload v1 a1 level8"
export function bare(action: string): string {
  return action.startsWith('(') && action.endsWith(')') ? action.slice(1, -1) : action;
}
