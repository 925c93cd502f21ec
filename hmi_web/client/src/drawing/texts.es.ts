import type { Translation } from '../lib/language.svelte';
import type english from './texts.en';

export default {
  drawing: 'dibujo de la planta',
  forced: 'Variables forzadas: {names}.',
  cannot: 'No se pudo cargar el dibujo.',
  unbound: 'Sin enlace en esta celda: {names}',
} satisfies Translation<typeof english>;
