// What the server answers about alarms and history: hmi_web/doc/records.md. All times are ms since 1970.

import { ask as request, sentences } from '../access/api';
import { dateText } from '../lib/language.svelte';
import type { Value } from '../lib/value';

export type Priority = 'critical' | 'high' | 'medium' | 'low';

export interface Alarm {
  name: string;
  text: string;
  source: string;
  priority: Priority;
  state: string;
  active: boolean;
  value: Value;
  problem: string; // why its source, or what would suppress it, says nothing
  group: string;
  first_out: boolean;
  since_ms: Value;
  raised_ms: Value;
  shelved_until_ms: Value;
  longest_shelving_min: number; // 0: must not be shelved
  suppress_by_hand: boolean;
  // Facts that hold beside each other; the state is the strongest.
  shelved: boolean;
  suppressed: boolean;
  out_of_service: boolean;
  consequence: string;
  response: string;
  words?: Record<string, { text: string; consequence: string; response: string }>; // by language
}

export interface AlarmFigures {
  annunciated: number;
  in_ten_minutes: number;
  most_in_ten_minutes: number;
  flood: boolean;
  floods: number;
  flood_share: number;
  standing: Record<Priority, number>;
  unacknowledged: number;
  shelved: number;
  suppressed: number;
  out_of_service: number;
  no_value: number; // of all alarms, also of those that are not listed
  no_variable: number; // likewise: their variable is not in the program (any more)
  stale: string[];
  chattering: string[];
  most_frequent: { name: string; count: number }[];
}

export interface AlarmList {
  count: number;
  alarms: Alarm[];
  figures: AlarmFigures;
  journal: { failing: boolean; dropped: number; problem: string };
}

export interface JournalEntry {
  number: number;
  time_ms: number;
  alarm: string;
  source: string;
  priority: Priority;
  event: string;
  from: string;
  to: string;
  value: Value;
  first_out: boolean;
  user: string;
  comment: string;
}

export interface Notification {
  name: string;
  kind: string;
  to: string;
  priority: Priority;
  delay_s: number;
  repeat_s: number;
  sent: number;
  tests_done: number;
  sent_ms: Value;
  failed_ms: Value;
  problem: string; // of the newest try; empty: it has arrived
}

export interface Series {
  tag: string;
  least: Value[];
  greatest: Value[];
  last: Value[];
  damaged: number;
}

export interface History {
  now_ms: number;
  known_ms: number; // nothing is drawn behind it
  from_ms: number;
  to_ms: number;
  column_ms: number;
  series: Series[];
}

export interface TagList {
  now_ms: number;
  tags: string[];
  status: { failing: boolean; lost: number; file_bytes: number; calendar_ahead_s: number; ahead_s: number; problem: string };
}

export const PRIORITIES: Priority[] = ['critical', 'high', 'medium', 'low'];
const UNACKNOWLEDGED = 'unacknowledged';

export function isUnacknowledged(alarm: Alarm): boolean {
  return alarm.state === UNACKNOWLEDGED || alarm.state.endsWith(`, ${UNACKNOWLEDGED}`);
}

// Whether its condition holds is not known: it is neither normal nor does it stand.
export function isUnknown(alarm: Alarm): boolean {
  return alarm.state === 'no value' || alarm.state === 'no variable';
}

// It has gone, and waits for somebody to see that or to reset it.
export function isOver(alarm: Alarm): boolean {
  return !alarm.active && !isHidden(alarm) && !isUnknown(alarm) && alarm.state !== 'normal';
}

// Hidden ones are told apart: somebody has decided that they do not matter now.
export function isHidden(alarm: Alarm): boolean {
  return ['shelved', 'suppressed by design', 'out of service'].includes(alarm.state);
}

// What the bar tells of: how many stand, are to be acknowledged, and say nothing; first the one to look at.
export interface AlarmSummary {
  first: Alarm | undefined;
  active: number;
  waiting: number;
  unknown: number;
  gone: number; // their variable is not in the program
}

export function summaryOf(list: AlarmList | null): AlarmSummary {
  const told = (list?.alarms ?? []).filter((alarm) => !isHidden(alarm) && !isUnknown(alarm)).sort(byUrgency);
  return {
    first: told[0],
    active: told.filter(({ active }) => active).length,
    waiting: told.filter(isUnacknowledged).length,
    unknown: list?.figures.no_value ?? 0,
    gone: list?.figures.no_variable ?? 0,
  };
}

// What people should look at first: what stands before what is over, unacknowledged before acknowledged, by priority, the
// newest first; then what is not known, and what is hidden.
export function byUrgency(a: Alarm, b: Alarm): number {
  const rank = (alarm: Alarm) => {
    if (isHidden(alarm)) return 5;
    if (isUnknown(alarm)) return 4;
    return isUnacknowledged(alarm) ? (isOver(alarm) ? 1 : 0) : isOver(alarm) ? 3 : 2;
  };
  return (
    rank(a) - rank(b) ||
    PRIORITIES.indexOf(a.priority) - PRIORITIES.indexOf(b.priority) ||
    (b.since_ms ?? 0) - (a.since_ms ?? 0) ||
    a.name.localeCompare(b.name)
  );
}

export function query(parameters: Record<string, string | number>): string {
  return Object.entries(parameters)
    .filter(([, value]) => value !== '')
    .map(([name, value]) => `${name}=${encodeURIComponent(value)}`)
    .join('&');
}

// Of a field of date and time, which is of this place; '' where there is none.
export function msOf(field: string): number | '' {
  const time = field === '' ? NaN : new Date(field).getTime();
  return Number.isFinite(time) ? time : '';
}

// The answer, or an Error with the sentences that the server gives.
export async function ask<T>(path: string, signal?: AbortSignal): Promise<T> {
  const reply = await request<T>('GET', path, '', undefined, signal);
  if (!reply.ok) throw new Error(sentences(reply.problems));
  return reply.data;
}

// "23.11. 09:41:07.25" in the order of the reader's language.
export function moment(time: Value | undefined): string {
  if (time === null || time === undefined) return '–';
  return dateText(time, {
    month: '2-digit',
    day: '2-digit',
    hour: '2-digit',
    minute: '2-digit',
    second: '2-digit',
    fractionalSecondDigits: 2,
  } as Intl.DateTimeFormatOptions);
}
