// What another process wrote, taken as what it should be, or as nothing: JSON is read with doubt.

export type Fields = Record<string, unknown>;

// Null for anything but an object.
export const fieldsOf = (value: unknown): Fields | null =>
  typeof value === 'object' && value !== null && !Array.isArray(value) ? (value as Fields) : null;

export const listOf = (value: unknown): unknown[] => (Array.isArray(value) ? value : []);

export const textOf = (value: unknown): string => (typeof value === 'string' ? value : '');

export const numberOf = (value: unknown): number | null => (typeof value === 'number' && Number.isFinite(value) ? value : null);

// The objects among the elements of a list.
export const recordsOf = (value: unknown): Fields[] => listOf(value).map(fieldsOf).filter((each) => each !== null);
