// Which measured fluents an active action is changing right now, and what to. Between its start and its end
// neither of the two values is "expected", so that a difference would mean nothing.

import type { PlanAction, PlanDocument } from '../lib/protocol';

// An action's `expected` counts in the order of the plan: what differs from the action before it, this action changes.
export function movingTargets(plan: PlanDocument | null): Map<string, number> {
  const targets = new Map<string, number>();
  const actions = plan?.actions ?? [];
  actions.forEach((action, index) => {
    if (action.state !== 'active') return;
    const before = actions[index - 1]?.expected ?? plan?.expected ?? {};
    for (const [fluent, value] of changes(action, before)) targets.set(fluent, value);
  });
  return targets;
}

function changes(action: PlanAction, before: Record<string, unknown>): [string, number][] {
  const found: [string, number][] = [];
  for (const [fluent, value] of Object.entries(action.expected ?? {})) {
    if (typeof value === 'number' && value !== before[fluent]) found.push([fluent, value]);
  }
  return found;
}
