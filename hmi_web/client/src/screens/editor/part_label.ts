// The words of an operator part as the editor draws them: as on the page, but in SVG, which breaks no lines by itself. Pure.

import { labelOf, linesIn } from '../parts';
import { escaped } from './template';

// What people call a variable, by its name.
export type Called = (name: string) => string;
export const byName: Called = (name) => name;

const SIZE = 14;
const LINE = 17;
const EDGE = 6;
const ELLIPSIS = '…';

// In widths of a letter's height, rather too wide: fonts differ.
function widthOf(text: string): number {
  let sum = 0;
  for (const sign of text) sum += /[iljtfrI.,:;'|!()[\] ]/.test(sign) ? 0.38 : /[mwMW@%…]/.test(sign) ? 0.98 : /[A-Z]/.test(sign) ? 0.72 : sign > '\u2000' ? 1 : 0.62;
  return sum;
}

// As many of the first signs as have room, one in any case.
function headOf(text: string, room: number): string {
  const signs = [...text];
  let count = signs.length;
  while (count > 1 && widthOf(signs.slice(0, count).join('')) > room) count -= 1;
  return signs.slice(0, count).join('');
}

function wrapped(text: string, room: number): string[] {
  const lines: string[] = [];
  let line = '';
  for (const word of text.split(/\s+/)) {
    const longer = line === '' ? word : `${line} ${word}`;
    if (widthOf(longer) <= room) {
      line = longer;
      continue;
    }
    if (line !== '') lines.push(line);
    line = word;
    while (widthOf(line) > room && [...line].length > 1) {
      lines.push(headOf(line, room));
      line = line.slice(lines.at(-1)?.length);
    }
  }
  return [...lines, line];
}

// At most so many lines of so many units of the drawing; what has no room in them ends with an ellipsis.
export function fitted(text: string, width: number, most: number): string[] {
  const room = width / SIZE;
  const lines = wrapped(text, room);
  if (lines.length <= most) return lines;
  const last = `${lines[most - 1] ?? ''} ${lines[most] ?? ''}`;
  return [...lines.slice(0, most - 1), headOf(last, room - widthOf(ELLIPSIS)).trimEnd() + ELLIPSIS];
}

// In the middle of a part of that size; whole in its title where it is cut.
export function partLabel(words: string, width: number, height: number): string {
  const lines = fitted(words, width - 2 * EDGE, linesIn(height));
  const first = height / 2 + 5 - ((lines.length - 1) * LINE) / 2;
  const title = lines.at(-1)?.endsWith(ELLIPSIS) ? `<title>${escaped(words)}</title>` : '';
  const inside = lines.length === 1 ? escaped(lines[0] ?? '') : lines.map((line, at) => `<tspan x="${width / 2}" y="${first + at * LINE}">${escaped(line)}</tspan>`).join('');
  return `<text x="${width / 2}" y="${first}" text-anchor="middle" font-size="${SIZE}">${title}${inside}</text>`;
}

// What stands in a face is written anew once its fields are filled in: before, nobody knows how long it is, or what it names.
const PART = /(<g\b[^>]* data-part="[^"]*"[^>]*><rect width="([\d.]+)" height="([\d.]+)"[^>]*?(?:\/>|><\/rect>))<text[^>]*>.*?<\/text>/gs;
const ENTITIES: Record<string, string> = { amp: '&', lt: '<', gt: '>', quot: '"', '#39': "'" };
const plain = (text: string): string => text.replace(/&(amp|lt|gt|quot|#39);/g, (_, name: string) => ENTITIES[name] ?? '');
export function relabelled(markup: string, called: Called): string {
  return markup.replace(PART, (whole: string, head: string, width: string, height: string) => {
    const read = (name: string) => plain(new RegExp(` data-${name}="([^"]*)"`).exec(head)?.[1] ?? '');
    const words = labelOf({ label: read('label'), go: read('go'), write: read('write') }, called);
    return words === '' ? whole : head + partLabel(words, Number(width), Number(height));
  });
}
