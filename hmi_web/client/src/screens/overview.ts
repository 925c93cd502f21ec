// What a cell without any picture opens on: its tags by group. Pure.

import type { Tag } from '../lib/protocol';
import type { TagNotes } from '../lib/tag_notes';

export interface Row {
  index: number; // in the program
  name: string;
  words: string; // what people call it
  isNumber: boolean; // it can be drawn over time
}
export interface Group {
  name: string;
  rows: Row[];
}

const NUMBER = /^(L?REAL|U?[SDL]?INT|BOOL|L?TIME)$/; // a TIME is a number of seconds
// "Main.pump" of "Main.pump.speed"; of everything in an array the array.
function ownerOf(name: string): string {
  const array = name.indexOf('[');
  return name.slice(0, array >= 0 ? array : Math.max(0, name.lastIndexOf('.')));
}

// By the groups that the cell says, then by the instance or the array that they belong to.
export function groupsOf(tags: readonly Tag[], notes: TagNotes): Group[] {
  const said = new Map<string, Row[]>();
  const others = new Map<string, Row[]>();
  tags.forEach((tag, index) => {
    const note = notes.of(tag.name);
    const [groups, name] = note?.group ? [said, note.group] : [others, ownerOf(tag.name)];
    const row = { index, name: tag.name, words: notes.calledBy(tag.name), isNumber: NUMBER.test(tag.type) };
    groups.set(name, [...(groups.get(name) ?? []), row]);
  });
  return [...said, ...others].map(([name, rows]) => ({ name, rows }));
}

// The first to be drawn: those of which the cell says something, then any numbers.
export function firstDrawn(groups: readonly Group[], notes: TagNotes, most: number): string[] {
  const rows = groups.flatMap((group) => group.rows).filter(({ isNumber }) => isNumber);
  const known = rows.filter(({ name }) => notes.of(name));
  return [...known, ...rows.filter((row) => !known.includes(row))].slice(0, most).map(({ name }) => name);
}

const MOST_LINES = 6; // of the overview's trend: each has its colour

// What is drawn once somebody has pressed one; null: there is no colour left, and nothing is taken away for it.
export function picked(lines: readonly string[], name: string): string[] | null {
  if (lines.includes(name)) return lines.filter((each) => each !== name);
  return lines.length < MOST_LINES ? [...lines, name] : null;
}

// What a browser kept of somebody's choice, of those that there are; null: nobody has chosen, or none of them is there.
export function pickedBefore(text: string | null, known: readonly string[]): string[] | null {
  try {
    const kept: unknown = JSON.parse(text ?? 'null');
    if (!Array.isArray(kept)) return null;
    const there = known.filter((name) => kept.includes(name));
    const inOrder = kept.filter((name): name is string => there.includes(name as string)).slice(0, MOST_LINES);
    return kept.length === 0 || inOrder.length > 0 ? inOrder : null;
  } catch {
    return null;
  }
}
