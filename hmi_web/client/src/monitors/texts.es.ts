import type { Translation } from '../lib/language.svelte';
import type english from './texts.en';

export default {
  monitors: 'Supervisiones',
  failedOf: '{failed} de {total} incumplidas',
  monitor: 'Supervisión',
  formula: 'Fórmula',
  verdict: 'Veredicto',
  undecided: 'vigila',
  satisfied: 'cumplida',
  failed: 'incumplida',
  left: 'Pasos restantes',
  state: 'Estado',
  since: 'Ciclos en él',
} satisfies Translation<typeof english>;
