// Numbers as people type and read them: one way in every form, and no row of digits that hides what it says.
//
//   node --test numbers_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { load } from './load_modules.mjs';

const { cornersOf, dateText, decimalText, durationText, inUnits, language, literalText, marks, readNumber, short, tagValue, tickNumber, typedText, unitOf } = await load(process.env.CLIENT, [
  'access/corners', 'lib/axis', 'lib/format', 'lib/language.svelte', 'lib/number_input',
]);

function speak(code) {
  language.code = code;
  language.locale = code;
}

test('Number_WhenItIsTyped_ThenPointAndCommaAreDecimalsInEveryLanguage', () => {
  for (const code of ['en', 'de', 'fr', 'es']) {
    speak(code);
    for (const [text, value] of [['3.5', 3.5], ['3,5', 3.5], [' -0,25 ', -0.25], ['12', 12], ['0,125', 0.125]]) assert.equal(readNumber(text), value, `${text} (${code})`);
    for (const text of ['', 'x', '1.000,5', '1,000.5', '1 000', '3,', ',5', '1e3', '--1']) assert.equal(readNumber(text), null, `${text} (${code})`);
  }
  speak('en');
  assert.equal(readNumber('1,000'), null, 'a thousand, not one');
  for (const code of ['de', 'es']) {
    speak(code);
    assert.equal(readNumber('2.500'), null, `what the page writes for a thousand (${code})`);
    assert.equal(readNumber('2,500'), 2.5);
    assert.equal(readNumber('0.500'), 0.5);
  }
});

test('Number_WhenItIsTypedAgain_ThenItIsTheSame', () => {
  for (const code of ['en', 'de', 'fr', 'es']) {
    speak(code);
    for (const value of [0, -3, 0.00456, 1234.5677, 1e-7, 4.25e-12, -2.5e-9, 123456789012, 1.1e21, 0.1 + 0.2])
      assert.ok(Math.abs(readNumber(typedText(value)) - value) <= 1e-8 * Math.abs(value), `${value}: ${typedText(value)} (${code})`);
  }
  speak('de');
  assert.equal(typedText(1234.5677), '1234,5677');
});

test('Literal_WhenAVariableIsANumber_ThenItsDecimalCommaBecomesAPoint', () => {
  assert.equal(literalText('3,5', 'REAL'), '3.5');
  assert.equal(literalText('16#FF', 'UINT'), '16#FF');
  assert.equal(literalText('3,5', 'STRING'), '3,5', 'a text stays as it is');
  assert.equal(literalText('T#2s', 'TIME'), 'T#2s');
  assert.equal(decimalText('three'), null);
});

test('Block_WhenSidesAreTurnedOrNoNumbers_ThenThatIsSaidAndNothingIsSent', () => {
  const sides = { west: '1', east: '2,5', south: '0', north: '4' };
  assert.deepEqual(cornersOf(sides), { corners: [[1, 0], [2.5, 0], [2.5, 4], [1, 4]] });
  assert.deepEqual(cornersOf({ ...sides, west: '3' }), { problem: { key: 'xTurned' } });
  assert.deepEqual(cornersOf({ ...sides, west: '2.5' }), { problem: { key: 'xTurned' } }, 'a place without any width');
  assert.deepEqual(cornersOf({ ...sides, north: '-1' }), { problem: { key: 'yTurned' } });
  assert.deepEqual(cornersOf({ ...sides, south: 'low' }), { problem: { key: 'noNumber', text: 'low' } });
});

test('Value_WhenItIsHugeOrTiny_ThenItsPowerOfTenIsShown', () => {
  speak('en');
  assert.equal(short(1e38), '1E38');
  assert.equal(tickNumber(2.5e38), '2.5E38');
  assert.equal(tickNumber(1_500), '1,500');
  assert.equal(tickNumber(0), '0');
  assert.equal(tagValue(9.999999680285692e37, 'REAL'), '1E38');
  assert.equal(tagValue(0.00002, 'REAL'), '2E-5', 'it is not 0.000');
  assert.equal(tagValue(1.5, 'REAL'), '1.500');
  assert.equal(tagValue(0, 'LREAL'), '0.000');
});

test('Duration_WhenItIsOfAnyLength_ThenItsUnitSaysSomething', () => {
  speak('en');
  const said = [[0, '0 s'], [-1e-12, '0 s'], [5e-9, '5 ns'], [5e-6, '5 us'], [0.004, '4 ms'], [-0.0015, '-1.50 ms'], [0.9999, '1.00 s'], [2.5, '2.50 s'], [30, '30 s'], [59.97, '1 min'], [90, '1 min 30 s'], [7500, '2 h 5 min'], [8_654_400, '100 d 4 h']];
  for (const [seconds, text] of said) assert.equal(durationText(seconds), text, String(seconds));
});

test('Chart_WhenValuesAreHuge_ThenItIsDrawnInUnitsOfAPowerOfTenAndItsMarksSayTheValues', () => {
  const unit = unitOf([[1, null, 3e38], [undefined, -2]]);
  assert.equal(unit, 1e38);
  assert.deepEqual(inUnits([3e38, null], unit), [3, null]);
  assert.deepEqual(marks([0, 1, 2.5], unit), ['0', '1E38', '2.5E38']);
  assert.equal(unitOf([[0, 42, null]]), 1);
  assert.equal(unitOf([[]]), 1);
});

test('Time_WhenItIsShown_ThenADayHas24HoursInEveryLanguage', () => {
  const afternoon = new Date(2026, 10, 26, 15, 7, 9);
  for (const code of ['en', 'de', 'fr', 'es']) {
    speak(code);
    for (const options of [{ timeStyle: 'medium' }, { timeStyle: 'short' }, { hour: '2-digit', minute: '2-digit' }]) assert.match(dateText(afternoon, options), /^15:07/, code);
  }
});
