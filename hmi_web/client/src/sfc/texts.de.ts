import type { Translation } from '../lib/language.svelte';
import type english from './texts.en';

export default {
  program: 'Programm',
  sfc: 'AS · {digest}',
  chart: 'Schrittkette',
  allCharts: 'alle Schrittketten',
  exits: 'Ausgänge',
  follow: 'Folgen',
  sources: 'Quellen',
  change: 'Programm ändern …',
  active: 'Aktiv: {steps}',
  view: 'Schrittkette des Programms',
  picture: 'Ablaufsprache: Schrittkette des laufenden Programms',
  parts: 'Teile des laufenden Programms',
  noChart: 'Das laufende Programm hat keine Schrittkette.',
  noProgram: 'Im Laufzeitsystem ist kein Programm geladen.',
  noRuntime: 'Ohne Laufzeitsystem gibt es kein Programm.',
  step: 'Schritt {name} {comment}, {status}',
  status_active: 'aktiv',
  status_failed: 'fehlgeschlagen',
  status_done: 'erledigt',
  status_resting: 'nicht aktiv',
} satisfies Translation<typeof english>;
