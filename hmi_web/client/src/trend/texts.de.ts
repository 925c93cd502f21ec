import type { Translation } from '../lib/language.svelte';
import type english from './texts.en';

export default {
  levels: 'Füllstände',
  trend: 'Trend',
  nothing: 'noch nichts aufgezeichnet',
  since: 'aufgezeichnet seit {time}',
  legend: 'Legende',
  truth: 'wahrer Füllstand der Simulation',
  levelsOverTime: 'Füllstände über der Zeit',
  valuesOverTime: 'Werte über der Zeit',
} satisfies Translation<typeof english>;
