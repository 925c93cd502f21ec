// What a tag or a point has at an instant; null: nobody knows.

export type Value = number | null;
// Of a variable of the program: a STRING and a date have a text.
export type TagValue = Value | string;

export const isTrue = (value: TagValue | undefined): boolean => typeof value === 'number' && value > 0;
// Integers of 64 bits beyond 2^53 come as text, with all their digits: near enough for what is drawn.
export const isLongInteger = (type: string): boolean => type === 'LINT' || type === 'ULINT' || type === 'LWORD';
// A number that was kept of one is a double, which does not have all digits of it.
export const isRounded = (value: number, type: string): boolean => isLongInteger(type) && !Number.isSafeInteger(value) && Math.abs(value) !== 2 ** 53;
export const drawnNumber = (value: TagValue | undefined, type: string): Value =>
  typeof value === 'string' && isLongInteger(type) ? Number(value) : numberOr(value);
export const numberOr = (value: TagValue | undefined): Value => (typeof value === 'number' ? value : null);
