import type { Translation } from '../lib/language.svelte';
import type english from './texts.en';

export default {
  drawing: 'Zeichnung der Anlage',
  forced: 'Geforct: {names}.',
  cannot: 'Die Zeichnung konnte nicht geladen werden.',
  unbound: 'In dieser Zelle an nichts gebunden: {names}',
  unfilled: { one: 'Nicht ausgefüllt: das Feld {names} eines Symbols.', other: 'Nicht ausgefüllt: die Felder {names} von Symbolen.' },
  unread: 'Kein Wert der Anlage: {reasons}.',
} satisfies Translation<typeof english>;
