// A screen as it is drawn: its settings, and its symbols from back to front. Plain values that never change.

import { boundMarkup } from './drawn_elements';
import { byName, relabelled, type Called } from './part_label';
import { attribute, escaped, type Params } from './template';
import { templateOf } from './symbols';

export type Least = 'viewer' | 'operator' | 'engineer';
const LEASTS: readonly Least[] = ['viewer', 'operator', 'engineer'];
export const roleSees = (role: Least, least: Least): boolean => LEASTS.indexOf(role) >= LEASTS.indexOf(least);

export interface Settings {
  width: number;
  height: number;
  title: string;
  least: Least;
  symbol: boolean; // a face for others to repeat
  more: Record<string, string>; // attributes that a drawing of another program has
  defs: string; // and its definitions
}

export interface Item {
  key: string; // its name in the screen
  symbol: string; // kind of its template; "face": of a symbol of one's own; "drawn": of another program
  x: number;
  y: number;
  w: number;
  h: number;
  turn: number; // degrees: 0, 90, 180, 270
  group: string; // empty: none
  params: Params;
  markup: string; // of what is drawn
}

export interface Content {
  settings: Settings;
  items: readonly Item[];
}

// A symbol of one's own: what it is drawn from, and the parameters that stand in it as {name}.
export interface Face {
  name: string;
  width: number;
  height: number;
  inner: string;
  params: string[];
}
export type Faces = ReadonlyMap<string, Face>;

export const EMPTY: Content = {
  settings: { width: 800, height: 450, title: '', least: 'viewer', symbol: false, more: {}, defs: '' },
  items: [],
};

const PLACEHOLDER = /\{(\w+)\}/g;

// The face with its parameters put in. Parts in it have keys of their own wherever it stands.
export function filledFace(face: Face, params: Params, key: string, called: Called = byName): string {
  const filled = face.inner
    .replace(/data-key="([^"]*)"/g, (_, own: string) => `data-key="${key}-${own}"`)
    .replace(PLACEHOLDER, (whole, name: string) => escaped(params[name]?.trim() ?? '') || whole);
  return relabelled(filled, called);
}

// What stands inside of the element of an item. `called`: what people call a variable; in a file it has its name.
export function innerOf(item: Item, faces: Faces, called: Called = byName): string {
  if (item.symbol === 'drawn') return boundMarkup(item.markup, item.params);
  if (item.symbol === 'face') {
    const face = faces.get(item.params.face ?? '');
    return face ? `<g transform="scale(${round(item.w / face.width)} ${round(item.h / face.height)})">${filledFace(face, item.params, item.key, called)}</g>` : item.markup;
  }
  const template = templateOf(item.symbol);
  if (!template) return item.markup;
  return turnedInto(item, (params, width, height) => template.draw(params, width, height, called)) + (template.beside?.(item.params, item.w, item.h) ?? '');
}

// What is turned by a quarter fills the same box: it is drawn as long as the box is high.
function turnedInto({ params, w, h, turn }: Item, draw: (params: Params, width: number, height: number) => string): string {
  if (turn === 0) return draw(params, w, h);
  const [across, down] = turn % 180 === 0 ? [w, h] : [h, w];
  return `<g transform="translate(${round(w / 2)} ${round(h / 2)}) rotate(${turn}) translate(${round(-across / 2)} ${round(-down / 2)})">${draw(params, across, down)}</g>`;
}

const round = (value: number) => Number(value.toFixed(3));

export const transformOf = (item: Pick<Item, 'x' | 'y'>): string => `translate(${round(item.x)} ${round(item.y)})`;

// What is kept of an item beside its picture; a picture of pixels stands in the image itself.
function kept({ key, w, h, turn, group, params }: Item): string {
  const { picture: _picture, ...rest } = params;
  const said = Object.fromEntries(Object.entries(rest).filter(([, value]) => value));
  return JSON.stringify({ ...said, key, w: round(w), h: round(h), ...(turn ? { turned: turn } : {}), ...(group ? { group } : {}) });
}

function written(item: Item, faces: Faces): string {
  const part = templateOf(item.symbol)?.attributes?.(item.params, item.key) ?? '';
  return `<g data-symbol="${escaped(item.symbol)}"${attribute('data-params', kept(item))} transform="${transformOf(item)}"${part}>${innerOf(item, faces)}</g>`;
}

// The screen as a file.
export function svgOf({ settings, items }: Content, faces: Faces): string {
  const { width, height, least, symbol, title, more, defs } = settings;
  const own = attribute('data-least', least === 'viewer' ? '' : least) + attribute('data-kind', symbol ? 'symbol' : '');
  const others = Object.entries(more).map(([name, value]) => attribute(name, value)).join('');
  const parts = items.map((item) => written(item, faces)).join('\n');
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}"${own}${others}>\n${title ? `<title>${escaped(title)}</title>\n` : ''}${defs}${parts}\n</svg>`;
}

// What stands in that line of the file.
export function itemInLine(content: Content, faces: Faces, line: number): Item | undefined {
  const linesOf = (text: string) => text.split('\n').length;
  let next = linesOf(svgOf({ ...content, items: [] }, faces)) - 1;
  return content.items.find((item) => {
    const first = next;
    next += linesOf(written(item, faces));
    return line >= first && line < next;
  });
}

// A name that nothing in the screen has yet.
export function nextKey(items: readonly Item[], taken: readonly string[] = []): string {
  const keys = new Set([...items.map(({ key }) => key), ...taken]);
  for (let number = items.length + 1; ; number++) if (!keys.has(`p${number}`)) return `p${number}`;
}
