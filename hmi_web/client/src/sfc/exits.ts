// The steps in which a chart ends when something goes wrong: generated charts have one beside almost every
// action. They are left out of the drawing until asked for, or until one of them is active.

import type { ProgramMessage } from '../lib/protocol';

// A step that nothing leads out of and that only alternative branches lead into.
export function exitSteps(program: ProgramMessage): Set<number> {
  const ways = program.steps.map(() => 0);
  for (const transition of program.transitions) {
    for (const step of transition.from) ways[step] = (ways[step] ?? 0) + 1;
  }
  const exits = new Set(program.steps.flatMap((step, index) => (ways[index] === 0 && !step.initial ? [index] : [])));
  for (const transition of program.transitions) {
    const isAlternative = transition.from.some((step) => (ways[step] ?? 0) > 1);
    if (!isAlternative) transition.to.forEach((step) => exits.delete(step));
  }
  return exits;
}
