import type { Translation } from '../lib/language.svelte';
import type english from './bar_texts.en';

export default {
  region: 'Alarme, Historie und Rezepte',
  alarmCount: { one: '{count} aktiv', other: '{count} aktiv' },
  unacknowledged: '{alarms}, {waiting} unquittiert',
  noAlarms: 'Keine Alarme',
  over: 'vorbei',
  noValue: { one: '{count} Alarm ohne Wert', other: '{count} Alarme ohne Wert' },
  flood: 'Alarmflut: {count} in zehn Minuten',
  alarms: 'Alarme',
  history: 'Historie',
  recipes: 'Rezepte',
  priority_critical: 'Priorität kritisch',
  priority_high: 'Priorität hoch',
  priority_medium: 'Priorität mittel',
  priority_low: 'Priorität niedrig',
  priorityUnacknowledged: '{priority}, unquittiert',
} satisfies Translation<typeof english>;
