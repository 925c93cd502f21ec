import type { Translation } from '../lib/language.svelte';
import type english from './texts.en';

export default {
  tags: 'Variables',
  count: '{shown} de {total}',
  csv: 'CSV',
  all: 'Todas',
  search: 'Buscar variables por nombre o dirección',
  searchHint: 'nombre, dirección o descripción',
  values: 'valores de las variables',
  tag: 'Variable',
  address: 'Dirección',
  type: 'Tipo',
  value: 'Valor',
  abnormal: 'lo normal es de {least} a {greatest}',
  uses: 'Usos',
  usesOf: 'Usos de {name}',
  leftOut: 'Matrices cuyos valores no se muestran aquí, y cuántos tienen: {arrays}',
  set: 'Fijar',
  setOne: 'Fijar {name}',
} satisfies Translation<typeof english>;
