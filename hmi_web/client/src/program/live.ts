// What the blocks of a sheet show in one scan, as GET /api/program/live has computed it (hmi_web/doc/program.md): the page draws it.

import { refusal } from '../access/api';
import { fieldsOf, listOf, numberOf, textOf } from '../lib/doubt';
import { rangesOf } from '../lib/wanted';
import type { TagValue } from '../lib/value';
import type { Condition } from './document';

export type Power = 'on' | 'off' | 'open'; // open: it cannot be known

export interface Flow {
  in: Power;
  out: Power;
  closed: boolean; // of a contact
}

export interface RungFlow {
  ran: boolean; // false: a jump or a return went past it
  power: Power; // behind the condition
  nodes: Flow[]; // of the condition: each before its parts
  coils: boolean[];
}

export interface BodyValues {
  tested: ReadonlyMap<number, boolean>; // by line
  indexed: ReadonlyMap<string, string>; // "line column" of "a[i].x" -> "a[2].x"
}

export type Wires = ReadonlyMap<string, { value: TagValue; type: string } | null>;

export interface SheetLive {
  digest: string;
  scan: number;
  steps: ReadonlySet<number>;
  tags: readonly TagValue[];
  rungs: ReadonlyMap<number, RungFlow>;
  bodies: ReadonlyMap<number, BodyValues>;
  diagrams: ReadonlyMap<number, Wires>;
}

export interface Question {
  sheet: number;
  instance: string;
  blocks: Iterable<number>;
  tags: Iterable<number>;
}

export const NOTHING_SEEN: SheetLive = {
  digest: '', scan: 0, steps: new Set(), tags: [], rungs: new Map(), bodies: new Map(), diagrams: new Map(),
};

const powerOf = (letter: string | undefined): Power => (letter === '1' ? 'on' : letter === '0' ? 'off' : 'open');

function rungOf(ran: boolean, power: string, nodes: string, coils: string): RungFlow {
  const flows = Array.from({ length: Math.floor(nodes.length / 3) }, (_, i): Flow => ({
    in: powerOf(nodes[3 * i]), out: powerOf(nodes[3 * i + 1]), closed: nodes[3 * i + 2] === '1',
  }));
  return { ran, power: powerOf(power), nodes: flows, coils: [...coils].map((one) => one === '1') };
}

export const placeKey = (line: number, column: number) => `${line} ${column}`;

function bodyOf(tested: unknown, indexed: unknown): BodyValues {
  const pairs = listOf(tested).filter(Array.isArray).map((pair): [number, boolean] => [Number(pair[0]), pair[1] === true]);
  const places = listOf(indexed).filter(Array.isArray).map((one): [string, string] => [placeKey(Number(one[0]), Number(one[1])), textOf(one[2])]);
  return { tested: new Map(pairs), indexed: new Map(places) };
}

function tagOf(value: unknown): TagValue {
  return typeof value === 'number' || typeof value === 'string' ? value : null;
}

export const wireKey = (element: number, output: string) => `${element} ${output.toUpperCase()}`;

export function readLive(value: unknown): SheetLive {
  const given = fieldsOf(value) ?? {};
  const tags: TagValue[] = [];
  for (const [index, one] of Object.entries(fieldsOf(given.tags) ?? {})) tags[Number(index)] = tagOf(one);
  const rungs = new Map<number, RungFlow>();
  const bodies = new Map<number, BodyValues>();
  const diagrams = new Map<number, Wires>();
  for (const [index, one] of Object.entries(fieldsOf(given.blocks) ?? {})) {
    const block = fieldsOf(one) ?? {};
    const wires = fieldsOf(block.wires);
    if (wires) {
      const known = Object.entries(wires).map(([key, pair]) => [key, Array.isArray(pair) ? { value: tagOf(pair[0]), type: textOf(pair[1]) } : null] as const);
      diagrams.set(Number(index), new Map(known));
    } else if ('tested' in block) bodies.set(Number(index), bodyOf(block.tested, block.indexed));
    else rungs.set(Number(index), rungOf(block.ran === true, textOf(block.power), textOf(block.nodes), textOf(block.coils)));
  }
  const steps = listOf(given.steps).filter((step) => typeof step === 'number');
  return { digest: textOf(given.digest), scan: numberOf(given.scan) ?? 0, steps: new Set(steps), tags, rungs, bodies, diagrams };
}

// The parts of a condition in the order in which a flow tells of them.
export function partsOf(condition: Condition): Condition[] {
  return condition.kind === 'all' || condition.kind === 'any' ? [condition, ...condition.of.flatMap(partsOf)] : [condition];
}

const MOST_RANGES = 100; // of one list: a request is at most 8 KiB
const listed = (numbers: Iterable<number>) =>
  rangesOf(numbers, MOST_RANGES).map(([first, count]) => (count === 1 ? `${first}` : `${first}-${first + count - 1}`)).join(',');

export async function fetchLive({ sheet, instance, blocks, tags }: Question, signal: AbortSignal): Promise<SheetLive> {
  const query = new URLSearchParams({ sheet: String(sheet), instance, blocks: listed(blocks), tags: listed(tags) });
  const response = await fetch(`/api/program/live?${query.toString()}`, { credentials: 'same-origin', cache: 'no-store', signal });
  if (!response.ok) throw new Error(refusal(response.status));
  return readLive(await response.json());
}
