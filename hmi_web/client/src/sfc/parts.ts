// The charts of a program one by one. Few small ones are drawn together, as one picture; many, as a fleet has, would
// hide each other.

import type { ProgramMessage } from '../lib/protocol';

export interface Part {
  name: string;
  firstStep: number;
  steps: number;
  firstTransition: number;
  transitions: number;
}

export const ALL = 'all charts'; // a name that no chart has: it is no identifier
const MOST_TOGETHER = 3;
const VERDICTS = ['Undecided', 'Satisfied', 'Failed'];

// All together as the first, if they are few; every program has at least one part.
export function partsOf(program: ProgramMessage): Part[] {
  const whole = { name: ALL, firstStep: 0, steps: program.steps.length, firstTransition: 0, transitions: program.transitions.length };
  const all = chartRanges(program);
  // Monitors have a panel of their own.
  const parts = all.filter((part) => !isMonitor(program, part));
  if (parts.length < all.length) return parts.length > 0 ? parts : [{ ...whole, steps: 0, transitions: 0 }];
  if (parts.length <= 1) return [whole];
  return parts.length <= MOST_TOGETHER ? [whole, ...parts] : parts;
}

// A monitor of the cell: its steps are verdicts.
export function isMonitor(program: ProgramMessage, part: Part): boolean {
  const steps = program.steps.slice(part.firstStep, part.firstStep + part.steps);
  const isOne = part.name.toLowerCase().startsWith('monitor_') && steps.length === VERDICTS.length;
  return isOne && steps.every((step, index) => step.name === VERDICTS[index]);
}

export function chartRanges(program: ProgramMessage): Part[] {
  let firstStep = 0;
  let firstTransition = 0;
  return program.charts.map(({ name, steps, transitions }) => {
    const part = { name, firstStep, steps, firstTransition, transitions };
    firstStep += steps;
    firstTransition += transitions;
    return part;
  });
}

// By its whole name or the last part of it, upper and lower case alike.
export function partNamed<T extends { name: string }>(parts: T[], name: string): T | null {
  const wanted = name.toLowerCase();
  if (wanted === '') return null;
  return parts.find((part) => [part.name, part.name.split('.').at(-1)].some((one) => one?.toLowerCase() === wanted)) ?? null;
}

export function partOf(program: ProgramMessage, part: Part): ProgramMessage {
  const shifted = (steps: number[]) => steps.map((step) => step - part.firstStep);
  return {
    ...program,
    steps: program.steps.slice(part.firstStep, part.firstStep + part.steps),
    transitions: program.transitions
      .slice(part.firstTransition, part.firstTransition + part.transitions)
      .map((transition) => ({ ...transition, from: shifted(transition.from), to: shifted(transition.to) })),
  };
}

// Those of the indices that lie in a part, counted from its first.
export function within(indices: number[], first: number, count: number): number[] {
  return indices.filter((index) => index >= first && index < first + count).map((index) => index - first);
}
