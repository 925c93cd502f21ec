import { texts } from '../lib/language.svelte';
import english from './arms_texts.en';

export const t = texts(english, {
  de: () => import('./arms_texts.de'),
  fr: () => import('./arms_texts.fr'),
  es: () => import('./arms_texts.es'),
});
