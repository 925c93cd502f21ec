// States and errors of vehicles and goals in words. A word that this page does not know is shown as it came.

import type { Stop } from './document';
import { t } from './texts';

export function stateText(state: string): string {
  return t.word('state', state);
}

export function goalStateText(state: string): string {
  return t.word('goalState', state);
}

export function stopText(stop: Stop): string {
  return t.word('stop', stop.kind);
}

// ErrorID of a vehicle: supervisor/doc/fleet_program.md.
export function errorText(error: number): string {
  if (error === 0) return '';
  const text = t.word('error', String(error));
  return text === String(error) ? t('errorNumber', { number: String(error) }) : text;
}

export function isAbnormal(state: string): boolean {
  return state === 'lost' || state === 'stopped';
}

// "on time", "12 s late", "2:05 late"
export function delayText(delayMs: number | null): string {
  if (delayMs === null) return '–';
  const seconds = Math.round(Math.abs(delayMs) / 1_000);
  if (seconds < 1) return t('onTime');
  const size = seconds < 60 ? `${seconds} s` : `${Math.floor(seconds / 60)}:${String(seconds % 60).padStart(2, '0')} min`;
  return t(delayMs > 0 ? 'late' : 'early', { time: size });
}

export const LATE_MS = 5_000; // what is later than that is said in colour
