import type { Translation } from '../lib/language.svelte';
import type english from './texts.en';

export default {
  monitors: 'Überwachungen',
  failedOf: '{failed} von {total} verletzt',
  monitor: 'Überwachung',
  formula: 'Formel',
  verdict: 'Urteil',
  undecided: 'wacht',
  satisfied: 'erfüllt',
  failed: 'verletzt',
  left: 'Noch Schritte',
  state: 'Zustand',
  since: 'Zyklen darin',
} satisfies Translation<typeof english>;
