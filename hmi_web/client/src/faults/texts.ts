import { texts } from '../lib/language.svelte';
import english from './texts.en';

export const t = texts(english, {
  de: () => import('./texts.de'),
  fr: () => import('./texts.fr'),
  es: () => import('./texts.es'),
});
