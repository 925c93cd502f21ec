import type { Translation } from '../lib/language.svelte';
import type english from './texts.en';

export default {
  program: 'Programme',
  sfc: 'SFC · {digest}',
  chart: 'graphe',
  allCharts: 'tous les graphes',
  exits: 'Sorties',
  follow: 'Suivre',
  sources: 'Sources',
  change: 'Modifier le programme …',
  active: 'Actives : {steps}',
  view: 'graphe du programme',
  picture: 'diagramme fonctionnel en séquence du programme en cours',
  parts: 'parties du programme en cours',
  noChart: 'Le programme en cours n’a pas de graphe.',
  noProgram: 'Aucun programme n’est chargé dans l’automate.',
  noRuntime: 'Sans automate, pas de programme.',
  step: 'étape {name} {comment}, {status}',
  status_active: 'active',
  status_failed: 'échouée',
  status_done: 'terminée',
  status_resting: 'inactive',
} satisfies Translation<typeof english>;
