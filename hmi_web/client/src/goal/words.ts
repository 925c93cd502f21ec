// What goals of this cell can be made of (GET /api/plan/goal-form) and what holds now (GET /api/plan/outlook), read with
// doubt: both come from another process. supervisor/doc/goals.md says what they mean.

import { fieldsOf, listOf, numberOf, recordsOf, textOf } from '../lib/doubt';
import { t } from './texts';
import { readWhatIf, type WhatIf } from './what_if';

export interface Parameter {
  name: string;
  type: string;
}

export interface GoalSymbol {
  name: string;
  parameters: Parameter[];
  changes: boolean; // what does not is good for comparing with only
}

export interface GoalSensor {
  fluent: string; // "(level a1)"
  label: string;
  unit: string;
  step: number; // 0: any number
  range: [number, number] | null;
}

// A goal that the cell's file has a name for.
export interface NamedGoal {
  name: string;
  goal: string;
}

export interface GoalWords {
  objects: Map<string, string[]>; // by type
  predicates: GoalSymbol[];
  functions: GoalSymbol[];
  sensors: Map<string, GoalSensor>; // by fluent
  labels: Map<string, string>; // of facts that a switch shows
  orders: NamedGoal[];
}

export interface Outlook {
  goal: string;
  facts: Set<string> | null; // null: too many to be told
  fluents: Map<string, number> | null;
  whatIf: WhatIf | null;
}

const textsOf = (value: unknown): string[] => listOf(value).filter((each): each is string => typeof each === 'string');

function symbolsOf(value: unknown): GoalSymbol[] {
  return listOf(value).flatMap((each) => {
    const symbol = fieldsOf(each);
    if (!symbol || textOf(symbol.name) === '') return [];
    const parameters = listOf(symbol.parameters).map((parameter) => {
      const fields = fieldsOf(parameter);
      return { name: textOf(fields?.name), type: textOf(fields?.type) };
    });
    return [{ name: textOf(symbol.name), parameters, changes: symbol.changes === true }];
  });
}

function sensorsOf(value: unknown): Map<string, GoalSensor> {
  const sensors = new Map<string, GoalSensor>();
  for (const each of listOf(value)) {
    const sensor = fieldsOf(each);
    const fluent = textOf(sensor?.fluent);
    if (!sensor || fluent === '') continue;
    const [low, high] = listOf(sensor.range).map(numberOf);
    const range: [number, number] | null = typeof low === 'number' && typeof high === 'number' && low < high ? [low, high] : null;
    sensors.set(fluent, { fluent, label: textOf(sensor.label), unit: textOf(sensor.unit), step: Math.max(0, numberOf(sensor.step) ?? 0), range });
  }
  return sensors;
}

function ordersOf(value: unknown): NamedGoal[] {
  const orders = recordsOf(value).map(({ name, goal }) => ({ name: textOf(name), goal: textOf(goal) }));
  return orders.filter(({ name, goal }) => name !== '' && goal !== '');
}

// The words, or why there is no form.
export function readWords(value: unknown): GoalWords | string {
  const form = fieldsOf(value);
  if (!form || form.available !== true) return textOf(form?.reason) || t('noWords');
  return {
    objects: new Map(Object.entries(fieldsOf(form.objects) ?? {}).map(([type, names]) => [type, textsOf(names)])),
    predicates: symbolsOf(form.predicates),
    functions: symbolsOf(form.functions),
    sensors: sensorsOf(form.sensors),
    labels: new Map(Object.entries(fieldsOf(form.labels) ?? {}).map(([fact, label]) => [fact, textOf(label)])),
    orders: ordersOf(form.orders),
  };
}

export function readOutlook(value: unknown): Outlook | null {
  const outlook = fieldsOf(value);
  if (!outlook) return null;
  const fluents = fieldsOf(outlook.fluents);
  return {
    goal: textOf(outlook.goal),
    facts: Array.isArray(outlook.facts) ? new Set(textsOf(outlook.facts)) : null,
    fluents: fluents && new Map(Object.entries(fluents).filter((each): each is [string, number] => typeof each[1] === 'number')),
    whatIf: readWhatIf(outlook.what_if),
  };
}
