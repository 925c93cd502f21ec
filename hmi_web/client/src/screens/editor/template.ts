// What a symbol's template is, and how its SVG is written. Pure.

// What can be said of a symbol, all as text; empty: nothing.
export const FIELDS = [
  'label', 'text', 'size', 'value', 'on', 'warn', 'alarm', 'from', 'to', 'digits', 'unit', 'write', 'stop', 'literal', 'values',
  'step', 'confirm', 'least', 'go', 'tags', 'minutes', 'picture', 'face', 'arrow', 'points',
] as const;
export type FieldName = (typeof FIELDS)[number];
export type Params = Partial<Record<FieldName, string>> & Record<string, string | undefined>;

// Fields that name a variable, which is found by searching.
export const TAG_FIELDS: readonly string[] = ['value', 'on', 'warn', 'alarm', 'write', 'stop'];
export const NUMBER_FIELDS: readonly string[] = ['from', 'to', 'digits', 'step', 'minutes', 'size'];

export interface SymbolTemplate {
  kind: string;
  family: 'equipment' | 'values' | 'operator' | 'lists';
  width: number;
  height: number;
  fields: readonly FieldName[];
  turns?: boolean; // it can be turned
  byPoints?: boolean; // it is drawn point by point, and turned with its points
  draw: (params: Params, width: number, height: number, called?: (name: string) => string) => string; // `called`: what people call a variable
  beside?: (params: Params, width: number, height: number) => string; // what is not turned with it
  attributes?: (params: Params, key: string) => string; // of the element around it
}

const ENTITIES: Record<string, string> = { '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;', "'": '&#39;' };
export const escaped = (text: string): string => text.replace(/[&<>"']/g, (sign) => ENTITIES[sign] ?? sign);

// Nothing where there is nothing to say.
export const attribute = (name: string, value: string | undefined): string => (value ? ` ${name}="${escaped(value)}"` : '');

// What a symbol shows by its colour, and is called by who does not see it.
const shown = (p: Params): string => p.label || p.on || p.value || '';
export const titled = (p: Params): string => (shown(p) ? `<title>${escaped(shown(p))}</title>` : '');
export const states = (p: Params): string => attribute('data-on', p.on) + attribute('data-warn', p.warn) + attribute('data-alarm', p.alarm);
export const alive = (p: Params, inside: string): string => `<g${states(p)}>${titled(p)}${inside}</g>`;
