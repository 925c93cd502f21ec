// The parts of a screen that the page draws itself, over the drawing: what people act with, trends and lists. The server has
// checked their attributes, and decides what is written.

import { isTime } from '../lib/format';
import type { Value } from '../lib/value';

export type WritingKind = 'button' | 'switch' | 'setpoint' | 'slider' | 'choice' | 'startstop';
export type PartKind = WritingKind | 'navigate' | 'trend' | 'alarms' | 'tags';

export interface Part {
  kind: PartKind;
  key: string;
  label: string;
  write: string;
  stop: string;
  value: string;
  from: number;
  to: number;
  step: number;
  unit: string;
  values: { literal: string; name: string }[];
  confirm: string; // the question before it writes; empty: none
  engineer: boolean;
  feedback: string; // the value that says that it runs
  negated: boolean; // it runs while that is FALSE
  go: string;
  tags: string[];
  minutes: number;
}

// Of the whole drawing, in per cent.
export interface PartBox {
  left: number;
  top: number;
  width: number;
  height: number;
}

export interface PlacedPart extends Part {
  box: PartBox;
}

const KINDS: readonly string[] = ['button', 'switch', 'setpoint', 'slider', 'choice', 'startstop', 'navigate', 'trend', 'alarms', 'tags'];
const WRITING: readonly string[] = KINDS.slice(0, 6);
// The attributes of a part, without `data-`, that name values; the last one several.
export const NAMING_OF_PARTS: readonly string[] = ['write', 'stop', 'tags'];
export const isWriting = (kind: string): kind is WritingKind => WRITING.includes(kind);

const list = (text: string): string[] => text.split(';').map((each) => each.trim()).filter((each) => each !== '');

// `read`: an attribute by its name without `data-`; null for what is no part.
export function partOf(read: (attribute: string) => string | null): Part | null {
  const kind = read('part') ?? '';
  if (!KINDS.includes(kind)) return null;
  const text = (attribute: string) => read(attribute) ?? '';
  const number = (attribute: string, usual: number) => {
    const value = Number(read(attribute) ?? usual);
    return Number.isFinite(value) ? value : usual;
  };
  return {
    kind: kind as PartKind,
    key: text('key'),
    label: text('label'),
    write: text('write'),
    stop: text('stop'),
    value: text('value'),
    from: number('from', 0),
    to: number('to', 100),
    step: number('step', 0),
    unit: text('unit'),
    values: list(text('values')).map((each) => {
      const [literal = '', ...name] = each.split('=');
      return { literal: literal.trim(), name: name.join('=').trim() || literal.trim() };
    }),
    confirm: text('confirm'),
    engineer: text('least') === 'engineer',
    feedback: text('on').replace(/^!/, ''),
    negated: text('on').startsWith('!'),
    go: text('go'),
    tags: list(text('tags')),
    minutes: number('minutes', 5),
  };
}

// A symbol of the editor that is to act, and is no part as something of it is not filled in: it has nothing to write or to lead to.
export function idlePartOf(symbol: string, params: string): Part | null {
  if (!isWriting(symbol) && symbol !== 'navigate') return null;
  let label: unknown;
  try {
    label = (JSON.parse(params) as { label?: unknown } | null)?.label;
  } catch {
    // It has none then.
  }
  return partOf((attribute) => (attribute === 'part' ? symbol : attribute === 'label' && typeof label === 'string' ? label : null));
}
export const isIdle = ({ kind, write, go }: Part): boolean => (kind === 'navigate' ? go === '' : isWriting(kind) && write === '');

// What somebody is about to do with it, as people read it; '': its own words say it. `number`: of a literal.
export function deedOfPart(part: Part, wanted: string, words: Record<'start' | 'stop' | 'on' | 'off', string>, number: (literal: string) => string): string {
  switch (part.kind) {
    case 'startstop':
      return wanted === 'stop' ? words.stop : words.start;
    case 'switch':
      return wanted === 'TRUE' ? words.on : words.off;
    case 'choice':
      return part.values.find(({ literal }) => literal === wanted)?.name ?? wanted;
    case 'button':
      return part.label === '' ? part.value : '';
    default:
      return number(wanted);
  }
}

// A trend that stands in no drawing.
export const trendPart = (tags: readonly string[], minutes: number): Part => ({
  kind: 'trend', key: '', label: '', write: '', stop: '', value: '', from: 0, to: 0, step: 0, unit: '', values: [], confirm: '',
  engineer: false, feedback: '', negated: false, go: '', tags: [...tags], minutes,
});

// What people read at it: its label, the screen that it leads to, or what the cell calls what it writes (`called`).
export const labelOf = ({ label, go, write }: Partial<Record<'label' | 'go' | 'write', string>>, called: (name: string) => string): string =>
  label || go || (write ? called(write) : '');

// What the feedback says; null: nobody knows, or there is none.
export const runsBy = ({ feedback, negated }: Part, value: Value): boolean | null => (feedback === '' || value === null ? null : value > 0.5 !== negated);

// How many lines of words have room in so much of a drawing.
const LINE = 17;
const EDGES = 8;
export const linesIn = (height: number): number => Math.max(1, Math.floor((height - EDGES) / LINE));

// The names of all values that a part reads.
export const namesOf = (part: Part): string[] => [part.write, part.feedback, ...part.tags].filter((name) => name !== '');

// The parts of a drawing that is in the page; their own pictures in it are for programs that know no parts, and are hidden.
export function placeParts(root: SVGSVGElement): PlacedPart[] {
  const whole = root.getBoundingClientRect();
  const placed: PlacedPart[] = [];
  for (const element of root.querySelectorAll<SVGGraphicsElement>('[data-part], [data-symbol]')) {
    const read = (attribute: string) => element.getAttribute(`data-${attribute}`);
    const part = read('part') === null ? idlePartOf(read('symbol') ?? '', read('params') ?? '') : partOf(read);
    if (!part || whole.width === 0) continue;
    // The letters of its picture may stick out of it.
    const box = (element.querySelector(':scope > rect') ?? element).getBoundingClientRect();
    element.classList.add('placed');
    element.setAttribute('aria-hidden', 'true');
    placed.push({
      ...part,
      box: {
        left: (100 * (box.left - whole.left)) / whole.width,
        top: (100 * (box.top - whole.top)) / whole.height,
        width: (100 * box.width) / whole.width,
        height: (100 * box.height) / whole.height,
      },
    });
  }
  return placed;
}

// Seconds to the nanosecond, without a power of ten.
export const secondsText = (seconds: number): string => seconds.toFixed(9).replace(/\.?0+$/, '');

// The literal of IEC 61131-3 of a number for a variable of that type.
export function literalOf(value: number, type: string): string {
  const text = String(value);
  if (isTime(type)) return `T#${secondsText(value)}s`;
  return /^L?REAL$/.test(type) && !/[.e]/i.test(text) ? `${text}.0` : text;
}
