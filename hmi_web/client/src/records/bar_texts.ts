import { texts } from '../lib/language.svelte';
import english from './bar_texts.en';

export const t = texts(english, {
  de: () => import('./bar_texts.de'),
  fr: () => import('./bar_texts.fr'),
  es: () => import('./bar_texts.es'),
});
