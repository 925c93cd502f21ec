// Which steps of the chart the run has left behind. Only actions have a state in the plan; that a step between them
// (START, a rest, a wait) was passed follows from what it leads to: a step that can only be entered from here has been
// entered. An initial step is entered without any transition, when the program starts: it says nothing of the steps before it.

import type { PlanAction, ProgramMessage } from '../lib/protocol';

// Indices of the steps. `active` are the steps that are active now.
export function passedSteps(program: ProgramMessage, active: Set<number>, actions: PlanAction[]): Set<number> {
  const states = new Map(actions.map((action) => [action.step, action.state]));
  const passed = new Set<number>();
  const entered = new Set<number>(active);
  program.steps.forEach((step, index) => {
    const state = states.get(step.name);
    // The plan may come before the image in which its step is left.
    if (state === 'done' && !active.has(index)) passed.add(index);
    if (state === 'done' || state === 'active') entered.add(index);
  });
  // How many transitions lead into each step.
  const ways = new Map<number, number>();
  for (const { to } of program.transitions) for (const target of to) ways.set(target, (ways.get(target) ?? 0) + 1);
  // Backwards through the chart, until nothing is added.
  for (let before = -1; before !== entered.size + passed.size; ) {
    before = entered.size + passed.size;
    for (const { from, to } of program.transitions) {
      if (!to.some((target) => entered.has(target) && ways.get(target) === 1 && !program.steps[target]?.initial)) continue;
      for (const source of from) {
        entered.add(source);
        if (!active.has(source) && !states.has(program.steps[source]?.name ?? '')) passed.add(source);
      }
    }
  }
  return passed;
}
