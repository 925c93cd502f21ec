import type { Translation } from '../lib/language.svelte';
import type english from './texts.en';

export default {
  program: 'Programa',
  sfc: 'SFC · {digest}',
  chart: 'gráfico',
  allCharts: 'todos los gráficos',
  exits: 'Salidas',
  follow: 'Seguir',
  sources: 'Fuentes',
  change: 'Cambiar programa …',
  active: 'Activas: {steps}',
  view: 'gráfico del programa',
  picture: 'diagrama de funciones secuenciales del programa en marcha',
  parts: 'partes del programa en marcha',
  noChart: 'El programa en marcha no tiene gráfico.',
  noProgram: 'No hay ningún programa cargado en el autómata.',
  noRuntime: 'Sin autómata no hay programa.',
  step: 'etapa {name} {comment}, {status}',
  status_active: 'activa',
  status_failed: 'fallida',
  status_done: 'terminada',
  status_resting: 'inactiva',
} satisfies Translation<typeof english>;
