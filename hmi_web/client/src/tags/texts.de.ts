import type { Translation } from '../lib/language.svelte';
import type english from './texts.en';

export default {
  tags: 'Variablen',
  count: '{shown} von {total}',
  csv: 'CSV',
  all: 'Alle',
  search: 'Variablen nach Name oder Adresse suchen',
  searchHint: 'Name, Adresse oder Beschreibung',
  values: 'Werte der Variablen',
  tag: 'Variable',
  address: 'Adresse',
  type: 'Typ',
  value: 'Wert',
  abnormal: 'normal ist {least} bis {greatest}',
  uses: 'Verwendungen',
  usesOf: 'Verwendungen von {name}',
  leftOut: 'Felder, deren Werte hier nicht stehen, und wie viele sie haben: {arrays}',
  set: 'Setzen',
  setOne: '{name} setzen',
} satisfies Translation<typeof english>;
