import type { Translation } from '../lib/language.svelte';
import type english from './texts.en';

export default {
  levels: 'Niveles',
  trend: 'Tendencia',
  nothing: 'nada registrado todavía',
  since: 'registrado desde {time}',
  legend: 'leyenda',
  truth: 'nivel real de la simulación',
  levelsOverTime: 'niveles en el tiempo',
  valuesOverTime: 'valores en el tiempo',
} satisfies Translation<typeof english>;
