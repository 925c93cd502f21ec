// Lines of ST as they are shown: pieces of text, of which some are variables, and the values that belong to a line.

import type { Use } from './document';
import { placeKey, type BodyValues } from './live';
import type { Live } from './scope';

export interface Piece {
  text: string;
  kind: 'plain' | 'keyword' | 'comment' | 'literal' | 'variable';
  path: string; // of a variable
}

const KEYWORDS = new Set(
  `
    IF THEN ELSIF ELSE END_IF CASE OF END_CASE FOR TO BY DO END_FOR WHILE END_WHILE REPEAT UNTIL END_REPEAT EXIT
    CONTINUE RETURN AND OR XOR NOT MOD TRUE FALSE TYPE END_TYPE STRUCT END_STRUCT ARRAY CONFIGURATION
    END_CONFIGURATION RESOURCE END_RESOURCE TASK PROGRAM WITH ON VAR_GLOBAL END_VAR AT RETAIN CONSTANT AND_THEN
    OR_ELSE
  `.trim().split(/\s+/),
);
const WORDS = /(\(\*|\/\*|\/\/.*)|('[^']*'|"[^"]*")|((?:[A-Za-z]+#)[-\w.]+|\b\d[\w.]*)|([A-Za-z_]\w*)/g;

// Of text without variables and comments.
function plainPieces(text: string): Piece[] {
  const pieces: Piece[] = [];
  let end = 0;
  const add = (piece: string, kind: Piece['kind']) => {
    if (piece !== '') pieces.push({ text: piece, kind, path: '' });
  };
  for (const found of text.matchAll(WORDS)) {
    const [word, , string, literal, name] = found;
    if (found.index < end) continue;
    const keyword = name !== undefined && KEYWORDS.has(name.toUpperCase());
    if (!string && !literal && !keyword) continue;
    add(text.slice(end, found.index), 'plain');
    add(word, keyword ? 'keyword' : 'literal');
    end = found.index + word.length;
  }
  add(text.slice(end), 'plain');
  return pieces;
}

// Each line's part that is a comment, as ranges [from, to).
export function commentRanges(lines: readonly string[]): [number, number][][] {
  let close = ''; // of the comment that is open
  return lines.map((line) => {
    const ranges: [number, number][] = [];
    let at = 0;
    while (at < line.length) {
      if (close !== '') {
        const end = line.indexOf(close, at);
        ranges.push([at, end < 0 ? line.length : end + 2]);
        if (end < 0) return ranges;
        close = '';
        at = end + 2;
        continue;
      }
      const found = /\(\*|\/\*|\/\/|'[^']*'|"[^"]*"/g;
      found.lastIndex = at;
      const next = found.exec(line);
      if (!next) return ranges;
      at = next.index;
      if (next[0] === '//') {
        ranges.push([at, line.length]);
        return ranges;
      }
      if (next[0] === '(*' || next[0] === '/*') close = next[0] === '(*' ? '*)' : '*/';
      else at += next[0].length;
    }
    return ranges;
  });
}

// `uses` are those of this line.
export function pieces(line: string, uses: readonly Use[], comments: readonly [number, number][]): Piece[] {
  const marks = [
    ...uses.map((use) => ({ from: use.column - 1, to: use.column - 1 + use.length, kind: 'variable' as const, path: use.path })),
    ...comments.map(([from, to]) => ({ from, to, kind: 'comment' as const, path: '' })),
  ].sort((a, b) => a.from - b.from);
  // Columns count characters, of which some are two units of a string.
  const letters = [...line];
  const cut = (from: number, to: number) => letters.slice(from, to).join('');
  const list: Piece[] = [];
  let end = 0;
  for (const mark of marks) {
    if (mark.from < end) continue;
    list.push(...plainPieces(cut(end, mark.from)));
    list.push({ text: cut(mark.from, mark.to), kind: mark.kind, path: mark.path });
    end = mark.to;
  }
  list.push(...plainPieces(cut(end, letters.length)));
  return list;
}

export type LiveOf = (path: string) => Live;

export interface LineValue {
  name: string;
  live: Live;
}

// What a line speaks of, each once, with its value; of a block that is called its outputs, of an element what its index stands for.
export function lineValues(uses: readonly Use[], live: LiveOf, outputsOf: (path: string) => string[], body: BodyValues | undefined): LineValue[] {
  const values = new Map<string, LineValue>();
  const add = (name: string) => {
    const one = live(name);
    if (one.type !== '') values.set(name.toLowerCase(), { name, live: one });
  };
  for (const use of uses) {
    if (use.access !== 'call') {
      add(body?.indexed.get(placeKey(use.line, use.column)) ?? use.path);
      continue;
    }
    for (const output of outputsOf(use.path)) add(`${use.path}.${output}`);
  }
  return [...values.values()];
}
