// Literals that somebody has written, held against values of the program.
//
//   node --test literals_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

import { load } from './load_modules.mjs';

const { isValue, meantText, sentText, typedText } = await load(process.env.CLIENT, ['lib/literals', 'lib/string_value']);

// The runtime reads the same ones (tests/unit/runtime/bytecode/literals_test.cpp).
const groups = JSON.parse(readFileSync(new URL('literals.json', import.meta.url), 'utf8'));

for (const { type, value, names, same, others } of groups) {
  test(`Literal_WhenA${type}Is${JSON.stringify(value)}_ThenExactlyThoseMeanItThatTheRuntimeReadsSo`, () => {
    assert.deepEqual([...same, ...others].filter((literal) => isValue(literal, value, type, names)), same);
  });
}

test('Literal_WhenNobodyKnowsTheValue_ThenNoneMeansIt', () => {
  for (const { type, names, same } of groups) assert.ok(!same.some((literal) => isValue(literal, null, type, names)), type);
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
