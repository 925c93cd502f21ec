// Why an incident is one, in the language of the page (supervisor/run/mission.cpp, operator_hold.cpp and the missions).

import { language } from '../lib/language.svelte';
import { known, type Sentences } from '../lib/sentences';
import { t } from './texts';

type Key = Parameters<typeof t>[0];

const SENTENCES: Sentences<Key> = [
  [/^held by the operator$/, 'why_held'],
  [/^aborted by the operator$/, 'why_aborted'],
  [/^resumed after (?<seconds>[\d.]+) s$/, 'why_resumed'],
  [/^stopped from outside: (?<reason>[\s\S]+)$/, 'why_stopped'],
  [/^the runtime stopped(?: meanwhile)?: (?<reason>[\s\S]+)$/, 'why_runtimeStopped'],
  [/^the program trapped and was rolled back: (?<reason>[\s\S]+)$/, 'why_rolledBack'],
  [/^the program trapped: (?<reason>[\s\S]+)$/, 'why_trapped'],
  [/^the goal was changed to (?<what>[\s\S]+)$/, 'why_otherGoal'],
  [/^(?<what>\([^)]*\)) was changed to (?<value>\S+)$/, 'why_changed'],
  [/^another task: (?<what>[\s\S]+)$/, 'why_otherTask'],
  [/^another order: (?<what>[\s\S]+)$/, 'why_otherOrder'],
  [/^ordered (?<what>[\s\S]+)$/, 'why_ordered'],
  [/^'(?<what>[^']*)' is blocked$/, 'why_blocked'],
  [/^(?<what>.+) is blocked at \((?<x>[-\d.]+) m, (?<y>[-\d.]+) m\)$/, 'why_blockedAt'],
  [/^'?(?<what>[^']+?)'? is free again$/, 'why_free'],
  [/^(?<what>.+) is to come back$/, 'why_comesBack'],
  [/^refused: (?<reason>[\s\S]+)$/, 'why_refused'],
  [/^that is refused, there is no plan for it: (?<reason>[\s\S]+)$/, 'why_noPlan'],
];

// The cause of another plan: sentences with a semicolon between them.
export function causeText(cause: string): { text: string; lang: 'en' | undefined } {
  const parts = cause.split('; ').map(evidenceText);
  return { text: parts.map(({ text }) => text).join('; '), lang: parts.some(({ lang }) => lang === 'en') ? 'en' : undefined };
}

// `lang`: of a sentence that is in English on a page that is not.
export function evidenceText(sentence: string): { text: string; lang: 'en' | undefined } {
  const text = known(sentence, SENTENCES, t as (key: Key, values: Record<string, string>) => string);
  return { text: text ?? sentence, lang: text === null && language.code !== 'en' ? 'en' : undefined };
}
