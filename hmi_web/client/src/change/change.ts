// Changes of the running program as the server's API tells of them (hmi_web/doc/change.md).

import type { Problem } from '../access/api';

export interface Place extends Problem {
  file?: string;
  severity?: 'error' | 'warning' | 'note';
}

// A program that was brought to look at.
export interface Candidate {
  program: string; // its digest
  name: string;
  bytes: number;
  warnings: Place[];
}

export interface Difference {
  name: string;
  before: string;
  after: string;
}

export interface Rows<T> {
  count: number; // of all; not all may be in `rows`
  rows: T[];
}

export const LISTS = ['added', 'removed', 'retyped', 'shortened', 'references', 'moved', 'tasks'] as const;
export type List = (typeof LISTS)[number];

export interface Comparison {
  running: string;
  program: string;
  carried: number;
  lists: Record<List, Rows<Difference>>;
  steps: Record<'added' | 'removed', Rows<{ name: string; active: boolean }>>;
  refusals: Record<'now' | 'keep' | 'restart', Place[]>;
}

export type Outcome = 'found' | 'trial' | 'kept' | 'rolled_back' | 'unknown';

export interface Version {
  program: string;
  name: string;
  user: string;
  reason: string;
  replaced: string;
  when_ms: number;
  outcome: Outcome;
  note: string;
}

export interface ChangeRecord {
  program: string;
  base: string;
  name: string;
  user: string;
  reason: string;
  when_ms: number;
  charts: 'keep' | 'restart';
  outcome: 'trial' | 'kept' | 'rolled_back' | 'ended';
  scan: number;
  scans: number;
  why: string;
  takeover: {
    carried: number;
    initialised: number;
    dropped: number;
    retyped: number;
    dropped_forces: number;
    pause_us: number;
    notes: string[];
  };
}

export interface ChangeState {
  running: string; // digest; empty: no program is known
  engaged: string; // what the supervisor does here; empty: nobody is in the way
  newest: ChangeRecord | null;
  versions: Version[];
  damaged: string[];
}

// As much of a digest as people compare.
export const shortDigest = (digest: string): string => digest.slice(0, 12);

// Of the runtime's containers (runtime/host/limits.h) and of sources (hmi_web/api/online_change_service.h).
const MOST_BYTES = 16 * 2 ** 20;
const MOST_SOURCE_BYTES = 2 * 2 ** 20;

export type Brought = { name: string; container: string } | { files: Record<string, string> };
export type Choice = { ok: true; body: Brought; texts: Map<string, string[]> } | { ok: false; why: 'mixed' | 'large' };

const isContainer = (name: string): boolean => name.toLowerCase().endsWith('.swb');

export function base64Of(bytes: Uint8Array): string {
  let text = '';
  // So many arguments at once a function takes in every browser.
  for (let at = 0; at < bytes.length; at += 8_192) text += String.fromCharCode(...bytes.subarray(at, at + 8_192));
  return btoa(text);
}

// What is sent of files that somebody chose: one container, or sources. `texts`: lines, to be shown beside what is wrong.
export async function readChoice(files: readonly File[]): Promise<Choice> {
  const container = files.find(({ name }) => isContainer(name));
  if (container) {
    if (files.length > 1) return { ok: false, why: 'mixed' };
    if (container.size > MOST_BYTES) return { ok: false, why: 'large' };
    const bytes = new Uint8Array(await container.arrayBuffer());
    return { ok: true, body: { name: container.name, container: base64Of(bytes) }, texts: new Map() };
  }
  if (files.some(({ size }) => size > MOST_SOURCE_BYTES)) return { ok: false, why: 'large' };
  const read = await Promise.all(files.map(async (file) => [file.name, await file.text()] as const));
  const texts = new Map(read.map(([name, text]) => [name, text.split(/\r?\n/)]));
  return { ok: true, body: { files: Object.fromEntries(read) }, texts };
}
