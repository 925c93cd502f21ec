// Where variables are used, and what a search finds. A variable is known by its whole path ("Main.timer.Q", "Alarm"), as tags
// are; a sheet that runs in several instances is looked at in each of them.

import type { Access, Block, Diagram, Sheet, Sources, Use } from './document';
import { homeOf, instancesOf, Scope, TagTable } from './scope';
import { t } from './texts';

export interface Place {
  sheet: number;
  instance: string;
  block: number; // -1: the sheet as a whole
  line: number; // 0: the block as a whole
}

export interface Found extends Place {
  access: Access;
  where: string; // "Main, line 12"
  text: string;
}

const MOST_FOUND = 400;

// The whole covers its parts: what reads "timer" reads "timer.Q".
export function touches(a: string, b: string): boolean {
  const [short, long] = (a.length < b.length ? [a, b] : [b, a]).map((path) => path.toLowerCase()) as [string, string];
  return long.startsWith(short) && (long.length === short.length || long[short.length] === '.' || long[short.length] === '[');
}

function elementName(block: Diagram, line: number): string {
  const element = block.elements[line - 1];
  return element?.kind === 'block' ? t('block', { name: element.instance || element.name }) : t('connection');
}

export function placeName(block: Block | undefined, line: number): string {
  switch (block?.kind) {
    case 'text':
      return t('atLine', { line: String(block.first + Math.max(1, line) - 1) });
    case 'rung':
      return t('network', { number: String(block.number) });
    case 'step':
      return t('atStep', { name: block.name });
    case 'transition':
      return t('atTransition', { name: block.name });
    case 'action':
      return t('atAction', { name: block.name, line: String(Math.max(1, line)) });
    case 'diagram':
      return t('drawn', { element: elementName(block, line) });
    default:
      return '';
  }
}

function conditionText(block: Block | undefined): string {
  if (block?.kind !== 'rung') return '';
  const names = [...block.coils.map((coil) => coil.name), ...block.boxes.map((box) => box.instance || box.type)];
  return block.comment || names.filter((name) => name !== '').join(', ');
}

export function placeText(block: Block | undefined, line: number): string {
  if (block?.kind === 'text' || block?.kind === 'action' || block?.kind === 'transition') {
    return (block.lines[Math.max(1, line) - 1] ?? '').trim();
  }
  if (block?.kind === 'diagram') return block.elements[line - 1]?.name ?? '';
  return block?.kind === 'step' ? block.comment : conditionText(block);
}

export const titleOf = (sheet: Sheet) => sheet.name || (sheet.kind === 'VAR_GLOBAL' ? t('globals') : sheet.kind === 'TYPE' ? t('types') : sheet.kind);

function found(sources: Sources, sheet: number, instance: string, use: Use): Found {
  const of = sources.sheets[sheet] as Sheet;
  const block = of.blocks[use.block];
  const shown = instance !== '' && instance.toLowerCase() !== of.name.toLowerCase() ? `${of.name} (${instance})` : titleOf(of);
  return {
    sheet,
    instance,
    block: use.block,
    line: use.line,
    access: use.access,
    where: `${shown}, ${placeName(block, use.line)}`,
    text: placeText(block, use.line),
  };
}

// Only an instance that holds the variable, or any of a sheet that uses a global, can use it: the others are left out unread.
export function crossReference(target: string, sources: Sources, tags: TagTable): Found[] {
  const list: Found[] = [];
  const seen = new Set<string>();
  sources.sheets.forEach((sheet, index) => {
    for (const instance of instancesOf(sheet, sources.instances)) {
      const scope = new Scope(sheet, instance, tags);
      for (const use of sheet.uses) {
        const path = scope.resolve(use.path);
        if (path === '' || !touches(path, target) || list.length >= MOST_FOUND) continue;
        const key = `${index} ${instance} ${use.block} ${use.line} ${use.access}`;
        if (seen.has(key)) continue;
        seen.add(key);
        list.push(found(sources, index, instance, use));
      }
    }
  });
  return list.sort((a, b) => Number(a.access === 'read') - Number(b.access === 'read'));
}

export type Hit = { title: string; detail: string; kind: string } & ({ place: Place } | { target: string });

const MOST_HITS = 60;

function rank(name: string, wanted: string): number {
  const at = name.toLowerCase().indexOf(wanted);
  if (at < 0) return 3;
  return name.length === wanted.length ? 0 : at === 0 || name[at - 1] === '.' ? 1 : 2;
}

function textHits(sheet: Sheet, index: number, instance: string, wanted: string): Hit[] {
  const hits: Hit[] = [];
  const add = (block: number, line: number, title: string) => {
    const place = { sheet: index, instance, block, line };
    hits.push({ kind: 'text', title, detail: `${titleOf(sheet)}, ${placeName(sheet.blocks[block], line)}`, place });
  };
  sheet.blocks.forEach((block, at) => {
    if (block.kind === 'text' || block.kind === 'action' || block.kind === 'transition') {
      block.lines.forEach((line, i) => {
        if (line.toLowerCase().includes(wanted)) add(at, i + 1, line.trim());
      });
    } else if (block.kind === 'step' && `${block.name} ${block.comment}`.toLowerCase().includes(wanted)) {
      add(at, 0, `${block.name} ${block.comment}`.trim());
    } else if (block.kind === 'rung' && `${block.label} ${block.comment}`.toLowerCase().includes(wanted)) {
      add(at, 0, block.comment || block.label);
    }
  });
  return hits;
}

// Sheets, then variables, then texts; the best first.
export function search(query: string, sources: Sources, tags: TagTable): Hit[] {
  const wanted = query.trim().toLowerCase();
  if (wanted === '') return [];
  const sheets: Hit[] = sources.sheets.flatMap((sheet, index) => {
    const instance = instancesOf(sheet, sources.instances)[0] ?? '';
    const place = { sheet: index, instance, block: -1, line: 0 };
    return rank(titleOf(sheet), wanted) < 3 ? [{ kind: 'sheet', title: titleOf(sheet), detail: sheet.kind.replaceAll('_', ' '), place }] : [];
  });
  const names = (tags.program?.tags ?? [])
    .filter((tag) => rank(tag.name, wanted) < 3 || tag.address.toLowerCase() === wanted)
    .sort((a, b) => rank(a.name, wanted) - rank(b.name, wanted) || a.name.length - b.name.length)
    .slice(0, MOST_HITS / 2)
    .map((tag): Hit => ({ kind: 'variable', title: tag.name, detail: `${tag.type} ${tag.address}`.trim(), target: tag.name }));
  const lines = sources.sheets.flatMap((sheet, index) => textHits(sheet, index, instancesOf(sheet, sources.instances)[0] ?? '', wanted));
  return [...sheets, ...names, ...lines].slice(0, MOST_HITS);
}

// Where a tag is at home: its declaration's sheet, in its instance; null for what no sheet declares.
export function declarationOf(target: string, sources: Sources): Place | null {
  const home = homeOf(target, sources);
  if (home) return { ...home, block: -1, line: 0 };
  const name = target.toLowerCase();
  const sheet = sources.sheets.findIndex((one) => one.variables.some((v) => v.section === 'VAR_GLOBAL' && touches(v.name, name)));
  return sheet < 0 ? null : { sheet, instance: '', block: -1, line: 0 };
}
