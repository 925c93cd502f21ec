import type { Translation } from '../lib/language.svelte';
import type english from './texts.en';

export default {
  plant: 'Anlage',
  asDrawn: 'Wie gezeichnet',
  picture: 'Fließbild der Anlage mit aktuellen Werten',
  line: 'Bild der Sortierlinie mit aktuellen Werten',
  switchOpen: 'Mikroschalter {name} an {place}: offen',
  switchClosed: 'Mikroschalter {name} an {place}: geschlossen',
  pumpRuns: 'Pumpe {id}, {label}: läuft',
  pumpStands: 'Pumpe {id}, {label}: steht',
  tank: '{label}: {level}',
  tankSimulated: '{label}: {level} (Simulation)',
  trueLevel: 'wahrer Füllstand {level}',
  drivesLeft: 'Fahrzeug {name}, fährt nach links',
  drivesRight: 'Fahrzeug {name}, fährt nach rechts',
  belt: 'Band {name}',
  eye: 'Lichtschranke {name}',
  pusher: 'Schieber {name}',
  isForced: '{what}, geforct',
  stands: 'Fahrzeug {name}, steht',
} satisfies Translation<typeof english>;
