// The power of a ladder diagram, computed from values of one scan, network after network as the engine runs them: what is
// TRUE lets power through. What the values do not tell is null: whether an edge was there, what a statement did in between.

import type { Box, Coil, Condition, Rung } from './document';
import { and, callFunction, evaluate, not, or, type Known, type Lookup, type Result } from './expression';

export interface Flow {
  in: Result;
  out: Result;
}

export interface BoxFlow {
  power: Result;
  inputs: Result[];
  outputs: Result[];
}

export interface RungFlow {
  ran: boolean; // false: a jump or a return went past it
  power: Result; // behind the condition
  conditions: Map<Condition, Flow>;
  boxes: BoxFlow[];
}

// What needs no reader of expressions.
const SIMPLE = /^[A-Za-z_][\w.]*$/;
// Where a line goes on that ended elsewhere.
const CONNECTOR = /^>\d+>$/;
export const isConnector = (name: string): boolean => CONNECTOR.test(name);
const TRUE: Known = { kind: 'bool', value: 1 };
const FALSE: Known = { kind: 'bool', value: 0 };

function valueOf(text: string, lookup: Lookup): Result {
  return isConnector(text) ? lookup(text) : evaluate(text, lookup);
}

// A variable that is FALSE cannot have risen; one that is TRUE may have.
function edge(value: Result, rising: boolean): Result {
  return value?.kind === 'bool' && value.value === (rising ? 0 : 1) ? FALSE : null;
}

function closed(condition: Condition, lookup: Lookup): Result {
  switch (condition.kind) {
    case 'contact': {
      const value = SIMPLE.test(condition.name) ? lookup(condition.name) : valueOf(condition.name, lookup);
      const sensed = condition.edge === '' ? value : edge(value, condition.edge === 'rising');
      return condition.negated ? not(sensed) : sensed?.kind === 'bool' ? sensed : null;
    }
    case 'test': {
      const value = evaluate(condition.text, lookup);
      return condition.negated ? not(value) : value?.kind === 'bool' ? value : null;
    }
    default:
      return TRUE;
  }
}

function follow(condition: Condition, power: Result, lookup: Lookup, flows: Map<Condition, Flow>): Result {
  let out: Result;
  if (condition.kind === 'all') out = condition.of.reduce((before, next) => follow(next, before, lookup, flows), power);
  else if (condition.kind === 'any') out = condition.of.map((next) => follow(next, power, lookup, flows)).reduce(or, FALSE);
  else out = and(power, closed(condition, lookup));
  flows.set(condition, { in: power, out });
  return out;
}

// What a coil makes of its variable; null where that depends on more than its power.
export function driven(coil: Coil, power: Result): Result {
  if (coil.kind === 'negated') return not(power);
  if (coil.kind === 'set') return power?.value === 1 ? TRUE : null;
  if (coil.kind === 'reset') return power?.value === 1 ? FALSE : null;
  return coil.kind === 'normal' || coil.kind === 'connector' ? power : null;
}

const isResult = (box: Box, pin: string) => ['', 'OUT', box.type.toUpperCase()].includes(pin.toUpperCase());

function flowOfBox(box: Box, power: Result, lookup: Lookup): BoxFlow {
  const inputs = box.inputs.map(([, value]) => valueOf(value, lookup));
  const outputs = box.outputs.map(([pin]) => {
    if (pin.toUpperCase() === 'ENO') return power;
    if (box.instance !== '') return lookup(`${box.instance}.${pin}`);
    return isResult(box, pin) && power?.value === 1 ? callFunction(box.type, inputs) : null;
  });
  return { power, inputs, outputs };
}

export function flowOf(rungs: readonly Rung[], live: Lookup, declares: (name: string) => boolean): RungFlow[] {
  // Values that networks hand on and nobody declares.
  const wires = new Map<string, Result>();
  const lookup: Lookup = (path) => wires.get(path.toLowerCase()) ?? live(path);
  const keep = (name: string, value: Result) => {
    if (name !== '' && !declares(name)) wires.set(name.toLowerCase(), value);
  };
  let skipped = ''; // label that is looked for; '*': the end
  return rungs.map((rung, index) => {
    if (skipped !== '' && skipped === rung.label.toLowerCase()) skipped = '';
    const conditions = new Map<Condition, Flow>();
    if (skipped !== '') return { ran: false, power: null, conditions, boxes: rung.boxes.map(() => ({ power: null, inputs: [], outputs: [] })) };
    const power = follow(rung.condition, TRUE, lookup, conditions);
    const boxes = rung.boxes.map((box) => {
      const flow = flowOfBox(box, power, lookup);
      box.outputs.forEach(([, variable], i) => keep(variable, flow.outputs[i] ?? null));
      return flow;
    });
    for (const coil of rung.coils) keep(coil.name, driven(coil, power));
    // A jump back is gone again: what ran last counts.
    const ahead = rung.jump !== '' && rungs.slice(index + 1).some((next) => next.label.toLowerCase() === rung.jump.toLowerCase());
    if (power?.value === 1 && rung.returns) skipped = '*';
    else if (power?.value === 1 && ahead) skipped = rung.jump.toLowerCase();
    return { ran: true, power, conditions, boxes };
  });
}
