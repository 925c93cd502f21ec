import type { Translation } from '../lib/language.svelte';
import type english from './texts.en';

export default {
  tags: 'Variables',
  count: '{shown} sur {total}',
  csv: 'CSV',
  all: 'Toutes',
  search: 'Chercher des variables par nom ou adresse',
  searchHint: 'nom, adresse ou description',
  values: 'valeurs des variables',
  tag: 'Variable',
  address: 'Adresse',
  type: 'Type',
  value: 'Valeur',
  abnormal: 'normal : de {least} à {greatest}',
  uses: 'Utilisations',
  usesOf: 'Utilisations de {name}',
  leftOut: 'Tableaux dont les valeurs ne figurent pas ici, et combien ils en ont : {arrays}',
  set: 'Régler',
  setOne: 'Régler {name}',
} satisfies Translation<typeof english>;
