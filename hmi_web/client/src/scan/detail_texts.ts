import { texts } from '../lib/language.svelte';
import english from './detail_texts.en';

export const t = texts(english, {
  de: () => import('./detail_texts.de'),
  fr: () => import('./detail_texts.fr'),
  es: () => import('./detail_texts.es'),
});
