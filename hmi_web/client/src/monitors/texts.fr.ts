import type { Translation } from '../lib/language.svelte';
import type english from './texts.en';

export default {
  monitors: 'Surveillances',
  failedOf: '{failed} sur {total} violées',
  monitor: 'Surveillance',
  formula: 'Formule',
  verdict: 'Verdict',
  undecided: 'surveille',
  satisfied: 'satisfaite',
  failed: 'violée',
  left: 'Étapes restantes',
  state: 'État',
  since: 'Cycles dedans',
} satisfies Translation<typeof english>;
