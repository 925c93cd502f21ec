import type { Translation } from '../lib/language.svelte';
import type english from './texts.en';

export default {
  plant: 'Installation',
  asDrawn: 'Comme dessiné',
  picture: 'synoptique de l’installation en direct',
  line: 'synoptique de la ligne de tri en direct',
  switchOpen: 'microrupteur {name} à {place} : ouvert',
  switchClosed: 'microrupteur {name} à {place} : fermé',
  pumpRuns: 'pompe {id}, {label} : en marche',
  pumpStands: 'pompe {id}, {label} : arrêtée',
  tank: '{label} : {level}',
  tankSimulated: '{label} : {level} (simulation)',
  trueLevel: 'niveau réel {level}',
  drivesLeft: 'véhicule {name}, vers la gauche',
  drivesRight: 'véhicule {name}, vers la droite',
  belt: 'convoyeur {name}',
  eye: 'cellule {name}',
  pusher: 'poussoir {name}',
  isForced: '{what}, valeur forcée',
  stands: 'véhicule {name}, à l’arrêt',
} satisfies Translation<typeof english>;
