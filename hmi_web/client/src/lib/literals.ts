// Literals of IEC 61131-3 as the runtime reads them (runtime/bytecode/reader/parse_value.h), held against values of the program. Pure.

import { meantText } from './string_value';
import type { TagValue } from './value';

export type Names = Readonly<Record<string, string>> | undefined; // of the values of an enumeration

const fold = (text: string) => text.toLowerCase();
const withoutGaps = (digits: string) => digits.replaceAll('_', '');

const INTEGER = /^([+-]?)(?:(2|8|16)#)?([\da-f](?:_?[\da-f])*)$/i;
const PREFIXES: Record<string, string> = { 2: '0b', 8: '0o', 16: '0x' };
function integerOf(text: string): bigint | null {
  const [, sign = '', base = '', digits = ''] = INTEGER.exec(text) ?? [];
  if (digits === '') return null;
  try {
    const size = BigInt((PREFIXES[base] ?? '') + withoutGaps(digits));
    return sign === '-' ? -size : size;
  } catch {
    return null; // a digit that its base does not have
  }
}

const REAL = /^[+-]?\d(?:_?\d)*(?:\.\d(?:_?\d)*)?(?:e[+-]?\d(?:_?\d)*)?$/i;
const realOf = (text: string): number => (REAL.test(text) ? Number(withoutGaps(text)) : NaN);

const DURATION = /^(?:LT|LTIME|T|TIME)#([+-]?)((?:\d[\d_]*(?:\.\d[\d_]*)?(?:ms|us|ns|[dhms])_?)+)$/i;
const UNITS_NS: Record<string, number> = { d: 86_400e9, h: 3_600e9, m: 60e9, s: 1e9, ms: 1e6, us: 1e3, ns: 1 };
// In seconds, as a variable has it; NaN for what is none.
function durationOf(text: string): number {
  const [, sign = '', parts = ''] = DURATION.exec(text) ?? [];
  if (parts === '') return NaN;
  const size = [...fold(withoutGaps(parts)).matchAll(/([\d.]+)([a-z]+)/g)].reduce((sum, [, count, unit = '']) => sum + Number(count) * (UNITS_NS[unit] ?? NaN), 0);
  return (sign === '-' ? -Math.round(size) : Math.round(size)) / 1e9;
}

// "DT#2024-2-29-12:30:00.50" and "DATE_AND_TIME#2024-02-29-12:30:00.5" have the same fields.
const fieldsOf = (text: string): string => withoutGaps(text.slice(text.indexOf('#') + 1)).split(/[-:]/).map(Number).join();

function isInteger(text: string, value: TagValue): boolean {
  const number = integerOf(text);
  if (number === null || value === null) return false;
  if (typeof value === 'string') return number === integerOf(value);
  return Number.isInteger(value) && number === BigInt(value);
}

const TRUTHS: Record<string, number> = { true: 1, 1: 1, false: 0, 0: 0 };

// Whether a variable of that type has the value that the literal means: "Auto" of an enumeration, "16#FF", "T#1m" for 60 s.
export function isValue(literal: string, value: TagValue, type: string, names?: Names): boolean {
  if (value === null) return false;
  const name = fold(literal.slice(literal.indexOf('#') + 1));
  const named = Object.entries(names ?? {}).find(([, each]) => fold(each) === name);
  if (named) return named[0] === String(value);
  const plain = fold(literal).startsWith(`${fold(type)}#`) ? literal.slice(type.length + 1) : literal;
  switch (type) {
    case 'BOOL':
      return TRUTHS[fold(plain)] === value;
    case 'REAL':
      return typeof value === 'number' && Math.fround(realOf(plain)) === Math.fround(value);
    case 'LREAL':
      return realOf(plain) === value;
    case 'TIME':
    case 'LTIME':
      return durationOf(literal) === value;
    case 'STRING':
    case 'WSTRING':
      return meantText(plain, type) === value;
    case 'CHAR':
    case 'WCHAR':
      return /^(['"])[^$]\1$/.test(plain) ? plain.charCodeAt(1) === value : isInteger(plain, value);
    default:
      return ['DATE', 'TOD', 'DT'].includes(type) ? fieldsOf(literal) === fieldsOf(String(value)) : isInteger(plain, value);
  }
}
