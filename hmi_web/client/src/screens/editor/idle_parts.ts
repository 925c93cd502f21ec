// Operator parts of a drawing that are not filled in: they can be saved, and do nothing. Pure.

import type { Item } from './model';
import { missedOf } from './part_symbols';
import type { FieldName } from './template';

// As the server warns of it; the editor names the part and leads to its field.
export const FIELD_MISSED = 'C0647';

export interface Idle {
  item: Item;
  missed: FieldName;
}
export const idleIn = (items: readonly Item[]): Idle[] =>
  items.flatMap((item) => {
    const missed = missedOf(item.symbol, item.params);
    return missed ? [{ item, missed }] : [];
  });
