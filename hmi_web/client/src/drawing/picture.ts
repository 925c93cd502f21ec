// The elements of a drawing in the page, and what is written into them. What a value costs is paid when it changes: of a value
// that did not, neither its words are made anew nor its element is looked at.

import { fixed } from '../lib/format';
import type { Value } from '../lib/protocol';
import { drawnNumber, numberOr, type TagValue } from '../lib/value';
import { bindingsOf, isTrue, namesOf, poseTransform, spokenOf, textOf, transformOf, type Binding, type Box, type Found, type PoseBinding, type RangeBinding } from './bindings';

// Where values come from.
export interface Source {
  // By its name; null: not known, or there is no such thing.
  value: (name: string) => TagValue;
  // The same with what is said of it; null if there is no such thing.
  found: (name: string) => Found | null;
  // What people call it; words that are no name stay as they are.
  called: (name: string) => string;
}

interface Bound {
  element: SVGGraphicsElement;
  binding: Binding;
  words: Text | null; // of a text: what it says
  ownTransform: string;
  box: Box;
  title: string;
  shown: string; // what was written last
}

// Of one name all that lives by it.
interface Watched {
  name: string;
  value: TagValue | undefined; // undefined: to be looked at in any case
  bound: Bound[];
}

const NOTHING: Box = { x: 0, y: 0, width: 0, height: 0 };

export class DrawnPicture {
  private readonly watched: Watched[] = [];
  private readonly waiting = new Set<Bound>(); // whose value has changed

  // `root`: as the server sent it, not yet in the page. Throws an Error if it is none.
  static parse(text: string): SVGSVGElement {
    const document = new DOMParser().parseFromString(text, 'image/svg+xml');
    const root = document.documentElement;
    if (!(root instanceof SVGSVGElement) || document.querySelector('parsererror')) throw new Error('not a drawing');
    return root;
  }

  // `root` is in the page: boxes are measured, all of them before anything is written.
  constructor(root: SVGSVGElement) {
    const bound = [...root.querySelectorAll<SVGGraphicsElement>('*')].flatMap(boundOf);
    const byName = new Map<string, Bound[]>();
    for (const one of bound) for (const name of namesOf(one.binding)) byName.set(name, [...(byName.get(name) ?? []), one]);
    for (const [name, all] of byName) this.watched.push({ name, value: undefined, bound: all });
    for (const one of bound) {
      if (one.title !== '') {
        one.element.setAttribute('tabindex', '0');
        one.element.setAttribute('role', 'img');
      }
      if (one.binding.kind !== 'text') continue;
      // One piece of text, which is written into: to put another one there would cost twice as much.
      one.words = document.createTextNode('');
      one.element.replaceChildren(one.words);
    }
  }

  // All that it is bound to.
  names(): string[] {
    return this.watched.map(({ name }) => name);
  }

  // What is said of values has changed, or the language: every one is to be looked at again.
  forget(): void {
    for (const one of this.watched) one.value = undefined;
  }

  // Writes into at most so many elements, those first that have waited longest; false: others wait for the next time.
  show(source: Source, most = Infinity): boolean {
    for (const one of this.watched) {
      const value = source.value(one.name);
      if (value === one.value) continue;
      one.value = value;
      for (const each of one.bound) this.waiting.add(each);
    }
    let written = 0;
    for (const one of this.waiting) {
      if (written >= most) return false;
      this.waiting.delete(one);
      const { binding } = one;
      const isNew = binding.kind === 'pose' ? place(one, binding, namesOf(binding).map((name) => numberOr(source.value(name))), source) : show(one, binding, source);
      written += isNew ? 1 : 0;
    }
    return true;
  }
}

function boundOf(element: SVGGraphicsElement): Bound[] {
  const floor = element.closest('[data-floor-scale]');
  const bindings = bindingsOf(
    (attribute) => element.getAttribute(`data-${attribute}`),
    (attribute) => floor?.getAttribute(`data-${attribute}`) ?? null,
  );
  const title = element.querySelector(':scope > title')?.textContent.trim() ?? '';
  return bindings.map((binding) => {
    const box = binding.kind === 'fill' || binding.kind === 'turn' ? element.getBBox() : NOTHING;
    return { element, binding, words: null, ownTransform: element.getAttribute('transform') ?? '', box, title, shown: '?' };
  });
}

// Whether there was something to write.
function show(one: Bound, binding: Exclude<Binding, PoseBinding>, source: Source): boolean {
  const found = source.found(binding.name);
  const value = found?.value ?? null;
  const words = binding.kind === 'text' ? textOf(found, binding.digits, binding.unit) : one.title === '' ? '' : spokenOf(found);
  const name = one.title === '' ? '' : source.called(one.title);
  // More digits move an element than stand in its words.
  const shown = binding.kind === 'text' ? `${name}${words}` : `${name}${String(value)} ${words}`;
  if (shown === one.shown) return false;
  one.shown = shown;
  if (name !== '') one.element.setAttribute('aria-label', `${name}: ${words}`);
  write(one, binding.kind === 'text' && typeof value === 'string', drawnNumber(value, found?.type ?? ''), words);
  return true;
}

// Where it is not known any more it stays where it was, pale.
function place(one: Bound, binding: PoseBinding, values: readonly Value[], source: Source): boolean {
  const words = values.map((value) => fixed(value, 2)).join(', ');
  if (words === one.shown) return false;
  one.shown = words;
  const { element, title, ownTransform } = one;
  const transform = poseTransform(binding, values);
  element.classList.toggle('unknown', transform === null);
  if (title !== '') element.setAttribute('aria-label', `${source.called(title)}: ${words}`);
  if (transform !== null) element.setAttribute('transform', `${transform} ${ownTransform}`.trim());
  return true;
}

function write({ element, binding, words: text, ownTransform, box }: Bound, isText: boolean, value: Value, words: string): void {
  element.classList.toggle('unknown', value === null && !isText);
  if (binding.kind === 'fill') element.classList.toggle('no-level', value === null);
  if (binding.kind === 'text') {
    if (text) text.data = words;
  } else if (binding.kind === 'show') element.classList.toggle('hidden', !isTrue(binding, value));
  else if (binding.kind === 'on' || binding.kind === 'warn' || binding.kind === 'alarm') element.classList.toggle(binding.kind, isTrue(binding, value));
  else element.setAttribute('transform', `${ownTransform} ${transformOf(binding as RangeBinding, value, box)}`.trim());
}
