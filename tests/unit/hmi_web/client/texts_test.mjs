// Every language has every text, with the same placeholders; every text is used; and nothing that people read stands outside of them.
//
//   node --test texts_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { bundles, files, LANGUAGES, strings, table, template, text, usersOf } from './client_sources.mjs';

const forms = (entry) => (typeof entry === 'string' ? [entry] : Object.values(entry));
const placeholders = (entry) => [...new Set(forms(entry).flatMap((form) => [...form.matchAll(/\{(\w+)\}/g)].map(([, name]) => name)))].sort();

test('Texts_WhenALanguageIsChosen_ThenItHasEveryKeyWithItsPlaceholders', async () => {
  assert.ok(bundles().length > 10);
  for (const bundle of bundles()) {
    const english = await table(bundle, 'en');
    for (const language of LANGUAGES) {
      const own = await table(bundle, language);
      assert.deepEqual(Object.keys(own), Object.keys(english), `the keys of ${bundle}.${language}, in their order`);
      for (const [key, entry] of Object.entries(own)) {
        const place = `${bundle}.${language}: ${key}`;
        assert.equal(typeof entry, typeof english[key], place);
        assert.deepEqual(placeholders(entry), placeholders(english[key]), place);
        for (const form of forms(entry)) assert.ok(form.trim() === form && form !== '', `${place} is not empty and has no blanks around it`);
        if (typeof entry !== 'string') assert.ok('one' in entry && 'other' in entry, `${place} has the forms of its language`);
      }
    }
  }
});

// By its name in quotes, as the first word of `t.word`, or made up in the call itself: t(`${measure}Of`).
function isUsed(key, users) {
  return users.some(({ file, name }) => {
    const source = text(file);
    if (new RegExp(`['"\`]${key}['"\`]`).test(source)) return true;
    const kinds = [...source.matchAll(new RegExp(`\\b${name}\\.word\\((\\w+|'\\w+')`, 'g'))].map(([, kind]) => kind);
    if (kinds.some((kind) => (kind.startsWith("'") ? key.startsWith(`${kind.slice(1, -1)}_`) : /^(shows|colours|keys)_/.test(key)))) return true;
    const made = [...source.matchAll(new RegExp(`\\b${name}\\(\`([^\`]*)\``, 'g'))].map(([, pattern]) => pattern.replace(/\$\{[^}]*\}/g, '\\w+'));
    return made.some((pattern) => new RegExp(`^${pattern}$`).test(key));
  });
}

test('Texts_WhenNobodyUsesOne_ThenItIsFound', async () => {
  for (const bundle of bundles()) {
    const users = usersOf(bundle);
    const unused = Object.keys(await table(bundle, 'en')).filter((key) => !isUsed(key, users));
    assert.deepEqual(unused, [], `texts of ${bundle} that no file asks for`);
  }
});

test('Help_WhenAPanelIsOnThePage_ThenItHasOne', () => {
  const topics = strings('help/topics.ts');
  const areas = files('.svelte').flatMap((file) => [...text(file).matchAll(/<Panel\b[^>]*?\barea="([^"]+)"/gs)].map(([, area]) => area));
  assert.ok(areas.length > 15);
  for (const area of areas) assert.ok(topics.includes(area), `${area} is a topic of src/help/topics.ts`);
});

const LETTERS = /\p{L}{2,}/u;
const SPOKEN = new Set(['aria-label', 'aria-description', 'aria-roledescription', 'aria-valuetext', 'title', 'placeholder', 'alt', 'label', 'note', 'action', 'lead', 'what', 'summary']);
// What is the same in every language.
const SAME = new Set(['Stepwright', 'TRUE', 'FALSE', 'NOT', '(= (level a1) 4)']);

// Strings that an expression may put on the page: not what is compared, looked up or handed to a function.
function shownBy(node) {
  if (!node || typeof node !== 'object') return [];
  if (Array.isArray(node)) return node.flatMap(shownBy);
  switch (node.type) {
    case 'Literal':
      return typeof node.value === 'string' ? [node.value] : [];
    case 'TemplateLiteral':
      return [...node.quasis.map(({ value }) => value.cooked), ...node.expressions.flatMap(shownBy)];
    case 'ConditionalExpression':
      return [...shownBy(node.consequent), ...shownBy(node.alternate)];
    case 'LogicalExpression':
      return [...shownBy(node.left), ...shownBy(node.right)];
    case 'BinaryExpression':
      return node.operator === '+' ? [...shownBy(node.left), ...shownBy(node.right)] : [];
    default:
      return [];
  }
}

// What a template shows by itself: its text, and what it gives to attributes that people see or hear.
function rawWords(node, found) {
  if (!node || typeof node !== 'object') return;
  if (Array.isArray(node)) return node.forEach((each) => rawWords(each, found));
  if (node.type === 'Text') found.push(node.data);
  else if (node.type === 'ExpressionTag') found.push(...shownBy(node.expression));
  else if (node.type === 'Attribute') {
    if (SPOKEN.has(node.name)) rawWords(node.value, found);
  } else if (node.type !== 'StyleDirective') {
    for (const [name, child] of Object.entries(node)) {
      if (!['expression', 'test', 'declaration', 'key', 'context', 'parameters', 'metadata'].includes(name)) rawWords(child, found);
    }
  }
}

test('Templates_WhenTheyShowWords_ThenTheseComeFromTheTexts', () => {
  const raw = files('.svelte').flatMap((file) => {
    const found = [];
    rawWords(template(file).fragment, found);
    return found
      .map((words) => words.trim())
      .filter((words) => LETTERS.test(words.replace(/&\w+;/g, '')) && !SAME.has(words))
      .map((words) => `${file}: ${words}`);
  });
  assert.deepEqual(raw, [], 'words in templates that are in no table of texts');
});

// Strings of several words that nobody reads on the page, with what they are.
const NOT_SHOWN = new Map([
  ['suppressed by design', 'a state, as the server says it'],
  ['out of service', 'a state, as the server says it'],
  ['latched, acknowledged', 'a state, as the server says it'],
  ['released from the banner', 'for the audit trail, which is in English'],
  ['(pointer: coarse)', 'a media query'],
  ['(prefers-color-scheme: dark)', 'a media query'],
  ['(prefers-reduced-motion: reduce)', 'a media query'],
  ['input, textarea, select, dialog', 'a selector of elements'],
  ['all charts', 'a mark; the panel has a text for it'],
]);

// Elements and attributes of SVG, or pieces of them.
const MARKUP = /^[^\p{L}]*<\w+[ >]|="[^"]*$/u;

test('Scripts_WhenTheyHaveSentences_ThenTheseComeFromTheTexts', () => {
  const scripts = files('.ts', '.svelte').filter((name) => !/texts\.\w+\.ts$/.test(name));
  const raw = scripts.flatMap((file) =>
    strings(file)
      .filter((words) => /\p{L}\p{Ll}{2,}[,;:]? \p{L}{2,}/u.test(words) && !NOT_SHOWN.has(words) && !MARKUP.test(words))
      .map((words) => `${file}: ${words}`),
  );
  assert.deepEqual(raw, [], 'sentences in scripts that are in no table of texts');
});
