// Texts, numbers and dates in the language of the page.
//
//   node --test language_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { load } from './load_modules.mjs';

const { clock, dateText, fixed, fixedText, language, numberText, short, signed, tagValue, texts, tickText, wholeClock } =
  await load(process.env.CLIENT, ['lib/language.svelte', 'lib/format']);

const ENGLISH = { hello: 'Hello {name}', alarms: { one: '{count} alarm', other: '{count} alarms' }, state_lost_again: 'lost again' };
const GERMAN = { hello: 'Hallo {name}', alarms: { one: '{count} Alarm', other: '{count} Alarme' }, state_lost_again: 'wieder verloren' };
const FRENCH = { hello: 'Bonjour {name}', alarms: { one: '{count} alarme', other: '{count} alarmes' }, state_lost_again: 'reperdu' };
const others = {
  de: async () => ({ default: GERMAN }),
  fr: async () => ({ default: FRENCH }),
  es: async () => {
    throw new Error('the server is gone');
  },
};

// As the menu does; the document's element is the browser's.
async function speak(code) {
  language.code = code;
  language.locale = code;
  const made = texts(ENGLISH, others);
  await language.settled();
  return made;
}

test('Texts_WhenALanguageHasCome_ThenPlaceholdersAndPluralsAreThoseOfIt', async () => {
  const english = await speak('en');
  assert.equal(english('hello', { name: 'Ann' }), 'Hello Ann');
  assert.deepEqual([0, 1, 2, 1234].map((count) => english('alarms', { count })), ['0 alarms', '1 alarm', '2 alarms', '1,234 alarms']);
  const german = await speak('de');
  assert.deepEqual([1, 1234].map((count) => german('alarms', { count })), ['1 Alarm', '1.234 Alarme']);
  const french = await speak('fr');
  assert.deepEqual([0, 1, 2].map((count) => french('alarms', { count })), ['0 alarme', '1 alarme', '2 alarmes'], 'nothing is singular in French');
});

test('Texts_WhenALanguageDoesNotCome_ThenTheyAreInEnglish', async () => {
  const t = await speak('es');
  assert.equal(t('hello', { name: 'Ann' }), 'Hello Ann');
});

test('Word_WhenNobodyHasForeseenIt_ThenItIsShownAsItCame', async () => {
  const t = await speak('de');
  assert.equal(t.word('state', 'lost, again'), 'wieder verloren');
  assert.equal(t.word('state', 'sleepy'), 'sleepy');
});

test('Numbers_WhenTheLanguageChanges_ThenTheyAreWrittenInIt', async () => {
  await speak('en');
  assert.deepEqual([fixed(2.345, 1), short(7.346), signed(-0.2, 2), clock(62.5), numberText(1234.5)], ['2.3', '7.35', '−0.20', '1:02.5', '1,234.5']);
  await speak('de');
  assert.deepEqual([fixed(2.345, 1), short(7.346), signed(-0.2, 2), clock(62.5), numberText(1234.5)], ['2,3', '7,35', '−0,20', '1:02,5', '1.234,5']);
  assert.equal(fixed(-0.001, 2), '0,00', 'nothing has no sign');
  assert.equal(fixedText(12345.6, 1), '12345,6', 'no marks between thousands where columns are compared');
  assert.equal(dateText(Date.UTC(2026, 10, 23, 12), { dateStyle: 'long', timeZone: 'UTC' }), '23. November 2026');
});

test('Clock_WhenTenthsSayNothing_ThenTheyAreLeftOut', async () => {
  await speak('en');
  assert.deepEqual([tickText(62), tickText(62.5), wholeClock(62.96), wholeClock(3723.4), wholeClock(null)], ['1:02', '1:02.5', '1:03', '1:02:03', '–']);
});

test('Values_WhenTheLanguageChanges_ThenTheirNumbersAreWrittenInIt', async () => {
  await speak('de');
  assert.deepEqual([tagValue(1.5, 'REAL'), tagValue(1, 'BOOL'), tagValue(2.5, 'TIME'), tagValue(-7, 'INT')], ['1,500', 'TRUE', '2,50 s', '-7']);
});
