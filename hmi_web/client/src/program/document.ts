// The sources of the running program as GET /api/program gives them (hmi_web/doc/program.md). Somebody else wrote them: what
// has another shape than it should is left out.

import { refusal } from '../access/api';
import { fieldsOf, listOf, recordsOf, textOf, type Fields } from '../lib/doubt';

export type Access = 'read' | 'write' | 'call';

export type Condition =
  | { kind: 'true' }
  | { kind: 'contact'; name: string; negated: boolean; edge: '' | 'rising' | 'falling' }
  | { kind: 'test'; text: string; negated: boolean }
  | { kind: 'all' | 'any'; of: Condition[] };

export interface Box {
  type: string;
  instance: string;
  power: string; // the input that takes the power; empty: EN
  text: string; // statements instead of a block
  inputs: [pin: string, value: string][];
  outputs: [pin: string, variable: string][];
}

export type CoilKind = 'normal' | 'negated' | 'set' | 'reset' | 'rising' | 'falling' | 'connector';

export interface Coil {
  kind: CoilKind;
  name: string;
}

export interface Rung {
  kind: 'rung';
  number: number;
  label: string;
  comment: string;
  goesOn: boolean;
  condition: Condition;
  boxes: Box[];
  coils: Coil[];
  jump: string;
  returns: boolean;
}

export interface StepAction {
  qualifier: string;
  target: string;
  duration: string;
  indicator: string;
}

export interface Text {
  kind: 'text' | 'action';
  name: string; // of an action
  first: number; // number of its first line
  lines: string[];
}

export interface Step {
  kind: 'step';
  name: string;
  comment: string;
  initial: boolean;
  actions: StepAction[];
}

export interface Transition {
  kind: 'transition';
  name: string;
  from: number[];
  to: number[];
  lines: string[];
}

export interface Pin {
  name: string;
  negated: boolean;
  edge: boolean;
  text: string; // an expression instead of connections
  at: [x: number, y: number] | null; // relative to its element
  connections: { from: number; output: string; path: [x: number, y: number][] }[]; // `from`: an element, path from here to there
}

// Of networks as they were drawn, in the units of the file.
export interface DrawnElement {
  kind: string;
  at: [x: number, y: number];
  size: [width: number, height: number] | null;
  name: string;
  instance: string;
  negated: boolean;
  edge: boolean;
  storage: string;
  inputs: Pin[];
  outputs: Pin[];
}

export interface Diagram {
  kind: 'diagram';
  elements: DrawnElement[];
}

export type Block = Text | Rung | Step | Transition | Diagram | { kind: 'unknown' };

export interface Variable {
  name: string;
  type: string;
  section: string;
  address: string;
  initial: string;
  comment: string;
}

// Line and column count from 1 in the block; 0: on a symbol.
export interface Use {
  path: string;
  access: Access;
  block: number;
  line: number;
  column: number;
  length: number;
}

export interface Sheet {
  name: string;
  kind: string;
  language: string;
  result: string;
  file: string;
  comment: string;
  variables: Variable[];
  blocks: Block[];
  uses: Use[];
}

export interface Instance {
  path: string;
  pou: string;
}

export interface Sources {
  digest: string;
  state: 'complete' | 'absent' | 'damaged';
  instances: Instance[];
  sheets: Sheet[];
}

// Where a line goes on that ended elsewhere.
export const isConnector = (name: string): boolean => /^>\d+>$/.test(name);

const countOf = (value: unknown): number => (typeof value === 'number' && Number.isInteger(value) && value >= 0 ? value : 0);
const pairsOf = (value: unknown): [string, string][] =>
  listOf(value).filter(Array.isArray).map((pair) => [textOf(pair[0]), textOf(pair[1])]);

function oneOf<T extends string>(value: unknown, known: readonly T[], otherwise: T): T {
  return known.find((word) => word === value) ?? otherwise;
}

function conditionOf(value: unknown): Condition {
  const condition = fieldsOf(value);
  if (!condition) return { kind: 'test', text: '?', negated: false };
  const negated = condition.negated === true;
  switch (condition.kind) {
    case 'true':
      return { kind: 'true' };
    case 'contact':
      return { kind: 'contact', name: textOf(condition.name), negated, edge: oneOf(condition.edge, ['', 'rising', 'falling'] as const, '') };
    case 'all':
    case 'any':
      return { kind: condition.kind, of: listOf(condition.of).map(conditionOf) };
    default:
      return { kind: 'test', text: textOf(condition.text), negated };
  }
}

const COILS = ['normal', 'negated', 'set', 'reset', 'rising', 'falling', 'connector'] as const;

function rungOf(value: Fields): Rung {
  return {
    kind: 'rung',
    number: countOf(value.number),
    label: textOf(value.label),
    comment: textOf(value.comment),
    goesOn: value.goes_on === true,
    condition: conditionOf(value.condition),
    boxes: recordsOf(value.boxes).map((box) => ({
      type: textOf(box.type),
      instance: textOf(box.instance),
      power: textOf(box.power),
      text: textOf(box.text),
      inputs: pairsOf(box.inputs),
      outputs: pairsOf(box.outputs),
    })),
    coils: recordsOf(value.coils).map((coil) => ({ kind: oneOf(coil.kind, COILS, 'normal'), name: textOf(coil.name) })),
    jump: textOf(value.jump),
    returns: value.return === true,
  };
}

// No drawing is larger.
const FARTHEST = 1e6;

function pointOf(value: unknown): [number, number] | null {
  if (!Array.isArray(value)) return null;
  const [x, y] = value as unknown[];
  return typeof x === 'number' && typeof y === 'number' && Math.abs(x) <= FARTHEST && Math.abs(y) <= FARTHEST ? [x, y] : null;
}

function pinOf(value: Fields): Pin {
  return {
    name: textOf(value.name),
    negated: value.negated === true,
    edge: textOf(value.edge) !== '',
    text: textOf(value.text),
    at: pointOf(value.at),
    connections: recordsOf(value.connections).map((one) => ({
      from: countOf(one.from),
      output: textOf(one.output),
      path: listOf(one.path).map(pointOf).filter((point) => point !== null),
    })),
  };
}

function elementOf(value: Fields): DrawnElement {
  return {
    kind: textOf(value.kind),
    at: pointOf(value.at) ?? [0, 0],
    size: pointOf(value.size),
    name: textOf(value.name),
    instance: textOf(value.instance),
    negated: value.negated === true,
    edge: textOf(value.edge) !== '',
    storage: textOf(value.storage),
    inputs: [...recordsOf(value.inputs), ...recordsOf(value.in_outs)].map(pinOf),
    outputs: recordsOf(value.outputs).map(pinOf),
  };
}

function blockOf(value: Fields): Block {
  switch (value.kind) {
    case 'diagram':
      return { kind: 'diagram', elements: listOf(value.elements).map((one) => elementOf(fieldsOf(one) ?? {})) };
    case 'text':
    case 'action':
      return { kind: value.kind, name: textOf(value.name), first: Math.max(1, countOf(value.first)), lines: listOf(value.lines).map(textOf) };
    case 'rung':
      return rungOf(value);
    case 'step':
      return {
        kind: 'step',
        name: textOf(value.name),
        comment: textOf(value.comment),
        initial: value.initial === true,
        actions: recordsOf(value.actions).map((action) => ({
          qualifier: textOf(action.qualifier),
          target: textOf(action.target),
          duration: textOf(action.duration),
          indicator: textOf(action.indicator),
        })),
      };
    case 'transition':
      return { kind: 'transition', name: textOf(value.name), from: listOf(value.from).map(countOf), to: listOf(value.to).map(countOf), lines: listOf(value.lines).map(textOf) };
    default:
      return { kind: 'unknown' };
  }
}

function useOf(value: unknown[]): Use {
  const [path, access, block, line, column, length] = value;
  return {
    path: textOf(path),
    access: oneOf(access, ['read', 'write', 'call'] as const, 'read'),
    block: countOf(block),
    line: countOf(line),
    column: countOf(column),
    length: countOf(length),
  };
}

function sheetOf(value: Fields): Sheet {
  const blocks = listOf(value.blocks).map((block) => blockOf(fieldsOf(block) ?? {}));
  return {
    name: textOf(value.name),
    kind: textOf(value.kind),
    language: textOf(value.language),
    result: textOf(value.result),
    file: textOf(value.file),
    comment: textOf(value.comment),
    variables: recordsOf(value.variables).map((variable) => ({
      name: textOf(variable.name),
      type: textOf(variable.type),
      section: textOf(variable.section),
      address: textOf(variable.address),
      initial: textOf(variable.initial),
      comment: textOf(variable.comment),
    })),
    blocks,
    uses: listOf(value.uses)
      .filter(Array.isArray)
      .map(useOf)
      .filter((use) => use.path !== '' && use.block < blocks.length),
  };
}

export function readSources(value: unknown): Sources {
  const given = fieldsOf(value) ?? {};
  const document = fieldsOf(given.document) ?? {};
  return {
    digest: textOf(given.digest),
    state: oneOf(given.state, ['complete', 'absent', 'damaged'] as const, 'damaged'),
    instances: recordsOf(given.instances).map((one) => ({ path: textOf(one.path), pou: textOf(one.pou) })),
    sheets: recordsOf(document.sheets).map(sheetOf),
  };
}

// Once a program: the browser asks whether what it has is still the one.
export async function fetchSources(signal: AbortSignal): Promise<Sources> {
  const response = await fetch('/api/program', { credentials: 'same-origin', cache: 'no-cache', signal });
  const value: unknown = await response.json().catch(() => null);
  if (response.ok) return readSources(value);
  const problem = recordsOf(fieldsOf(value)?.problems)[0];
  throw new Error(problem ? textOf(problem.message) : refusal(response.status));
}
