import type { Translation } from '../lib/language.svelte';
import type english from './bar_texts.en';

export default {
  region: 'alarmes, historique et recettes',
  alarmCount: { one: '{count} active', other: '{count} actives' },
  unacknowledged: '{alarms}, {waiting} à acquitter',
  noAlarms: 'Aucune alarme',
  over: 'disparue',
  noValue: { one: '{count} alarme sans valeur', other: '{count} alarmes sans valeur' },
  flood: 'avalanche d’alarmes : {count} en dix minutes',
  alarms: 'Alarmes',
  history: 'Historique',
  recipes: 'Recettes',
  priority_critical: 'priorité critique',
  priority_high: 'priorité haute',
  priority_medium: 'priorité moyenne',
  priority_low: 'priorité basse',
  priorityUnacknowledged: '{priority}, à acquitter',
} satisfies Translation<typeof english>;
