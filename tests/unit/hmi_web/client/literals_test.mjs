// Literals that somebody has written, held against values of the program.
//
//   node --test literals_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { load } from './load_modules.mjs';

const { isValue, meantText, sentText, typedText } = await load(process.env.CLIENT, ['lib/literals', 'lib/string_value']);

// Those of `literals` that mean the value.
const meaning = (value, type, literals, names) => literals.filter((literal) => isValue(literal, value, type, names));

test('Literal_WhenTheVariableIsAnEnumeration_ThenItsNameMeansItsValue', () => {
  const names = { '-1': 'Fault', 0: 'Off', 1: 'Hand', 7: 'Auto' };
  assert.deepEqual(meaning(1, 'INT', ['Off', 'hand', 'Mode#HAND', 'Auto', '1', '7', 'Other'], names), ['hand', 'Mode#HAND', '1']);
  assert.deepEqual(meaning(-1, 'INT', ['Fault', '-1', '1'], names), ['Fault', '-1']);
  assert.deepEqual(meaning(null, 'INT', ['Off', '0'], names), [], 'what nobody knows is no value');
});

test('Literal_WhenTheVariableIsABool_ThenBothFormsMeanIt', () => {
  assert.deepEqual(meaning(1, 'BOOL', ['TRUE', 'true', '1', 'BOOL#TRUE', 'FALSE', '0', 'yes']), ['TRUE', 'true', '1', 'BOOL#TRUE']);
  assert.deepEqual(meaning(0, 'BOOL', ['TRUE', 'FALSE', '0']), ['FALSE', '0']);
});

test('Literal_WhenTheVariableIsATime_ThenEveryWayToWriteItMeansIt', () => {
  assert.deepEqual(meaning(3, 'TIME', ['T#3s', 'TIME#3000ms', 't#0m3s', 'T#3.0s', 'T#2s_1000ms', 'T#30s', '3', '3s']), ['T#3s', 'TIME#3000ms', 't#0m3s', 'T#3.0s', 'T#2s_1000ms']);
  assert.deepEqual(meaning(5_430, 'TIME', ['T#1h30m30s', 'T#90m_30s', 'T#1.5h']), ['T#1h30m30s', 'T#90m_30s']);
  assert.deepEqual(meaning(-5e-6, 'TIME', ['T#-5us', 'T#5us']), ['T#-5us']);
});

test('Literal_WhenTheVariableIsADate_ThenItsFieldsCount', () => {
  assert.deepEqual(meaning('D#2024-02-29', 'DATE', ['D#2024-02-29', 'DATE#2024-2-29', 'D#2024-02-28']), ['D#2024-02-29', 'DATE#2024-2-29']);
  assert.deepEqual(meaning('TOD#12:30:00.5', 'TOD', ['TOD#12:30:00.50', 'TIME_OF_DAY#12:30:0.5', 'TOD#12:30:00']), ['TOD#12:30:00.50', 'TIME_OF_DAY#12:30:0.5']);
  assert.deepEqual(meaning('DT#2024-02-29-12:30:00', 'DT', ['DT#2024-02-29-12:30:00', 'DT#2024-02-29-12:30:01']), ['DT#2024-02-29-12:30:00']);
});

test('Literal_WhenTheVariableIsANumber_ThenTheNumberCountsAndNotItsDigits', () => {
  assert.deepEqual(meaning(255, 'BYTE', ['16#FF', '2#1111_1111', '8#377', 'BYTE#16#ff', '255', '+255', '25_5', '2#12', '16#FG', '']), ['16#FF', '2#1111_1111', '8#377', 'BYTE#16#ff', '255', '+255', '25_5']);
  assert.deepEqual(meaning(-12, 'INT', ['-12', 'INT#-12', '12']), ['-12', 'INT#-12']);
  assert.deepEqual(meaning(2, 'INT', ['2', '2.0', 'TRUE']), ['2']);
  assert.deepEqual(meaning(1.5, 'LREAL', ['1.5', '1.50', '15E-1', 'LREAL#1.5', '1,5']), ['1.5', '1.50', '15E-1', 'LREAL#1.5']);
  assert.deepEqual(meaning(Math.fround(0.1), 'REAL', ['0.1', '0.10', '0.2']), ['0.1', '0.10'], 'a REAL has fewer digits than a number of the page');
  assert.deepEqual(meaning('9007199254740993', 'LINT', ['9007199254740993', '9_007_199_254_740_993', '9007199254740992']), ['9007199254740993', '9_007_199_254_740_993']);
});

test('Literal_WhenTheVariableIsATextOrACharacter_ThenItsQuotesDoNotCount', () => {
  assert.deepEqual(meaning('ready', 'STRING', ["'ready'", 'ready', "'Ready'"]), ["'ready'", 'ready']);
  assert.deepEqual(meaning('two\nlines', 'STRING', ["'two$Nlines'", "'two$0alines'", 'two$Nlines', '"two$Nlines"']), ["'two$Nlines'", "'two$0alines'"]);
  assert.deepEqual(meaning('5 \u20AC', 'WSTRING', ['"5 $20AC"', '5 \u20AC', "'5 \u20AC'"]), ['"5 $20AC"', '5 \u20AC']);
  assert.deepEqual(meaning(97, 'CHAR', ["'a'", '97', "'b'"]), ["'a'", '97']);
});

test('Text_WhenAnInputBeginsWithIt_ThenWhatIsSentMeansTheSameText', () => {
  for (const type of ['STRING', 'WSTRING'])
    for (const text of ['', 'B 17', "'", "''", '""', "'quoted'", '"quoted"', 'US$ 5', "'US$ 5'", 'two\nlines\t$\u0001', "$'\r"]) {
      const typed = typedText(text, type);
      assert.doesNotMatch(typed, /[\u0000-\u001f]/, 'an input of one line drops them');
      assert.equal(meantText(sentText(typed, type), type), text, `${type} ${JSON.stringify(text)}`);
    }
  assert.equal(typedText('B 17', 'STRING'), 'B 17', 'what needs no quotes has none');
});
