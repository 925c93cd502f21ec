// Numbers as people type them, in every form alike: decimals behind a point or a comma, and nothing between the thousands. What
// an English reader would take for a thousand is none: "1,000" is refused rather than read as 1.

import { language } from './language.svelte';

const PLAIN = /^-?\d+(?:[.,]\d+)?$/;
const THOUSANDS = /^-?[1-9]\d{0,2},\d{3}$/;

// With a point, as programs write it; null for what is no number.
export function decimalText(text: string): string | null {
  const typed = text.trim();
  const isThousands = language.code === 'en' && THOUSANDS.test(typed);
  return PLAIN.test(typed) && !isThousands ? typed.replace(',', '.') : null;
}

export function readNumber(text: string): number | null {
  const plain = decimalText(text);
  const value = plain === null ? NaN : Number(plain);
  return Number.isFinite(value) ? value : null;
}

// A literal of IEC 61131-3 for a variable of that type: a decimal comma of a number becomes a point, anything else stays.
export function literalText(text: string, type: string): string {
  const isNumber = /^(L?REAL|U?[SDL]?INT)$/.test(type);
  return isNumber ? (decimalText(text) ?? text) : text;
}

// An integer with all its digits, as it was typed; null for what is none.
export function exactInteger(text: string): string | null {
  const plain = decimalText(text);
  return plain !== null && /^-?\d+$/.test(plain) ? plain : null;
}
