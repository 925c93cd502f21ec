// What has come of a plan that is only looked at: supervisor/doc/goals.md, read with doubt.

import type { PlanAction } from '../lib/protocol';
import { fieldsOf, listOf, numberOf, textOf } from '../lib/doubt';

export type WhatIfState = 'planning' | 'planned' | 'no_plan' | 'exhausted' | 'cancelled' | 'failed';

export interface Worth {
  steps: number;
  cost: number; // from here on
  makespan_s: number;
}

export interface WhatIf {
  id: string;
  goal: string;
  state: WhatIfState;
  ahead: boolean; // actions that ran were taken for ended
  reason: string;
  wall_ms: number | null;
  plan: (Worth & { proved: boolean; actions: PlanAction[] }) | null;
  running: Worth | null; // what was left of the plan that ran
}

const STATES: WhatIfState[] = ['planning', 'planned', 'no_plan', 'exhausted', 'cancelled', 'failed'];

function worthOf(value: unknown): Worth | null {
  const worth = fieldsOf(value);
  const steps = numberOf(worth?.steps);
  const cost = numberOf(worth?.cost_ahead);
  const makespan = numberOf(worth?.makespan_s);
  if (steps === null || cost === null || makespan === null) return null;
  return { steps, cost, makespan_s: makespan };
}

function actionsOf(value: unknown): PlanAction[] {
  return listOf(value).flatMap((each, index) => {
    const action = fieldsOf(each);
    if (!action) return [];
    const planned = { planned_start_s: numberOf(action.planned_start_s), planned_finish_s: numberOf(action.planned_finish_s) };
    return [{ index, text: textOf(action.text), step: '', state: 'pending' as const, ...planned }];
  });
}

export function readWhatIf(value: unknown): WhatIf | null {
  const told = fieldsOf(value);
  const state = STATES.find((each) => each === told?.state);
  if (!told || !state) return null;
  const worth = worthOf(told.plan);
  const plan = fieldsOf(told.plan);
  return {
    id: textOf(told.id),
    goal: textOf(told.goal),
    state,
    ahead: told.ahead === true,
    reason: textOf(told.reason),
    wall_ms: numberOf(told.wall_ms),
    plan: worth && { ...worth, proved: plan?.proved_optimal === true, actions: actionsOf(plan?.actions) },
    running: worthOf(told.running),
  };
}
