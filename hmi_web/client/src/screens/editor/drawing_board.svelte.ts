// What is being drawn: its content, what is chosen of it, and the way back.

import { recall, remember } from '../../lib/remembered';
import { freePlace, ownBox, pasted, snapped, withGroups, type Box, type Measure } from './arrange';
import { EMPTY, nextKey, type Content, type Face, type Faces, type Item, type Settings } from './model';
import type { Point } from './points';
import { isByPoints, through } from './sizing';
import { templateOf, usualOf } from './symbols';
import type { Params } from './template';

const CLIPBOARD = 'stepwright.screen-clipboard';
const MOST_STEPS = 200;
const BESIDE = 20; // where a copy lies

export class DrawingBoard {
  content = $state.raw<Content>(EMPTY);
  chosen = $state.raw<ReadonlySet<string>>(new Set());
  grid = $state(10);
  several = $state(false); // what is pressed comes to what is chosen, as with Shift
  faces = $state.raw<Faces>(new Map());
  // A line that is being drawn, point by point, and where the next one would be.
  line = $state.raw<{ symbol: string; points: readonly Point[]; next: Point } | null>(null);
  private past = $state.raw<readonly Content[]>([]);
  private future = $state.raw<readonly Content[]>([]);
  private saved = $state.raw<Content>(EMPTY);
  private lastDeed = ''; // what is typed letter by letter is one step
  private boxes = new Map<string, Box>(); // of what other programs have drawn, as measured

  readonly selection: readonly Item[] = $derived.by(() => this.content.items.filter(({ key }) => this.chosen.has(key)));

  get canUndo(): boolean {
    return this.past.length > 0;
  }
  get canRedo(): boolean {
    return this.future.length > 0;
  }
  get isChanged(): boolean {
    return this.content !== this.saved;
  }

  // Of a file: there is no way back behind it, but what was there.
  open(content: Content, isSaved = true): void {
    if (isSaved) {
      this.past = [];
      this.saved = content;
    } else {
      this.past = [...this.past, this.content];
    }
    this.future = [];
    this.content = content;
    this.chosen = new Set();
    this.lastDeed = '';
  }
  markSaved(content: Content): void {
    this.saved = content;
  }

  // `deed`: the same one again is the same step.
  change(content: Content, deed = ''): void {
    if (deed === '' || deed !== this.lastDeed) this.past = [...this.past.slice(-MOST_STEPS), this.content];
    this.lastDeed = deed;
    this.future = [];
    this.content = content;
  }
  setItems(items: readonly Item[], deed = ''): void {
    this.change({ ...this.content, items }, deed);
  }
  setSettings(settings: Partial<Settings>, deed = ''): void {
    this.change({ ...this.content, settings: { ...this.content.settings, ...settings } }, deed);
  }
  setItem(key: string, changed: Partial<Item>, deed = ''): void {
    this.setItems(this.content.items.map((item) => (item.key === key ? { ...item, ...changed } : item)), deed);
  }
  setParam(keys: ReadonlySet<string>, name: string, value: string): void {
    const items = this.content.items.map((item) => (keys.has(item.key) ? { ...item, params: { ...item.params, [name]: value } } : item));
    this.setItems(items, `${[...keys].join()} ${name}`);
  }

  undo(): void {
    const before = this.past.at(-1);
    if (!before) return;
    this.future = [this.content, ...this.future];
    this.past = this.past.slice(0, -1);
    this.back(before);
  }
  redo(): void {
    const [after, ...rest] = this.future;
    if (!after) return;
    this.past = [...this.past, this.content];
    this.future = rest;
    this.back(after);
  }
  private back(content: Content): void {
    this.content = content;
    this.lastDeed = '';
    this.chosen = new Set([...this.chosen].filter((key) => content.items.some((item) => item.key === key)));
  }

  choose(keys: Iterable<string>): void {
    this.chosen = withGroups(this.content.items, new Set(keys));
    this.lastDeed = '';
  }

  // Comes to what is chosen, or leaves it, with its group.
  toggle(key: string): void {
    const keys = new Set(this.chosen);
    for (const each of withGroups(this.content.items, new Set([key]))) if (!keys.delete(each)) keys.add(each);
    this.choose(keys);
  }

  // Those that may be put in: a face in a face would grow with each save of either.
  get offered(): Face[] {
    return this.content.settings.symbol ? [] : [...this.faces.values()];
  }
  private sizeOf(symbol: string, params: Params): { width: number; height: number } | undefined {
    if (symbol === 'face' && this.offered.length === 0) return undefined;
    return (symbol === 'face' ? this.faces.get(params.face ?? '') : undefined) ?? templateOf(symbol);
  }

  // A new symbol where it lies on nothing, chosen; on a screen that is full a little beside the one before.
  addWhereFree(symbol: string, params: Params = {}): void {
    const { items, settings } = this.content;
    const size = this.sizeOf(symbol, params);
    if (!size) return;
    const shift = BESIDE * (items.length % 8);
    const { x, y } = freePlace(items.map(this.measure), size, settings) ?? { x: settings.width / 2 + shift, y: settings.height / 2 + shift };
    this.add(symbol, x, y, params);
  }

  // A new symbol around a place, chosen.
  add(symbol: string, x: number, y: number, params: Params = {}): void {
    const size = this.sizeOf(symbol, params);
    if (!size) return;
    const key = nextKey(this.content.items);
    const place = (value: number, length: number) => Math.max(0, Math.round((value - length / 2) / 10) * 10);
    const said = { ...usualOf(symbol), ...params };
    const item: Item = { key, symbol, x: place(x, size.width), y: place(y, size.height), w: size.width, h: size.height, turn: 0, group: '', params: said, markup: '' };
    this.setItems([...this.content.items, item]);
    this.choose([key]);
  }
  // The first point is where the pointer or the keys put it.
  beginLine(symbol: string): void {
    this.choose([]);
    const { width, height } = this.content.settings;
    this.line = { symbol, points: [], next: { x: snapped(width / 2, this.grid), y: snapped(height / 2, this.grid) } };
  }
  aimLine(next: Point): void {
    if (this.line) this.line = { ...this.line, next };
  }
  addPoint(): void {
    if (!this.line) return;
    const { points, next } = this.line;
    const last = points.at(-1);
    if (last?.x !== next.x || last.y !== next.y) this.line = { ...this.line, points: [...points, next] };
  }
  takeBackPoint(): void {
    if (this.line) this.line = { ...this.line, points: this.line.points.slice(0, -1) };
  }
  // With fewer than two points there is none.
  endLine(): void {
    const drawn = this.line;
    this.line = null;
    if (!drawn || drawn.points.length < 2) return;
    const key = nextKey(this.content.items);
    const item: Item = { key, symbol: drawn.symbol, x: 0, y: 0, w: 1, h: 1, turn: 0, group: '', params: usualOf(drawn.symbol), markup: '' };
    this.setItems([...this.content.items, through(item, drawn.points)]);
    this.choose([key]);
  }
  setPoints(key: string, points: readonly Point[], deed = ''): void {
    if (points.length < 2) return;
    this.setItems(this.content.items.map((item) => (item.key === key && isByPoints(item) ? through(item, points) : item)), deed);
  }
  remove(): void {
    if (this.chosen.size === 0) return;
    this.setItems(this.content.items.filter(({ key }) => !this.chosen.has(key)));
    this.chosen = new Set();
  }

  // From one screen into another, too: this browser keeps it.
  copy(): void {
    if (this.chosen.size > 0) remember(CLIPBOARD, JSON.stringify(this.selection));
  }
  cut(): void {
    this.copy();
    this.remove();
  }
  paste(): void {
    try {
      this.put(JSON.parse(recall(CLIPBOARD) ?? '[]') as Item[]);
    } catch {
      // What is kept there is none of ours.
    }
  }
  double(): void {
    this.put(this.selection);
  }
  private put(copies: readonly Item[]): void {
    if (copies.length === 0) return;
    const { items, keys } = pasted(this.content.items, copies.filter(({ symbol }) => symbol !== 'face' || this.offered.length > 0), BESIDE);
    this.setItems(items);
    this.choose(keys);
  }

  measured(key: string, box: Box): void {
    this.boxes.set(key, box);
  }
  readonly measure: Measure = (item) => {
    const box = item.symbol === 'drawn' ? this.boxes.get(item.key) : undefined;
    return box ? { ...box, x: item.x + box.x, y: item.y + box.y } : ownBox(item);
  };
}
