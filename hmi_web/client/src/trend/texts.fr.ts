import type { Translation } from '../lib/language.svelte';
import type english from './texts.en';

export default {
  levels: 'Niveaux',
  trend: 'Tendance',
  nothing: 'rien d’enregistré',
  since: 'enregistré depuis {time}',
  legend: 'légende',
  truth: 'niveau réel de la simulation',
  levelsOverTime: 'niveaux dans le temps',
  valuesOverTime: 'valeurs dans le temps',
} satisfies Translation<typeof english>;
