// The elements of a drawing in the page, and what is written into them. Touches only what has changed.

import { fixed } from '../lib/format';
import type { Value } from '../lib/protocol';
import { numberOr } from '../lib/value';
import { bindingsOf, isTrue, namesOf, poseTransform, spokenOf, textOf, transformOf, type Binding, type Box, type Found, type PoseBinding, type RangeBinding } from './bindings';

// A value of the cell by its name; null if there is no such thing.
export type Look = (name: string) => Found | null;

interface Bound {
  element: SVGGraphicsElement;
  binding: Binding;
  ownTransform: string;
  box: Box;
  title: string;
  shown: string; // what was written last
}

const NOTHING: Box = { x: 0, y: 0, width: 0, height: 0 };

export class DrawnPicture {
  private readonly bound: Bound[] = [];

  // `root`: as the server sent it, not yet in the page. Throws an Error if it is none.
  static parse(text: string): SVGSVGElement {
    const document = new DOMParser().parseFromString(text, 'image/svg+xml');
    const root = document.documentElement;
    if (!(root instanceof SVGSVGElement) || document.querySelector('parsererror')) throw new Error('not a drawing');
    return root;
  }

  // `root` is in the page: boxes are measured.
  constructor(root: SVGSVGElement) {
    for (const element of root.querySelectorAll<SVGGraphicsElement>('*')) {
      const floor = element.closest('[data-floor-scale]');
      const bindings = bindingsOf(
        (attribute) => element.getAttribute(`data-${attribute}`),
        (attribute) => floor?.getAttribute(`data-${attribute}`) ?? null,
      );
      const title = element.querySelector(':scope > title')?.textContent.trim() ?? '';
      if (bindings.length > 0 && title !== '') {
        element.setAttribute('tabindex', '0');
        element.setAttribute('role', 'img');
      }
      for (const binding of bindings) {
        const box = binding.kind === 'fill' || binding.kind === 'turn' ? element.getBBox() : NOTHING;
        this.bound.push({ element, binding, ownTransform: element.getAttribute('transform') ?? '', box, title, shown: '?' });
      }
    }
  }

  // All that it is bound to.
  names(): string[] {
    return [...new Set(this.bound.flatMap(({ binding }) => namesOf(binding)))];
  }

  show(look: Look): void {
    for (const one of this.bound) {
      if (one.binding.kind === 'pose') {
        this.place(one, one.binding, namesOf(one.binding).map((name) => numberOr(look(name)?.value)));
        continue;
      }
      const found = look(one.binding.name);
      const value = found?.value ?? null;
      const { binding } = one;
      const words = binding.kind === 'text' ? textOf(found, binding.digits, binding.unit) : one.title === '' ? '' : spokenOf(found);
      // More digits move an element than stand in its words.
      const shown = binding.kind === 'text' ? words : `${String(value)} ${words}`;
      if (shown === one.shown) continue;
      one.shown = shown;
      this.write(one, one.binding.kind === 'text' && typeof value === 'string', numberOr(value), words);
    }
  }

  // Where it is not known any more it stays where it was, pale.
  private place(one: Bound, binding: PoseBinding, values: readonly Value[]): void {
    const words = values.map((value) => fixed(value, 2)).join(', ');
    if (words === one.shown) return;
    one.shown = words;
    const { element, title, ownTransform } = one;
    const transform = poseTransform(binding, values);
    element.classList.toggle('unknown', transform === null);
    if (title !== '') element.setAttribute('aria-label', `${title}: ${words}`);
    if (transform !== null) element.setAttribute('transform', `${transform} ${ownTransform}`.trim());
  }

  private write({ element, binding, ownTransform, box, title }: Bound, isText: boolean, value: Value, words: string): void {
    element.classList.toggle('unknown', value === null && !isText);
    if (title !== '') element.setAttribute('aria-label', `${title}: ${words}`);
    if (binding.kind === 'text') element.textContent = words;
    else if (binding.kind === 'show') element.classList.toggle('hidden', !isTrue(binding, value));
    else if (binding.kind === 'on' || binding.kind === 'warn' || binding.kind === 'alarm') element.classList.toggle(binding.kind, isTrue(binding, value));
    else element.setAttribute('transform', `${ownTransform} ${transformOf(binding as RangeBinding, value, box)}`.trim());
  }
}
