// How numbers become text, in the language of the page. A value that is not known is a dash, never a zero.

import { fixedText, numberText, powerText } from './language.svelte';
import type { TagValue, Value } from './protocol';

export const UNKNOWN = '–';

// Beyond these the digits say less than the power of ten.
const MOST = 1e9;
const LEAST = 1e-4;
const needsPower = (value: number) => Math.abs(value) >= MOST || (value !== 0 && Math.abs(value) < LEAST);

export function fixed(value: Value | undefined, digits: number): string {
  if (value === null || value === undefined) return UNKNOWN;
  return Math.abs(value) >= MOST ? powerText(value) : fixedText(value, digits);
}

// Of a difference: "+0.03", "−0.20", "0".
export function signed(value: number, digits: number): string {
  return Number(Math.abs(value).toFixed(digits)) === 0 ? '0' : `${value > 0 ? '+' : '−'}${fixedText(Math.abs(value), digits)}`;
}

// As many digits as carry meaning: 0.42, 7.3, 128.
export function short(value: Value | undefined): string {
  if (value === null || value === undefined) return UNKNOWN;
  const size = Math.abs(value);
  if (needsPower(value)) return powerText(value);
  if (Number.isInteger(value)) return fixedText(value, 0);
  return fixedText(value, size >= 100 ? 0 : size >= 10 ? 1 : 2);
}

// A count, its thousands set apart: "12,345".
export function whole(count: number): string {
  return numberText(count);
}

// The number at a mark of an axis; uPlot has none for marks that it leaves out.
export function tickNumber(value: number | null): string {
  if (value === null) return '';
  return needsPower(value) ? powerText(value) : numberText(value);
}

// "1:02.5" of seconds.
export function clock(seconds: Value | undefined): string {
  return clockText(seconds, true);
}

// The same for the mark of an axis: "1:02", and "1:02.5" only where it lies between two seconds.
export function tickText(seconds: number): string {
  return clockText(seconds, Math.round(seconds * 10) % 10 !== 0);
}

// "1:02": the tenths are left out.
export function wholeClock(seconds: Value | undefined): string {
  return clockText(seconds, false);
}

function clockText(seconds: Value | undefined, withTenths: boolean): string {
  if (seconds === null || seconds === undefined) return UNKNOWN;
  const tenths = Math.round(seconds * 10);
  const minutes = Math.floor(tenths / 600);
  const rest = (tenths % 600) / 10;
  const hours = Math.floor(minutes / 60);
  const tail = withTenths ? fixedText(rest, 1).padStart(4, '0') : String(Math.floor(rest)).padStart(2, '0');
  return hours > 0 ? `${hours}:${String(minutes % 60).padStart(2, '0')}:${tail}` : `${minutes}:${tail}`;
}

export function micros(value: Value | undefined): string {
  if (value === null || value === undefined) return UNKNOWN;
  if (value >= 1_000_000) return `${fixedText(value / 1_000_000, 2)} s`;
  return value >= 1_000 ? `${fixedText(value / 1_000, 2)} ms` : `${short(value)} µs`;
}

// A tag's value by its IEC type, as a literal of IEC 61131-3: the same in every language. A text is shown as it is, without quotes.
export function tagValue(value: TagValue | undefined, type: string): string {
  if (value === null || value === undefined) return UNKNOWN;
  if (typeof value === 'string') return value;
  if (type === 'BOOL') return value > 0 ? 'TRUE' : 'FALSE';
  if (type === 'TIME' || type === 'LTIME') return `${seconds(value / 1e9)} s`;
  if (type === 'REAL' || type === 'LREAL') return realText(value);
  return String(value);
}

// "1.5", "1.0E38", "2.0E-5": what is not 0 does not look like 0.
function realText(value: number): string {
  if (value === 0 || (Math.abs(value) < MOST && Math.abs(value) >= 0.0005)) return value.toFixed(3);
  const [digits = '', power = ''] = Number(value.toPrecision(7)).toExponential().split('e');
  return `${digits.includes('.') ? digits : `${digits}.0`}E${power.replace('+', '')}`;
}

function seconds(value: number): string {
  const size = Math.abs(value);
  return Number.isInteger(value) ? String(value) : value.toFixed(size >= 100 ? 0 : size >= 10 ? 1 : 2);
}

// "(unload v1 a1 level8)" -> "unload v1 a1 level8"
export function bare(action: string): string {
  return action.startsWith('(') && action.endsWith(')') ? action.slice(1, -1) : action;
}
