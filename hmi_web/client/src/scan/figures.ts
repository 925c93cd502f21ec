// What GET /api/scan answers (hmi_web/doc/protocol.md, "Scan"), and its parts as words.

import { ask, sentences } from '../access/api';
import { fixed, micros, UNKNOWN } from '../lib/format';
import { t } from './detail_texts';

// From, to (µs), how many.
export type Bucket = [number, number, number];

export interface Spread {
  p50_us: number;
  p99_us: number;
  p999_us: number;
  max_us: number;
  buckets: Bucket[] | null;
}

export interface Watchdog {
  limit_us: number; // 0: none
  sensitivity: number;
  too_long: number;
  expiries: number;
}

export interface Task {
  name: string;
  interval_us: number; // 0: an event, or freewheeling
  priority: number;
  cycles: number;
  overruns: number;
  skipped: number;
  execution: Spread;
  latency: Spread;
  jitter: Spread;
  watchdog: Watchdog | null;
}

export interface Device {
  name: string;
  endpoint: string;
  unit: number;
  online: boolean;
  lost: boolean;
  error: string;
  requests: number;
  timeouts: number;
  exceptions: number;
  bad_answers: number;
  connection_losses: number;
  answer_p50_us: number;
  answer_p99_us: number;
  answer_max_us: number;
  answer_age_ms: number | null;
}

export interface Io {
  kind: string;
  known: boolean;
  problem: string;
  devices: Device[];
}

export interface Topic {
  topic: string;
  writers: number;
  received: number;
  refused: number;
  lost: number;
  age_s: number | null;
}

export interface ScanTotals {
  scans: number;
  time_s: number;
  realtime_factor: number;
  overruns: number;
  p50_us: number;
  p99_us: number;
  max_us: number;
}

export interface ProcessFigures {
  version: string;
  uptime_s: number;
  resident_bytes: number;
  clients: number;
  traps: number;
  lost_events: number;
  warnings: number;
  changes: number;
}

export interface Runtime {
  runtime: string;
  own: boolean;
  alive: boolean;
  state: string;
  detail: string;
  program: string;
  scan: ScanTotals | null;
  process: ProcessFigures | null;
  tasks: Task[];
  io: Io | null;
  followers: number | null;
  dds: Topic[];
}

export type Tone = 'plain' | 'warn' | 'alarm';

// Older than this, what should come all the time does not come.
const SILENT_S = 2;

// Once. Throws an Error with the sentences that the server gives.
export async function readRuntimes(signal: AbortSignal): Promise<Runtime[]> {
  const reply = await ask<{ runtimes: Runtime[] }>('GET', '/api/scan', '', undefined, signal);
  if (!reply.ok) throw new Error(sentences(reply.problems));
  return reply.data.runtimes;
}

export function stateOf(runtime: Runtime): { word: string; tone: Tone } {
  if (!runtime.alive) return { word: runtime.state === '' ? t('neverHeard') : t('silent'), tone: 'alarm' };
  return { word: t.word('runtime', runtime.state), tone: runtime.state === 'fault' ? 'alarm' : 'plain' };
}

export function watchdogOf(watchdog: Watchdog | null): { word: string; tone: Tone } {
  if (watchdog === null) return { word: UNKNOWN, tone: 'plain' };
  if (watchdog.limit_us === 0) return { word: t('none'), tone: 'plain' };
  const limit = `${micros(watchdog.limit_us)} × ${Math.max(1, watchdog.sensitivity)}`;
  if (watchdog.expiries > 0) return { word: t('expired', { limit, count: watchdog.expiries }), tone: 'alarm' };
  if (watchdog.too_long > 0) return { word: t('tooLong', { limit, count: watchdog.too_long }), tone: 'warn' };
  return { word: t('quiet', { limit }), tone: 'plain' };
}

export function deviceState(device: Device): { word: string; tone: Tone } {
  if (device.lost) return { word: device.online ? t('valueLost') : t('lost'), tone: 'alarm' };
  return device.online ? { word: t('online'), tone: 'plain' } : { word: t('offline'), tone: 'warn' };
}

// What is sent all the time must come all the time; events and answers come when there are any.
export function topicTone(topic: Topic): Tone {
  const always = /\/(status|snapshot|health)\//.test(topic.topic);
  if (topic.refused > 0) return 'warn';
  return always && (topic.age_s === null || topic.age_s > SILENT_S) ? 'warn' : 'plain';
}

// "350 ms", "4.2 s", "3 min", "2 h 5 min", "4 d 3 h"
export function span(seconds: number | null): string {
  if (seconds === null) return UNKNOWN;
  if (seconds < 0.9995) return `${Math.round(seconds * 1000)} ms`;
  if (seconds < 60) return `${fixed(seconds, 1)} s`;
  const minutes = Math.floor(seconds / 60);
  if (minutes < 60) return `${minutes} min`;
  const hours = Math.floor(minutes / 60);
  return hours < 24 ? `${hours} h ${minutes % 60} min` : `${Math.floor(hours / 24)} d ${hours % 24} h`;
}

export function bytes(count: number): string {
  return count < 1 << 20 ? `${fixed(count / 1024, 0)} KiB` : `${fixed(count / (1 << 20), 1)} MiB`;
}
