// Which process does not answer, as one word: a key of the texts of this folder. What is nearer to the page comes first, as of
// what lies behind it nothing is known.

import type { LinkState } from '../lib/connection';

export interface Standing {
  link: LinkState;
  seen: boolean; // the page has shown the cell before
  runtime_alive: boolean;
  runtime_unlinked: boolean;
  runtime_state: string;
  scan: number;
  supervisor_alive: boolean;
  ended: boolean; // so has the session of whoever was logged in here, by itself
  phase: string | null; // of the supervisor's plan; null: there is none
}

export type Doubt = '' | 'loggedOut' | 'sessionEnded' | 'onlyLooks' | 'staleServer' | 'noServer' | 'staleRuntime' | 'runtimeToCome' | 'unlinked' | 'fault' | 'staleSupervisor';

// A supervisor whose run has ended may end, too.
const OVER = ['done', 'safe'];

export function doubtOf(standing: Standing): Doubt {
  if (standing.link === 'connecting') return '';
  if (standing.link === 'closed') return !standing.seen ? '' : standing.ended ? 'sessionEnded' : 'loggedOut';
  if (standing.link === 'lost') return standing.seen ? 'staleServer' : 'noServer';
  if (standing.runtime_unlinked) return 'unlinked';
  if (!standing.runtime_alive) return standing.scan > 0 ? 'staleRuntime' : 'runtimeToCome';
  if (standing.runtime_state === 'fault') return 'fault';
  if (standing.phase !== null && !standing.supervisor_alive && !OVER.includes(standing.phase)) return 'staleSupervisor';
  return standing.ended ? 'onlyLooks' : '';
}
