import type { Translation } from '../lib/language.svelte';
import type english from './texts.en';

export default {
  scan: 'Cycle',
  state: 'État',
  cellTime: 'Temps cellule',
  p50: 'Temps de cycle p50',
  p99: 'Temps de cycle p99',
  max: 'Temps de cycle max.',
  overruns: 'Dépassements',
  speed: 'Vitesse',
  realTime: '{factor} × temps réel',
  trace: 'Trace',
  waiting: 'horloge arrêtée pour le superviseur',
  more: 'Tâches, E/S et liaisons',
} satisfies Translation<typeof english>;
