import type { Translation } from '../lib/language.svelte';
import type english from './bar_texts.en';

export default {
  region: 'alarmas, historial y recetas',
  alarmCount: { one: '{count} activa', other: '{count} activas' },
  unacknowledged: '{alarms}, {waiting} sin reconocer',
  noAlarms: 'Sin alarmas',
  over: 'terminada',
  noValue: { one: '{count} alarma sin valor', other: '{count} alarmas sin valor' },
  flood: 'avalancha de alarmas: {count} en diez minutos',
  alarms: 'Alarmas',
  history: 'Historial',
  recipes: 'Recetas',
  priority_critical: 'prioridad crítica',
  priority_high: 'prioridad alta',
  priority_medium: 'prioridad media',
  priority_low: 'prioridad baja',
  priorityUnacknowledged: '{priority}, sin reconocer',
} satisfies Translation<typeof english>;
