// What the cell and the program say of a tag beside its value: hmi_web/doc/tags.md.

import { fixed, isDate, isTime, short, tagValue } from './format';
import type { ProgramMessage, Tag, TagNote } from './protocol';
import { isLongInteger, isRounded, type TagValue, type Value } from './value';

// IEC 61131-3 does not tell upper and lower case apart.
const fold = (name: string) => name.toLowerCase();
const withoutIndices = (name: string) => name.replace(/\[[^\]]*\]/g, '');
export const hasDecimals = (type: string) => type !== 'BOOL' && !isTime(type); // which people choose

const ROUNDED_DIGITS = 15; // that are certain
const MOST = 1e9; // beyond it the power of ten says more than digits

export class TagNotes {
  private readonly byName: Map<string, TagNote>;
  private readonly comments: Map<string, string>; // of the declarations

  // `tags`: those of the program, whose declarations say what the cell leaves open.
  constructor(notes: readonly TagNote[] = [], tags: readonly Tag[] = []) {
    this.byName = new Map(notes.map((note) => [fold(note.name), note]));
    this.comments = new Map(tags.filter(({ comment }) => comment).map(({ name, comment }) => [fold(name), comment ?? '']));
    for (const { name, note } of tags) {
      if (note) this.byName.set(fold(name), { name: withoutIndices(name), ...note, ...this.of(name) });
    }
  }

  // By its whole name; of an element of an array also by that of the array.
  of(name: string): TagNote | undefined {
    if (this.byName.size === 0) return undefined;
    const key = fold(name);
    return this.byName.get(key) ?? this.byName.get(withoutIndices(key));
  }

  // What it is, in words: of the cell, of the declaration, or of its comment; '': nobody says it.
  descriptionOf(name: string): string {
    return this.of(name)?.description ?? this.comments.get(fold(name)) ?? '';
  }

  // By what people call it. What is said of an array is said of every element: which one it is stands behind it.
  calledBy(name: string): string {
    const said = this.descriptionOf(name);
    return said && name.includes('[') ? `${said} ${name.slice(name.indexOf('['))}` : said || name;
  }
}

// The name of a value of an enumeration, of the cell or of the program; any other value as it is.
export function nameOr(value: TagValue, names: Record<string, string> | undefined, note?: TagNote): TagValue {
  if (typeof value !== 'number') return value;
  return note?.values?.[value] ?? names?.[String(value)] ?? value;
}

export function enumerationOf(program: ProgramMessage | null, index: number): Record<string, string> | undefined {
  const number = program?.tags[index]?.enumeration;
  return number === undefined ? undefined : program?.enumerations[number];
}

// As a person reads it in the page's language, with its unit: "12.5 l", "by hand", "TRUE". A time has its own unit, whatever is said of it.
export function told(value: TagValue | undefined, type: string, note?: TagNote, names?: Record<string, string>): string {
  const named = nameOr(value ?? null, names, note);
  if (typeof named === 'string' && typeof value === 'number') return named;
  if (typeof named === 'string' && isLongInteger(type)) return withUnit(named, note);
  if (typeof named !== 'number') return tagValue(named, type);
  if (isTime(type) || isDate(type)) return tagValue(named, type);
  if (isRounded(named, type)) return withUnit(`≈ ${Number(named.toPrecision(ROUNDED_DIGITS))}`, note);
  const chosen = note?.decimals !== undefined && hasDecimals(type) && Math.abs(named) < MOST;
  return withUnit(chosen ? fixed(named, note.decimals ?? 0) : tagValue(named, type), note);
}

// The same of a number that was kept, in the history or of an alarm, maybe of a tag that the program has no more: it has no type then.
export function toldNumber(value: Value | undefined, note?: TagNote, names?: Record<string, string>, type = ''): string {
  if (type !== '') return told(value, type, note, names);
  const named = nameOr(value ?? null, names, note);
  if (typeof named === 'string') return named;
  if (named === null) return short(named);
  return withUnit(note?.decimals === undefined ? short(named) : fixed(named, note.decimals), note);
}

const withUnit = (text: string, note?: TagNote) => (note?.unit ? `${text} ${note.unit}` : text);

// Of a point of the picture: what the cell says of its id, and else what the picture knows. `decimals`: where the cell says none.
export function pointNote(point: { id: string; label: string; unit: string }, notes: TagNotes, decimals?: number): TagNote {
  const note = notes.of(point.id);
  const kept = note?.decimals ?? decimals;
  return { ...note, name: point.id, unit: note?.unit ?? point.unit, description: note?.description ?? point.label, ...(kept === undefined ? {} : { decimals: kept }) };
}

// Beyond what the cell calls normal.
export function isAbnormal(value: TagValue | undefined, note?: TagNote): boolean {
  if (typeof value !== 'number' || !note?.normal) return false;
  return value < note.normal[0] || value > note.normal[1];
}
