// Two programs' sources side by side, sheet by sheet and line by line. What is the same is folded but for a few lines around
// what is not.

import { diffArrays } from 'diff';

import type { Sheet } from '../program/document';
import { linesOf, type Line } from './sheet_lines';

export interface Row {
  kind: 'same' | 'added' | 'removed';
  text: string;
  before: number; // number of the line on each side; 0: it has none
  after: number;
}

// Rows that are shown, or so many that are folded.
export type Stretch = { folded: boolean; rows: Row[] };

export interface SheetDiff {
  name: string;
  kind: string;
  language: string;
  file: string;
  state: 'same' | 'changed' | 'added' | 'removed';
  added: number; // lines
  removed: number;
  stretches: Stretch[];
}

const AROUND = 3;
// Texts that have less in common than that are shown as one going and the other coming: finding the shortest way between them
// takes a time that grows with the square of it.
const MOST_EDITS = 4_000;

export function compareLines(before: Line[], after: Line[]): Row[] {
  const texts = (lines: Line[]) => lines.map(({ text }) => text.trimEnd());
  const parts = diffArrays(texts(before), texts(after), { maxEditLength: MOST_EDITS });
  const removed = (line: Line): Row => ({ kind: 'removed', text: line.text, before: line.number, after: 0 });
  const added = (line: Line): Row => ({ kind: 'added', text: line.text, before: 0, after: line.number });
  if (parts === undefined) return [...before.map(removed), ...after.map(added)];
  const rows: Row[] = [];
  let left = 0;
  let right = 0;
  for (const part of parts) {
    for (const _ of part.value) {
      if (part.removed) {
        rows.push(removed(before[left]!));
        left += 1;
      } else if (part.added) {
        rows.push(added(after[right]!));
        right += 1;
      } else {
        rows.push({ kind: 'same', text: after[right]!.text, before: before[left]!.number, after: after[right]!.number });
        left += 1;
        right += 1;
      }
    }
  }
  return rows;
}

// A single line that is left out would be replaced by one that says so.
export function fold(rows: Row[]): Stretch[] {
  const near = rows.map(() => false);
  rows.forEach(({ kind }, index) => {
    if (kind !== 'same') near.fill(true, Math.max(0, index - AROUND), index + AROUND + 1);
  });
  const stretches: Stretch[] = [];
  rows.forEach((row, index) => {
    const folded = !near[index];
    const last = stretches.at(-1);
    if (last && last.folded === folded) last.rows.push(row);
    else stretches.push({ folded, rows: [row] });
  });
  return stretches.map((one) => (one.folded && one.rows.length === 1 ? { ...one, folded: false } : one));
}

// Sheets that are one and the same to people: upper and lower case are one in IEC 61131-3.
const keyOf = ({ name, kind, file }: Sheet): string => `${kind} ${name === '' ? file : name}`.toLowerCase();

function diffOf(sheet: Sheet, rows: Row[], state: SheetDiff['state']): SheetDiff {
  const count = (kind: Row['kind']) => rows.filter((row) => row.kind === kind).length;
  const { name, kind, language, file } = sheet;
  return { name, kind, language, file, state, added: count('added'), removed: count('removed'), stretches: state === 'same' ? [] : fold(rows) };
}

// In the order of the new program; what has gone comes last.
export function compareSheets(before: Sheet[], after: Sheet[]): SheetDiff[] {
  const old = new Map(before.map((sheet) => [keyOf(sheet), sheet]));
  const now = new Set(after.map(keyOf));
  const stays = after.map((sheet) => {
    const was = old.get(keyOf(sheet));
    const rows = compareLines(was ? linesOf(was) : [], linesOf(sheet));
    return diffOf(sheet, rows, !was ? 'added' : rows.every(({ kind }) => kind === 'same') ? 'same' : 'changed');
  });
  const gone = before.filter((sheet) => !now.has(keyOf(sheet))).map((sheet) => diffOf(sheet, compareLines(linesOf(sheet), []), 'removed'));
  return [...stays, ...gone];
}
