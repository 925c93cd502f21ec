// Which variables the page marks as forced, and how it shows texts.
//
//   node --test forces_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { load } from './load_modules.mjs';

globalThis.window = { setTimeout, clearTimeout, location: { reload: () => {} } };
const { Cell, ForcedNames, isTrue, neighbours, RowLimit, tagValue } = await load(process.env.CLIENT, [
  'lib/cell.svelte', 'lib/forces', 'lib/format', 'lib/keep_focus', 'lib/row_limit.svelte', 'lib/value',
]);

const force = (name) => ({ name, value: '1', user: '', reason: '', since_s: null, until_s: null });

test('Forced_WhenNamesAreCompared_ThenCaseDoesNotMatterAndPartsCount', () => {
  const forced = new ForcedNames([force('Main.Level'), force('Main.list[3]'), force('Main.drive')]);
  for (const name of ['Main.Level', 'main.level', 'Main.list[3]', 'Main.list', 'Main.drive.speed']) assert.ok(forced.has(name), name);
  for (const name of ['', 'Main.Levels', 'Main.list[4]', 'Level', 'Main']) assert.equal(forced.has(name), name === 'Main', name);
  assert.ok(!new ForcedNames([]).has('Main.Level'));
});

test('Forced_WhenTheServerTellsOfForces_ThenTheCellKnowsTheVariables', () => {
  const cell = new Cell();
  assert.ok(!cell.forced.has('Main.Level'));
  cell.take({ type: 'forces', revision: 1, forces: [force('Main.Level')] });
  assert.ok(cell.forced.has('main.level'));
});

test('Text_WhenAVariableHasOne_ThenItIsShownAndIsNoNumber', () => {
  assert.equal(tagValue('ready', 'STRING'), "'ready'");
  assert.equal(tagValue('', 'STRING'), "''", 'an empty text is one');
  assert.equal(tagValue('ready', 'WSTRING'), '"ready"');
  assert.equal(tagValue('D#2026-11-26', 'DATE'), 'D#2026-11-26');
  assert.equal(tagValue(null, 'STRING'), '–');
  assert.ok(!isTrue('1') && isTrue(1) && !isTrue(0) && !isTrue(null));
  const cell = new Cell();
  const tags = [{ name: 'Main.word', type: 'STRING', address: '' }, { name: 'Main.n', type: 'INT', address: '' }];
  cell.take({ type: 'program', revision: 1, digest: 'ab', charts: [], steps: [], transitions: [], tags });
  cell.take({ type: 'state', seq: 1, program: 'ab', points: [], tags: { 0: 'ready', 1: 7 } });
  assert.deepEqual([cell.tagValue('main.word'), cell.tag('main.word'), cell.tag('main.n')], ['ready', null, 7]);
});

test('Rows_WhenThereAreThousands_ThenAFewHundredAreOnThePage', () => {
  const rows = Array.from({ length: 5_000 }, (_, i) => i);
  const limit = new RowLimit();
  assert.ok(limit.of(rows).length <= 200);
  assert.equal(limit.of([1, 2]).length, 2);
  const before = limit.of(rows).length;
  limit.more();
  assert.ok(limit.of(rows).length > before);
});

test('Focus_WhenItsPlaceIsGone_ThenNeighboursAreLookedAtFromTheNearestOn', () => {
  assert.deepEqual(neighbours(1, 4), [1, 2, 3, 0]);
  assert.deepEqual(neighbours(3, 3), [2, 1, 0], 'the last row was removed');
  assert.deepEqual(neighbours(0, 0), []);
});
