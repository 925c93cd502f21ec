// What is said of tags as a table (RFC 4180) that a spreadsheet opens and the cell reads again: cell/config/tag_table.h.

import type { Tag, TagNote } from '../lib/protocol';
import { TagNotes } from '../lib/tag_notes';

const COLUMNS = ['name', 'type', 'address', 'unit', 'description', 'group', 'decimals', 'least', 'greatest', 'values'];

// A name may have the sign that stands between names.
const escaped = (name: string) => name.replace(/[\\|]/g, '\\$&');
const field = (text: string) => (/[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);

// Every tag of the program in its order, then what else is described: points of the plant, tags of other programs. What is said of
// an array stands at the array's own name, once.
export function tagTable(tags: readonly Tag[], said: readonly TagNote[]): string {
  const notes = new TagNotes(said, tags);
  const rows = [COLUMNS];
  const told = new Set<string>();
  const add = (name: string, note: TagNote | undefined, tag?: Tag) => {
    if (told.has(name.toLowerCase())) return;
    told.add(name.toLowerCase());
    const [least, greatest] = note?.normal ?? ['', ''];
    rows.push([
      name, tag?.type ?? '', tag?.address ?? '', note?.unit ?? '', note?.description ?? tag?.comment ?? '', note?.group ?? '',
      String(note?.decimals ?? ''), String(least), String(greatest), note?.values?.map(escaped).join('|') ?? '',
    ]);
  };
  for (const tag of tags) {
    const note = notes.of(tag.name);
    add(note && note.name.toLowerCase() !== tag.name.toLowerCase() ? note.name : tag.name, note, tag);
  }
  for (const note of said) add(note.name, note);
  return rows.map((row) => `${row.map(field).join(',')}\r\n`).join('');
}
