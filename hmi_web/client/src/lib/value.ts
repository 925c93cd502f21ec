// What a tag or a point has at an instant; null: nobody knows.

export type Value = number | null;
// Of a variable of the program: a STRING and a date have a text.
export type TagValue = Value | string;

export const isTrue = (value: TagValue | undefined): boolean => typeof value === 'number' && value > 0;
export const numberOr = (value: TagValue | undefined): Value => (typeof value === 'number' ? value : null);
