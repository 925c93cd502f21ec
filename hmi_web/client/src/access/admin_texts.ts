import { texts } from '../lib/language.svelte';
import english from './admin_texts.en';

export const t = texts(english, {
  de: () => import('./admin_texts.de'),
  fr: () => import('./admin_texts.fr'),
  es: () => import('./admin_texts.es'),
});
