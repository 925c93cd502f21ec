import type { Translation } from '../lib/language.svelte';
import type english from './texts.en';

export default {
  drawing: 'dibujo de la planta',
  forced: 'Variables forzadas: {names}.',
  cannot: 'No se pudo cargar el dibujo.',
  unbound: 'Sin enlace en esta celda: {names}',
  unfilled: { one: 'Sin rellenar: el campo {names} de un símbolo.', other: 'Sin rellenar: los campos {names} de símbolos.' },
  unread: 'Ningún valor de la instalación: {reasons}.',
} satisfies Translation<typeof english>;
