import type { Translation } from '../lib/language.svelte';
import type english from './texts.en';

export default {
  scan: 'Ciclo',
  state: 'Estado',
  cellTime: 'Tiempo de celda',
  p50: 'Tiempo de ciclo p50',
  p99: 'Tiempo de ciclo p99',
  max: 'Tiempo de ciclo máx.',
  overruns: 'Desbordes',
  speed: 'Velocidad',
  realTime: '{factor} × tiempo real',
  trace: 'Traza',
  waiting: 'reloj detenido por el supervisor',
  more: 'Tareas, E/S y enlaces',
} satisfies Translation<typeof english>;
