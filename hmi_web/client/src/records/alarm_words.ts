// What an alarm says to people in the language of the page: in the words of its definition, or, of those that every cell has, in ours.

import { language } from '../lib/language.svelte';
import { known, type Sentences } from '../lib/sentences';
import { t } from './bar_texts';
import type { Alarm } from './records';

export interface AlarmWords {
  text: string;
  consequence: string;
  response: string;
  lang: 'en' | undefined; // of the text, where it is not in the page's language
}

type Key = Parameters<typeof t>[0];

// The server's own English sentences (hmi_web/recorder/cell_alarms.cpp, cell/hmi/monitor_alarms.cpp); what is in braces stays.
const OWN: Sentences<Key> = [
  [/^The runtime does not answer$/, 'own_runtimeLost'],
  [/^nobody sees what the plant does$/, 'own_nobodySees'],
  [/^see whether the runtime and its link are running$/, 'own_seeRuntime'],
  [/^The program has been stopped by a fault$/, 'own_runtimeFault'],
  [/^outputs are in their safe state$/, 'own_outputsSafe'],
  [/^see what the runtime says of it, mend the program and start it$/, 'own_mendProgram'],
  [/^The server of this page was away$/, 'own_serverAway'],
  [/^what came and went meanwhile is not in this journal$/, 'own_notInJournal'],
  [/^see the audit trail and the plan for what has happened$/, 'own_seeTrail'],
  [/^The supervisor does not answer$/, 'own_supervisorLost'],
  [/^nothing is replanned$/, 'own_nothingReplanned'],
  [/^see whether the supervisor is running$/, 'own_seeSupervisor'],
  [/^The level of (?<what>.+) is high$/, 'own_levelHigh'],
  [/^The level of (?<what>.+) is low$/, 'own_levelLow'],
  [/^stop what fills it$/, 'own_stopFilling'],
  [/^see whether it leaks, and fill it$/, 'own_seeLeak'],
  [/^What the plan relies on is lost \(monitor (?<what>\d+)\)$/, 'own_planMonitor'],
  [/^the plan does not reach its goal as it is$/, 'own_planMisses'],
  [/^see what the supervisor decides: it replans, or stops in the safe state$/, 'own_seeDecision'],
  [/^Monitor (?<what>\S+) failed: (?<formula>[\s\S]+)$/, 'own_monitor'],
  [/^the cell has left what its configuration asks for$/, 'own_leftConfiguration'],
  [/^see what happened before; the monitor begins anew with (?<what>\S+), or with the next program$/, 'own_monitorAnew'],
  [/^no image of a running program is there$/, 'own_noImage'],
  [/^the program has no variable '(?<what>[^']*)'$/, 'own_noVariable'],
  [/^'(?<what>[^']*)' has no value$/, 'own_noValue'],
  [/^the device of '(?<what>[^']*)' does not answer$/, 'own_noDevice'],
  [/^the program has no variable '(?<what>[^']*)', which would suppress it$/, 'own_noSuppressor'],
];

// A sentence of the server in the page's language; null: it is none of its own.
export const ownSentence = (sentence: string): string | null => known(sentence, OWN, t as (key: Key, values: Record<string, string>) => string);

export const translated = (sentence: string): string => ownSentence(sentence) ?? sentence;

export function wordsOf(alarm: Pick<Alarm, 'text' | 'consequence' | 'response' | 'words'>): AlarmWords {
  const given = alarm.words?.[language.code];
  const own = ownSentence(alarm.text);
  const isTold = Boolean(given?.text) || own !== null || language.code === 'en';
  return {
    text: given?.text || own || alarm.text,
    consequence: given?.consequence || translated(alarm.consequence),
    response: given?.response || translated(alarm.response),
    lang: isTold ? undefined : 'en',
  };
}
