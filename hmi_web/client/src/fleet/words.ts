// States and errors of vehicles and goals in words. A word that this page does not know is shown as it came.

import type { Stop } from './document';

const STATES: Record<string, string> = {
  driving: 'drives',
  waiting: 'waits',
  serving: 'serves',
  resting: 'rests',
  lost: 'lost',
  stopped: 'stopped',
};

const GOAL_STATES: Record<string, string> = {
  waiting: 'waiting',
  carried: 'on its way',
  delivered: 'delivered',
  given_up: 'given up',
};

const STOPS: Record<string, string> = { pick_up: 'pick up', set_down: 'set down', park: 'park' };

// ErrorID of a vehicle: supervisor/doc/fleet_program.md.
const ERRORS: Record<number, string> = {
  21: 'it has left its path',
  22: 'it is told to move and does not',
  23: 'its forks do not come to their end',
  24: 'the emergency stop is pressed',
  25: 'it has run into something',
  26: 'its navigation is frozen',
  27: 'its navigation leaps, or it does not answer',
  28: 'it is outside of its polygons',
  29: 'there is no load on its forks',
  30: 'its navigation walks away from its wheels',
};

export function stateText(state: string): string {
  return STATES[state] ?? state;
}

export function goalStateText(state: string): string {
  return GOAL_STATES[state] ?? state;
}

export function stopText(stop: Stop): string {
  return STOPS[stop.kind] ?? stop.kind;
}

export function errorText(error: number): string {
  return error === 0 ? '' : (ERRORS[error] ?? `error ${error}`);
}

export function isAbnormal(state: string): boolean {
  return state === 'lost' || state === 'stopped';
}

// "on time", "12 s late", "2:05 late"
export function delayText(delayMs: number | null): string {
  if (delayMs === null) return '–';
  const seconds = Math.round(Math.abs(delayMs) / 1_000);
  if (seconds < 1) return 'on time';
  const size = seconds < 60 ? `${seconds} s` : `${Math.floor(seconds / 60)}:${String(seconds % 60).padStart(2, '0')} min`;
  return `${size} ${delayMs > 0 ? 'late' : 'early'}`;
}

export const LATE_MS = 5_000; // what is later than that is said in colour
