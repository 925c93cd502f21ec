// The language of the page: texts, numbers, dates. How texts come to a panel:
//   1. `texts.en.ts` beside it holds them, and is fetched with it: `export default { title: 'Plan', done: '{done} of {total}',
//      vehicles: { one: '{count} vehicle', other: '{count} vehicles' } } as const;`
//   2. `texts.de.ts`, `texts.fr.ts`, `texts.es.ts`, fetched when they are wanted: `export default { ... } satisfies Translation<typeof english>;`
//   3. `texts.ts` joins them: `export const t = texts(english, { de: () => import('./texts.de'), fr: ..., es: ... });`
//   4. The panel says `{t('title')}`, `{t('done', { done, total })}`, `{t('vehicles', { count })}`; `t.word('state', word)` is the
//      text `state_<word>`, or the word as it came; `await complete(import(...))` fetches a panel together with its texts.
//   5. What the server says stays as it comes, in an element with lang="en"; tests/unit/hmi_web/client/texts_test.mjs finds the rest.

import { recall, remember } from './remembered';

export const LANGUAGES = { en: 'English', de: 'Deutsch', fr: 'Français', es: 'Español' } as const;
export type Language = keyof typeof LANGUAGES;

// Forms by Intl.PluralRules of the language; `count` chooses one.
export interface Plural {
  one: string;
  other: string;
  many?: string;
}
export type Table = Readonly<Record<string, string | Plural>>;
export type Translation<T extends Table> = { [K in keyof T]: T[K] extends string ? string : Plural };

type Placeholders<S> = S extends `${string}{${infer Name}}${infer Rest}` ? Name | Placeholders<Rest> : never;
type Needed<T> = T extends string ? Placeholders<T> : 'count' | Placeholders<T[keyof T]>;
type Arguments<T> = [Needed<T>] extends [never] ? [] : [values: Record<Needed<T>, string | number>];

// Numbers among the values are written as the language writes them; what has its form already comes as text.
export interface Texts<T extends Table> {
  <K extends keyof T & string>(key: K, ...values: Arguments<T[K]>): string;
  // The text `<kind>_<word>`, the word's blanks and commas as underscores; a word that nobody has foreseen as it came.
  word(kind: string, word: string): string;
}

type Others<T extends Table> = Record<Exclude<Language, 'en'>, () => Promise<{ default: Translation<T> }>>;

const KEY = 'stepwright.language';

function isLanguage(code: string): code is Language {
  return Object.hasOwn(LANGUAGES, code);
}

// The page has one language, as the document has one `lang`: that is why this is no part of a context.
class PageLanguage {
  code = $state<Language>('en');
  // The language as the browser asks for it ("de-CH"), so that numbers and dates are those of its region.
  locale = $state('en');
  private readonly loaders = new Set<(code: Language) => Promise<void>>();
  private readonly pending = new Set<Promise<void>>();

  // What was chosen here before, else the first of the browser's languages that there is.
  async start(): Promise<void> {
    const wanted = [recall(KEY) ?? '', ...navigator.languages].map((tag) => tag.split('-')[0] ?? '').find(isLanguage);
    // A page without its language is better than none.
    await this.show(wanted ?? 'en').catch(() => this.show('en'));
  }

  // Fails without effect if the texts cannot be fetched.
  async choose(code: Language): Promise<void> {
    await this.show(code);
    remember(KEY, code);
  }

  // For `texts` below: loads at once what the page speaks, and whatever is chosen later.
  enrol(load: (code: Language) => Promise<void>): void {
    this.loaders.add(load);
    // Without them the panel is in English.
    if (this.code === 'en') return;
    const loading = load(this.code)
      .catch(() => undefined)
      .then(() => void this.pending.delete(loading));
    this.pending.add(loading);
  }

  async settled(): Promise<void> {
    await Promise.all(this.pending);
  }

  private async show(code: Language): Promise<void> {
    if (code !== 'en') await Promise.all([...this.loaders].map((load) => load(code)));
    this.code = code;
    this.locale = navigator.languages.find((tag) => tag === code || tag.startsWith(`${code}-`)) ?? code;
    document.documentElement.lang = code;
  }
}

export const language = new PageLanguage();

// A panel that is fetched when it is opened, with its texts: it does not appear in English first.
export async function complete<T>(panel: Promise<T>): Promise<T> {
  const fetched = await panel;
  await language.settled();
  return fetched;
}

export function texts<const T extends Table>(english: T, others: Others<T>): Texts<T> {
  let tables = $state.raw<Partial<Record<Language, Translation<T>>>>({});
  language.enrol(async (code) => {
    if (code === 'en' || tables[code]) return;
    const { default: table } = await others[code]();
    tables = { ...tables, [code]: table };
  });
  const find = (key: string): string | Plural | undefined => tables[language.code]?.[key] ?? english[key];
  const t = (key: string, values: Record<string, string | number> = {}) => filled(find(key) ?? key, values);
  const word = (kind: string, word: string) => {
    const text = find(`${kind}_${word.replace(/\W+/g, '_')}`);
    return typeof text === 'string' ? text : word;
  };
  return Object.assign(t, { word }) as Texts<T>;
}

function filled(text: string | Plural, values: Record<string, string | number>): string {
  return formOf(text, values['count']).replace(/\{(\w+)\}/g, (_, name: string) => {
    const value = values[name] ?? '';
    return typeof value === 'number' ? numberText(value) : value;
  });
}

function formOf(text: string | Plural, count: string | number | undefined): string {
  if (typeof text === 'string') return text;
  const form = rules(language.locale).select(Number(count));
  return form === 'one' || form === 'many' ? (text[form] ?? text.other) : text.other;
}

// Making one of these takes longer than using it a thousand times.
function kept<T>(make: (locale: string, detail: string) => T): (locale: string, detail?: string) => T {
  const made = new Map<string, T>();
  return (locale, detail = '') => {
    const key = `${locale} ${detail}`;
    const one = made.get(key) ?? make(locale, detail);
    made.set(key, one);
    return one;
  };
}

const rules = kept((locale) => new Intl.PluralRules(locale));
const grouped = kept((locale) => new Intl.NumberFormat(locale, { maximumFractionDigits: 6 }));
const plain = kept((locale, digits) => {
  const count = Number(digits);
  return new Intl.NumberFormat(locale, { minimumFractionDigits: count, maximumFractionDigits: count, useGrouping: false });
});
const powers = kept((locale) => new Intl.NumberFormat(locale, { notation: 'scientific', maximumFractionDigits: 3 }));
const dates = kept((locale, options) => new Intl.DateTimeFormat(locale, JSON.parse(options) as Intl.DateTimeFormatOptions));

// "1,234" and "0.05" in the language; with as many digits behind the point as there are, up to six.
export function numberText(value: number): string {
  return grouped(language.locale).format(value);
}

export function decimalMark(): string {
  return plain(language.locale, '1').formatToParts(0.5).find(({ type }) => type === 'decimal')?.value ?? '.';
}

// With exactly so many digits behind the point, and thousands not set apart; nothing has no sign.
export function fixedText(value: number, digits: number): string {
  return plain(language.locale, String(digits)).format(Number(value.toFixed(digits)) === 0 ? 0 : value);
}

// "1E38": of what would be a row of digits.
export function powerText(value: number): string {
  return powers(language.locale).format(value);
}

// Of ms since 1970; `options` as of Intl.DateTimeFormat. A day has 24 hours in every language, as axes and journals have them.
export function dateText(time: number | Date, options: Intl.DateTimeFormatOptions): string {
  return dates(language.locale, JSON.stringify({ ...options, hourCycle: 'h23' })).format(time);
}
