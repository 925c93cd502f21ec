// Faults of a simulated plant as the server lists them: what it can have, and what holds now.

import { ask, sentences, type Problem } from '../access/api';
import { short } from '../lib/format';

export interface PlantFault {
  name: string;
  unit: string;
  meaning: string;
  // Values that happen to plants of the kind; null: nothing is known of them.
  low: number | null;
  high: number | null;
  whole: boolean;
  value: number | null; // null: it does not hold
}

// Of a plant that is real: none.
export async function readFaults(signal: AbortSignal): Promise<PlantFault[]> {
  const reply = await ask<{ answers: boolean; problems?: Problem[]; faults: PlantFault[] }>('GET', '/api/faults', '', undefined, signal);
  if (!reply.ok) throw new Error(sentences(reply.problems));
  if (!reply.data.answers) throw new Error(sentences(reply.data.problems ?? []));
  return reply.data.faults;
}

export function withUnit(value: number, unit: string): string {
  return unit === '' ? short(value) : `${short(value)} ${unit}`;
}
