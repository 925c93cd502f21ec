import type { Translation } from '../lib/language.svelte';
import type english from './texts.en';

export default {
  drawing: 'Zeichnung der Anlage',
  forced: 'Geforct: {names}.',
  cannot: 'Die Zeichnung konnte nicht geladen werden.',
  unbound: 'In dieser Zelle an nichts gebunden: {names}',
} satisfies Translation<typeof english>;
