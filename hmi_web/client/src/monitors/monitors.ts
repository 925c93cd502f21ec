// The cell's monitors as its program has them (supervisor/doc/monitors.md): charts whose steps are verdicts, the first of
// which says the formula.

import type { ProgramMessage } from '../lib/protocol';
import { chartRanges, isMonitor } from '../sfc/parts';

export type Verdict = 'undecided' | 'satisfied' | 'failed';

const VERDICTS: readonly Verdict[] = ['undecided', 'satisfied', 'failed'];
// Nothing leads to TRUE any more, or ever did.
const NO_WAY = 65_535;

export interface MonitorRow {
  program: string; // "monitor_no_wash": its tags begin with it
  name: string;
  formula: string;
  firstStep: number;
}

export function monitorsOf(program: ProgramMessage): MonitorRow[] {
  return chartRanges(program)
    .filter((part) => isMonitor(program, part))
    .map((part) => ({
      program: part.name,
      name: part.name.replace(/^monitor_/i, ''),
      formula: program.steps[part.firstStep]?.comment ?? '',
      firstStep: part.firstStep,
    }));
}

// By the active steps of the program; null: none of the three is known to hold.
export function verdictOf(row: MonitorRow, active: readonly number[]): Verdict | null {
  return VERDICTS.find((_, index) => active.includes(row.firstStep + index)) ?? null;
}

// Transitions to go, at least; null where nobody knows or nothing leads there.
export function stepsLeft(left: number | null): number | null {
  return left === null || left >= NO_WAY ? null : left;
}
