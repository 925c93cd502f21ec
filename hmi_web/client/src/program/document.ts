// The sources of the running program as GET /api/program gives them (hmi_web/doc/program.md). Somebody else wrote them: what
// has another shape than it should is left out.

import { refusal } from '../access/api';

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

export type CoilKind = 'normal' | 'negated' | 'set' | 'reset' | 'rising' | 'falling';

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

type Record_ = Record<string, unknown>;

const isRecord = (value: unknown): value is Record_ => typeof value === 'object' && value !== null && !Array.isArray(value);
const text = (value: unknown): string => (typeof value === 'string' ? value : '');
const count = (value: unknown): number => (typeof value === 'number' && Number.isInteger(value) && value >= 0 ? value : 0);
const records = (value: unknown): Record_[] => (Array.isArray(value) ? value.filter(isRecord) : []);
const texts = (value: unknown): string[] => (Array.isArray(value) ? value.map(text) : []);
const counts = (value: unknown): number[] => (Array.isArray(value) ? value.map(count) : []);
const pairs = (value: unknown): [string, string][] =>
  (Array.isArray(value) ? value : []).filter(Array.isArray).map((pair) => [text(pair[0]), text(pair[1])]);

function oneOf<T extends string>(value: unknown, known: readonly T[], otherwise: T): T {
  return known.find((word) => word === value) ?? otherwise;
}

function conditionOf(value: unknown): Condition {
  if (!isRecord(value)) return { kind: 'test', text: '?', negated: false };
  const negated = value.negated === true;
  switch (value.kind) {
    case 'true':
      return { kind: 'true' };
    case 'contact':
      return { kind: 'contact', name: text(value.name), negated, edge: oneOf(value.edge, ['', 'rising', 'falling'] as const, '') };
    case 'all':
    case 'any':
      return { kind: value.kind, of: (Array.isArray(value.of) ? value.of : []).map(conditionOf) };
    default:
      return { kind: 'test', text: text(value.text), negated };
  }
}

const COILS = ['normal', 'negated', 'set', 'reset', 'rising', 'falling'] as const;

function rungOf(value: Record_): Rung {
  return {
    kind: 'rung',
    number: count(value.number),
    label: text(value.label),
    comment: text(value.comment),
    goesOn: value.goes_on === true,
    condition: conditionOf(value.condition),
    boxes: records(value.boxes).map((box) => ({
      type: text(box.type),
      instance: text(box.instance),
      power: text(box.power),
      text: text(box.text),
      inputs: pairs(box.inputs),
      outputs: pairs(box.outputs),
    })),
    coils: records(value.coils).map((coil) => ({ kind: oneOf(coil.kind, COILS, 'normal'), name: text(coil.name) })),
    jump: text(value.jump),
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

function pinOf(value: Record_): Pin {
  return {
    name: text(value.name),
    negated: value.negated === true,
    edge: text(value.edge) !== '',
    text: text(value.text),
    at: pointOf(value.at),
    connections: records(value.connections).map((one) => ({
      from: count(one.from),
      output: text(one.output),
      path: (Array.isArray(one.path) ? one.path : []).map(pointOf).filter((point) => point !== null),
    })),
  };
}

function elementOf(value: Record_): DrawnElement {
  return {
    kind: text(value.kind),
    at: pointOf(value.at) ?? [0, 0],
    size: pointOf(value.size),
    name: text(value.name),
    instance: text(value.instance),
    negated: value.negated === true,
    edge: text(value.edge) !== '',
    storage: text(value.storage),
    inputs: [...records(value.inputs), ...records(value.in_outs)].map(pinOf),
    outputs: records(value.outputs).map(pinOf),
  };
}

function blockOf(value: Record_): Block {
  switch (value.kind) {
    case 'diagram':
      return { kind: 'diagram', elements: (Array.isArray(value.elements) ? value.elements : []).map((one) => elementOf(isRecord(one) ? one : {})) };
    case 'text':
    case 'action':
      return { kind: value.kind, name: text(value.name), first: Math.max(1, count(value.first)), lines: texts(value.lines) };
    case 'rung':
      return rungOf(value);
    case 'step':
      return {
        kind: 'step',
        name: text(value.name),
        comment: text(value.comment),
        initial: value.initial === true,
        actions: records(value.actions).map((action) => ({
          qualifier: text(action.qualifier),
          target: text(action.target),
          duration: text(action.duration),
          indicator: text(action.indicator),
        })),
      };
    case 'transition':
      return { kind: 'transition', name: text(value.name), from: counts(value.from), to: counts(value.to), lines: texts(value.lines) };
    default:
      return { kind: 'unknown' };
  }
}

function useOf(value: unknown[]): Use {
  const [path, access, block, line, column, length] = value;
  return {
    path: text(path),
    access: oneOf(access, ['read', 'write', 'call'] as const, 'read'),
    block: count(block),
    line: count(line),
    column: count(column),
    length: count(length),
  };
}

function sheetOf(value: Record_): Sheet {
  const blocks = (Array.isArray(value.blocks) ? value.blocks : []).map((block) => (isRecord(block) ? blockOf(block) : { kind: 'unknown' as const }));
  return {
    name: text(value.name),
    kind: text(value.kind),
    language: text(value.language),
    result: text(value.result),
    file: text(value.file),
    comment: text(value.comment),
    variables: records(value.variables).map((variable) => ({
      name: text(variable.name),
      type: text(variable.type),
      section: text(variable.section),
      address: text(variable.address),
      initial: text(variable.initial),
      comment: text(variable.comment),
    })),
    blocks,
    uses: (Array.isArray(value.uses) ? value.uses : [])
      .filter(Array.isArray)
      .map(useOf)
      .filter((use) => use.path !== '' && use.block < blocks.length),
  };
}

export function readSources(value: unknown): Sources {
  const given = isRecord(value) ? value : {};
  const document = isRecord(given.document) ? given.document : {};
  return {
    digest: text(given.digest),
    state: oneOf(given.state, ['complete', 'absent', 'damaged'] as const, 'damaged'),
    instances: records(given.instances).map((one) => ({ path: text(one.path), pou: text(one.pou) })),
    sheets: records(document.sheets).map(sheetOf),
  };
}

// Once a program: the browser asks whether what it has is still the one.
export async function fetchSources(signal: AbortSignal): Promise<Sources> {
  const response = await fetch('/api/program', { credentials: 'same-origin', cache: 'no-cache', signal });
  const value: unknown = await response.json().catch(() => null);
  if (response.ok) return readSources(value);
  const problem = isRecord(value) ? records(value.problems)[0] : undefined;
  throw new Error(problem ? text(problem.message) : refusal(response.status));
}
