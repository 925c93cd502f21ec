// A file as the screen that it was drawn as; what other programs have drawn stays as it is, each element a symbol of its own.
// Needs the browser's parser.

import { fieldsIn } from '../../drawing/bindings';
import { liftedFrom } from './drawn_elements';
import { EMPTY, nextKey, type Content, type Face, type Item, type Least, type Settings } from './model';
import { templateOf } from './symbols';

const OWN = ['xmlns', 'viewBox', 'data-least', 'data-kind', 'width', 'height'];
const number = (text: unknown, usual: number): number => {
  const value = Number(text ?? NaN);
  return Number.isFinite(value) ? value : usual;
};

function parsed(svg: string): SVGSVGElement {
  const root = new DOMParser().parseFromString(svg, 'image/svg+xml').documentElement;
  if (!(root instanceof SVGSVGElement)) throw new Error('no drawing');
  return root;
}

// Elements of a document of its own name their language each: here it is that of the document around them.
const plain = (element: Element): string => element.outerHTML.replaceAll(' xmlns="http://www.w3.org/2000/svg"', '');
const innerOf = (element: Element): string => element.innerHTML.replaceAll(' xmlns="http://www.w3.org/2000/svg"', '');

function viewBox(root: SVGSVGElement): { x: number; y: number; width: number; height: number } {
  const [x = 0, y = 0, width = 0, height = 0] = (root.getAttribute('viewBox') ?? '').split(/[\s,]+/).map(Number);
  return { x, y, width: width || EMPTY.settings.width, height: height || EMPTY.settings.height };
}

function paramsOf(element: Element): Record<string, unknown> | null {
  try {
    const found: unknown = JSON.parse(element.getAttribute('data-params') ?? '');
    return typeof found === 'object' && found !== null && !Array.isArray(found) ? (found as Record<string, unknown>) : null;
  } catch {
    return null;
  }
}

function symbolOf(element: Element): Item | null {
  const symbol = element.getAttribute('data-symbol') ?? '';
  const template = templateOf(symbol);
  const found = paramsOf(element);
  if (!found || (!template && symbol !== 'face' && symbol !== 'drawn')) return null;
  const [, x, y] = /^translate\(([-\d.]+) ([-\d.]+)\)$/.exec(element.getAttribute('transform') ?? '') ?? [];
  if (x === undefined) return null;
  const { key, w, h, turn, turned, group, ...rest } = found;
  const params = Object.fromEntries(Object.entries(rest).filter((each): each is [string, string] => typeof each[1] === 'string'));
  const inside = symbol === 'drawn' ? element.firstElementChild : null;
  if (inside) Object.assign(params, liftedFrom(inside));
  const picture = symbol === 'picture' ? element.querySelector('image')?.getAttribute('href') : null;
  const item: Item = {
    key: typeof key === 'string' ? key : '',
    symbol,
    x: number(x, 0),
    y: number(y, 0),
    w: number(w, template?.width ?? 100),
    h: number(h, template?.height ?? 100),
    turn: number(turned, 0),
    group: typeof group === 'string' ? group : '',
    params: picture ? { ...params, picture } : params,
    markup: symbol === 'drawn' || symbol === 'face' ? innerOf(element) : '',
  };
  return turned === undefined && turn !== undefined ? turnedAsBefore(item, number(turn, 0)) : item;
}

// An earlier editor kept the box of what is not turned yet.
function turnedAsBefore(item: Item, turn: number): Item {
  if (turn % 180 === 0) return { ...item, turn };
  const { x, y, w, h } = item;
  return { ...item, turn, x: x + (w - h) / 2, y: y + (h - w) / 2, w: h, h: w };
}

// Throws an Error if it is no SVG.
export function contentOf(svg: string): Content {
  const root = parsed(svg);
  const box = viewBox(root);
  const settings: Settings = {
    width: box.width,
    height: box.height,
    title: root.querySelector(':scope > title')?.textContent.trim() ?? '',
    least: (root.getAttribute('data-least') as Least | null) ?? 'viewer',
    symbol: root.getAttribute('data-kind') === 'symbol',
    more: Object.fromEntries([...root.attributes].filter(({ name }) => !OWN.includes(name)).map(({ name, value }) => [name, value])),
    defs: [...root.querySelectorAll(':scope > defs')].map(plain).join(''),
  };
  const items: Item[] = [];
  for (const element of root.children) {
    if (['title', 'desc', 'defs'].includes(element.tagName)) continue;
    const found = symbolOf(element);
    const params = found ? {} : liftedFrom(element);
    const drawn: Item = { key: '', symbol: 'drawn', x: -box.x, y: -box.y, w: 0, h: 0, turn: 0, group: '', params, markup: plain(element) };
    const item = found ?? drawn;
    const isTaken = item.key === '' || items.some(({ key }) => key === item.key);
    items.push(isTaken ? { ...item, key: nextKey(items) } : item);
  }
  return { settings, items };
}

export function faceOf(name: string, svg: string): Face {
  const root = parsed(svg);
  const { width, height } = viewBox(root);
  const inner = innerOf(root);
  // What its own symbols remember of themselves stays with the face.
  const bare = inner.replace(/ data-(symbol|params)="[^"]*"/g, '');
  return { name, width, height, inner: bare, params: fieldsIn(bare) };
}
