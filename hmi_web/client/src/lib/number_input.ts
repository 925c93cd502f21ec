// Numbers as people type them, in every form alike: decimals behind a point or a comma, and nothing between the thousands. What
// the page itself writes for a thousand is none: "1,000" in English, "1.000" in German and Spanish are refused rather than read as 1.

import { decimalMark, language, type Language } from './language.svelte';

const PLAIN = /^-?\d+(?:[.,]\d+)?$/;
const THOUSANDS: Partial<Record<Language, RegExp>> = { en: /^-?[1-9]\d{0,2},\d{3}$/, de: /^-?[1-9]\d{0,2}\.\d{3}$/, es: /^-?[1-9]\d{0,2}\.\d{3}$/ };

// With a point, as programs write it; null for what is no number.
export function decimalText(text: string): string | null {
  const typed = text.trim();
  return PLAIN.test(typed) && !THOUSANDS[language.code]?.test(typed) ? typed.replace(',', '.') : null;
}

// The same number again, as somebody would type it: all its digits, without a power of ten.
export function typedText(value: number): string {
  const digits = 8 - Math.floor(Math.log10(Math.abs(value) || 1));
  const plain = !String(value).includes('e') ? String(value) : Math.abs(value) < 1 ? value.toFixed(Math.min(digits, 100)).replace(/0+$/, '') : BigInt(value).toString();
  return plain.replace('.', decimalMark());
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
