import type { Translation } from '../lib/language.svelte';
import type english from './texts.en';

export default {
  scan: 'Zyklus',
  state: 'Zustand',
  cellTime: 'Anlagenzeit',
  p50: 'Zykluszeit p50',
  p99: 'Zykluszeit p99',
  max: 'Zykluszeit max.',
  overruns: 'Überläufe',
  speed: 'Tempo',
  realTime: '{factor} × Echtzeit',
  trace: 'Spur',
  waiting: 'Uhr steht für den Supervisor',
  more: 'Tasks, E/A und Verbindungen',
} satisfies Translation<typeof english>;
