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

// A tag's value by its IEC type, in the language of the page: "TRUE", "1.500", "4 ms". A text is shown as it is, without quotes.
export function tagValue(value: TagValue | undefined, type: string): string {
  if (value === null || value === undefined) return UNKNOWN;
  if (typeof value === 'string') return value;
  if (type === 'BOOL') return value > 0 ? 'TRUE' : 'FALSE';
  if (isTime(type)) return durationText(value);
  if (isDate(type)) return dateLiteral(value, type);
  if (type === 'REAL' || type === 'LREAL') return realText(value);
  return String(value);
}

// "1.500", "1E38", "2E-5": what is not 0 does not look like 0.
function realText(value: number): string {
  return value === 0 || (Math.abs(value) < MOST && Math.abs(value) >= 0.0005) ? fixedText(value, 3) : powerText(value);
}

// Of a date that was kept as a number, in nanoseconds; a double does not count those of a date of today.
export const isDate = (type: string): boolean => ['DATE', 'DT', 'TOD'].includes(type);
function dateLiteral(ns: number, type: string): string {
  const micros = Math.round(ns / 1e3);
  const time = new Date(Math.floor(micros / 1e6) * 1e3);
  if (Number.isNaN(time.getTime())) return String(ns);
  const [day = '', rest = ''] = time.toISOString().split('T');
  const part = String(((micros % 1e6) + 1e6) % 1e6).padStart(6, '0').replace(/0+$/, '');
  const clock = rest.slice(0, 8) + (part && `.${part}`);
  return `${type}#${type === 'DATE' ? day : type === 'TOD' ? clock : `${day}-${clock}`}`.replace('DATE#', 'D#');
}

export const isTime = (type: string): boolean => type === 'TIME' || type === 'LTIME';

// A duration of so many seconds in the unit that says something: "5 us", "4 ms", "2.50 s", "1 min 30 s", "2 h 5 min", "100 d 4 h".
export function durationText(seconds: number): string {
  const ns = Math.round(Math.abs(seconds) * 1e9);
  return `${seconds < 0 && ns > 0 ? '-' : ''}${sizeText(ns)}`;
}

function sizeText(ns: number): string {
  if (ns === 0) return '0 s';
  if (ns < 999.5) return `${ns} ns`;
  if (ns < 999.5e3) return `${shortly(ns / 1e3)} us`;
  if (ns < 999.5e6) return `${shortly(ns / 1e6)} ms`;
  if (ns < 59.95e9) return `${shortly(ns / 1e9)} s`;
  const whole = Math.max(ns / 1e9, 60);
  if (whole < 3_600) return twoUnits(whole, 'min', 60, 's');
  return whole < 86_400 ? twoUnits(whole / 60, 'h', 60, 'min') : twoUnits(whole / 3_600, 'd', 24, 'h');
}

// "2 h 5 min" of 125 parts of which 60 are one.
function twoUnits(parts: number, name: string, count: number, partName: string): string {
  const whole = Math.floor(parts / count);
  const rest = Math.floor(parts) % count;
  return rest === 0 ? `${whole} ${name}` : `${whole} ${name} ${rest} ${partName}`;
}

const shortly = (value: number): string => fixedText(value, Number.isInteger(value) || value >= 100 ? 0 : value >= 10 ? 1 : 2);

// "(unload v1 a1 level8)" -> "unload v1 a1 level8"
export function bare(action: string): string {
  return action.startsWith('(') && action.endsWith(')') ? action.slice(1, -1) : action;
}
