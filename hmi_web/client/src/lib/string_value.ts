// The text of a STRING or WSTRING as people type it: as it stands, or, where that would mean something else, as a literal of
// IEC 61131-3 in quotes (runtime/bytecode/reader/parse_string.h reads both).

const ESCAPES: Readonly<Record<string, string>> = { $: '$$', '\n': '$N', '\r': '$R', '\t': '$T', '\f': '$P' };

export const isString = (type: string): boolean => type === 'STRING' || type === 'WSTRING';

const quoteOf = (type: string) => (type === 'WSTRING' ? '"' : "'");

function literal(text: string, type: string): string {
  const quote = quoteOf(type);
  const digits = type === 'WSTRING' ? 4 : 2;
  const escaped = (character: string) =>
    ESCAPES[character] ?? (character === quote ? `$${quote}` : `$${character.charCodeAt(0).toString(16).toUpperCase().padStart(digits, '0')}`);
  return quote + text.replace(/[$'"\u0000-\u001f\u007f]/g, (each) => (each === quote || !/['"]/.test(each) ? escaped(each) : each)) + quote;
}

const CONTROLS: Readonly<Record<string, string>> = { L: '\n', N: '\n', R: '\r', T: '\t', P: '\f' };

// The text that a literal, or a text without quotes, stands for.
export function meantText(typed: string, type: string): string {
  const quote = quoteOf(type);
  if (typed.length < 2 || !typed.startsWith(quote) || !typed.endsWith(quote)) return typed;
  const code = type === 'WSTRING' ? /\$([\da-f]{4}|.)/gis : /\$([\da-f]{2}|.)/gis;
  return typed.slice(1, -1).replace(code, (_, escape: string) =>
    escape.length > 1 ? String.fromCharCode(parseInt(escape, 16)) : (CONTROLS[escape.toUpperCase()] ?? escape));
}

// What an input of one line begins with.
export function typedText(text: string, type: string): string {
  const quote = quoteOf(type);
  const looksQuoted = text.length >= 2 && text.startsWith(quote) && text.endsWith(quote);
  return looksQuoted || /[\u0000-\u001f\u007f]/.test(text) ? literal(text, type) : text;
}

// What is sent for what was typed: nothing is the empty text.
export const sentText = (typed: string, type: string): string => (typed === '' ? quoteOf(type).repeat(2) : typed);
