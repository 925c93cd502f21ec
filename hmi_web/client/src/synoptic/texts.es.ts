import type { Translation } from '../lib/language.svelte';
import type english from './texts.en';

export default {
  plant: 'Planta',
  asDrawn: 'Según el dibujo',
  picture: 'sinóptico de la planta en vivo',
  line: 'sinóptico de la línea de clasificación en vivo',
  switchOpen: 'microinterruptor {name} en {place}: abierto',
  switchClosed: 'microinterruptor {name} en {place}: cerrado',
  pumpRuns: 'bomba {id}, {label}: en marcha',
  pumpStands: 'bomba {id}, {label}: parada',
  tank: '{label}: {level}',
  tankSimulated: '{label}: {level} (simulación)',
  trueLevel: 'nivel real {level}',
  drivesLeft: 'vehículo {name}, hacia la izquierda',
  drivesRight: 'vehículo {name}, hacia la derecha',
  belt: 'cinta {name}',
  eye: 'fotocélula {name}',
  pusher: 'empujador {name}',
  isForced: '{what}, valor forzado',
  stands: 'vehículo {name}, parado',
} satisfies Translation<typeof english>;
