// The end of a run in numbers: every measured fluent against the goal.

import type { PlanDocument, Value } from '../lib/protocol';

export interface FinalValue {
  fluent: string; // "(level a1)"
  goal: Value; // null: the goal says nothing of it
  reached: Value;
}

const EQUALITY = /^\(= (\([^()]+\)) (-?\d+(?:\.\d+)?)\)$/;

export function finalValues(plan: PlanDocument): FinalValue[] {
  const wanted = new Map<string, number>();
  for (const goal of plan.goal ?? []) {
    const [, fluent, value] = EQUALITY.exec(goal.text) ?? [];
    if (fluent && value) wanted.set(fluent, Number(value));
  }
  const observed = plan.observed ?? {};
  return [...new Set([...wanted.keys(), ...Object.keys(observed)])].map((fluent) => ({
    fluent,
    goal: wanted.get(fluent) ?? null,
    reached: observed[fluent] ?? null,
  }));
}

// "(level a1)" -> ["a1"]
export function objectsOf(fluent: string): string[] {
  return fluent.replace(/[()]/g, '').split(' ').slice(1);
}
