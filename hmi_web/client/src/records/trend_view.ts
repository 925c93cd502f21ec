// What is drawn of the history: tags on their axes over a span, as somebody has chosen or saved it. Pure.

import { readNumber } from '../lib/number_input';
import type { Value } from '../lib/value';
import type { History } from './records';

// With the tags of its unit; one of its own; one of its own with these ends.
export type Axis = { kind: 'unit' } | { kind: 'own' } | { kind: 'range'; least: number; greatest: number };

export interface TrendView {
  tags: string[];
  axes: Record<string, string>; // as the server has them: "own", "0..100"
  spanMs: number;
  compares: boolean; // with the day before
  group: string; // that was shown last; empty: none
}

// As GET /api/trends tells it.
export interface TrendGroup {
  name: string;
  tags: string[];
  axes: Record<string, string>;
  span_s: number;
  saved_by: string;
  saved_ms: number;
}

// As the server takes it: no address leads to the others.
export const isGroupName = (name: string): boolean => name.trim() !== '' && name !== '.' && name !== '..';

// What there is a history of, and what there is none of (any more): a group keeps and names both. `known`: null before the server has told.
export function partedBy(tags: readonly string[], known: readonly string[] | null): { drawn: string[]; missing: string[] } {
  const has = new Set(known ?? tags);
  return { drawn: tags.filter((tag) => has.has(tag)), missing: tags.filter((tag) => !has.has(tag)) };
}

// As a group has them: of tags that are shown, and where somebody has chosen one.
export const ownAxes = (tags: readonly string[], axes: Readonly<Record<string, string>>): Record<string, string> =>
  Object.fromEntries(Object.entries(axes).filter(([tag, axis]) => axis !== '' && tags.includes(tag)));

// What is shown is what was saved; over another span, too.
export function isAsSaved(group: TrendGroup, tags: readonly string[], axes: Readonly<Record<string, string>>): boolean {
  const [own, saved] = [ownAxes(tags, axes), ownAxes(group.tags, group.axes)];
  const names = Object.keys(own);
  return group.tags.join(';') === tags.join(';') && names.length === Object.keys(saved).length && names.every((tag) => own[tag] === saved[tag]);
}

export const MOST_AXES = 4; // that are drawn; other scales are told in words

interface Scaled {
  tag: string;
  scale: string;
  isBool: boolean;
  range?: [least: number, greatest: number];
}
// The tags whose scale has no axis, with its ends: those that were chosen, or those of the values.
export function withoutAxis<Trace extends Scaled>(traces: readonly Trace[], history: History | null): { trace: Trace; least: Value; greatest: Value }[] {
  const drawn = new Set([...new Set(traces.map(({ scale }) => scale))].slice(0, MOST_AXES));
  return traces.flatMap((trace) => {
    if (drawn.has(trace.scale)) return [];
    if (trace.isBool) return [{ trace, least: 0, greatest: 1 }];
    if (trace.range) return [{ trace, least: trace.range[0], greatest: trace.range[1] }];
    const same = traces.flatMap(({ scale }, index) => (scale === trace.scale ? (history?.series[index] ?? []) : []));
    const known = (columns: Value[][]) => columns.flat().filter((value) => value !== null);
    const [lows, highs] = [known(same.map(({ least }) => least)), known(same.map(({ greatest }) => greatest))];
    return [{ trace, least: lows.length > 0 ? Math.min(...lows) : null, greatest: highs.length > 0 ? Math.max(...highs) : null }];
  });
}

export const DAY_MS = 86_400_000;
const MOST_TAGS = 12;
const LONGEST_MS = 400 * DAY_MS;

export function axisOf(text: string | undefined): Axis {
  if (!text) return { kind: 'unit' };
  const [least, greatest] = text.split('..').map(Number);
  if (least === undefined || greatest === undefined) return text === 'own' ? { kind: 'own' } : { kind: 'unit' };
  return Number.isFinite(least) && Number.isFinite(greatest) && least < greatest ? { kind: 'range', least, greatest } : { kind: 'unit' };
}

// Of the ends that somebody has typed; null: they are none.
export function rangeText(least: string, greatest: string): string | null {
  const [from, to] = [readNumber(least), readNumber(greatest)];
  return from === null || to === null || from >= to ? null : `${from}..${to}`;
}

// What this browser kept; null: nothing that can be used.
export function readView(text: string | null): TrendView | null {
  try {
    const kept = JSON.parse(text ?? 'null') as Partial<TrendView> | null;
    if (!kept || !Array.isArray(kept.tags) || !kept.tags.every((tag) => typeof tag === 'string')) return null;
    const axes = Object.entries(kept.axes ?? {}).filter((pair): pair is [string, string] => typeof pair[1] === 'string');
    const span = Number(kept.spanMs);
    return {
      tags: [...new Set(kept.tags)].slice(0, MOST_TAGS),
      axes: Object.fromEntries(axes),
      spanMs: span >= 100 && span <= LONGEST_MS ? span : 600_000,
      compares: kept.compares === true,
      group: typeof kept.group === 'string' ? kept.group : '',
    };
  } catch {
    return null;
  }
}

// Of each tag the last value a day before each column of `now`; what was not asked for or is not known is null.
export function dayBefore(now: History, before: History | null): Value[][] {
  return now.series.map((series) => {
    const other = before?.series.find(({ tag }) => tag === series.tag);
    return series.last.map((_, index) => {
      if (!other || !before || before.column_ms <= 0) return null;
      const at = now.from_ms + index * now.column_ms - DAY_MS;
      return other.last[Math.round((at - before.from_ms) / before.column_ms)] ?? null;
    });
  });
}
