// What another program has drawn, bound here: what is said of it stands at its outermost element. Pure.

import { attribute, type FieldName, type Params } from './template';

const ATTRIBUTES: Partial<Record<FieldName, string>> = { value: 'data-text', digits: 'data-digits', unit: 'data-unit', on: 'data-on', warn: 'data-warn', alarm: 'data-alarm' };
const OF_TEXT: readonly FieldName[] = ['value', 'digits', 'unit'];
const STATES: readonly FieldName[] = ['on', 'warn', 'alarm'];

const isText = (name: string): boolean => /^(text|tspan)$/i.test(name);

// Of an element of that name: a text shows a value, and everything has states.
const fieldsFor = (name: string): readonly FieldName[] => (isText(name) ? [...OF_TEXT, ...STATES] : STATES);
const ELEMENT = /^\s*<([A-Za-z][\w:-]*)/;
export const fieldsOfDrawn = (markup: string): readonly FieldName[] => fieldsFor(ELEMENT.exec(markup)?.[1] ?? '');

export function boundMarkup(markup: string, params: Params): string {
  const bound = fieldsOfDrawn(markup).filter((field) => !OF_TEXT.includes(field) || params.value);
  return markup.replace(ELEMENT, (begin) => begin + bound.map((field) => attribute(ATTRIBUTES[field] ?? '', params[field])).join(''));
}

// What is said of it in a file; `element` has nothing of it any more.
export function liftedFrom(element: Pick<Element, 'tagName' | 'getAttribute' | 'removeAttribute'>): Params {
  const params: Params = {};
  for (const field of fieldsFor(element.tagName)) {
    const name = ATTRIBUTES[field] ?? '';
    const said = element.getAttribute(name);
    if (said) params[field] = said;
    element.removeAttribute(name);
  }
  return params;
}
