import type { Translation } from '../lib/language.svelte';
import type english from './texts.en';

export default {
  drawing: 'dibujo de la planta',
  forced: 'Variables forzadas: {names}.',
  cannot: 'No se pudo cargar el dibujo.',
  unbound: 'Sin enlace en esta celda: {names}',
  unread: 'Ningún valor de la instalación: {reasons}.',
} satisfies Translation<typeof english>;
