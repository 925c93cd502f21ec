import type { Translation } from '../lib/language.svelte';
import type english from './texts.en';

export default {
  drawing: 'dessin de l’installation',
  forced: 'Variables forcées : {names}.',
  cannot: 'Le dessin n’a pas pu être chargé.',
  unbound: 'Lié à rien dans cette cellule : {names}',
  unfilled: { one: 'Non rempli : le champ {names} d’un symbole.', other: 'Non remplis : les champs {names} de symboles.' },
  unread: 'Aucune valeur de l’installation : {reasons}.',
} satisfies Translation<typeof english>;
