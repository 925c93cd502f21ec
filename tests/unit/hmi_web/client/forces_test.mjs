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

const force = (name, also = []) => ({ name, value: '1', user: '', reason: '', since_s: null, until_s: null, also });

test('Forced_WhenNamesAreCompared_ThenCaseDoesNotMatterAndPartsCount', () => {
  const forced = new ForcedNames([force('Main.Level'), force('Main.list[3]'), force('Main.drive')]);
  for (const name of ['Main.Level', 'main.level', 'Main.list[3]', 'Main.list', 'Main.drive.speed']) assert.ok(forced.has(name), name);
  for (const name of ['', 'Main.Levels', 'Main.list[4]', 'Level', 'Main']) assert.equal(forced.has(name), name === 'Main', name);
  assert.ok(!new ForcedNames([]).has('Main.Level'));
});

test('Forced_WhenOthersLieAtItsPlace_ThenTheyAreForcedToo', () => {
  const forced = new ForcedNames([force('%QX0.0', ['B1', 'both'])]);
  assert.deepEqual(['b1', 'BOTH', 'both.x', 'B2', '%qx0.0'].filter((name) => forced.has(name)), ['b1', 'BOTH', 'both.x', '%qx0.0']);
});

test('Forced_WhenTheServerTellsOfForces_ThenTheCellKnowsTheVariables', () => {
  const cell = new Cell();
  assert.ok(!cell.forced.has('Main.Level'));
  cell.take({ type: 'forces', revision: 1, forces: [force('Main.Level')] });
  assert.ok(cell.forced.has('main.level'));
});

test('Forced_WhenAPointOfThePlantShowsAForcedVariable_ThenThePictureIsToldSo', () => {
  const cell = new Cell();
  const synoptic = { points: ['B1', 'a1.level', 'v1.position'].map((id) => ({ id, label: id, unit: '', trend: false })), floor: { forklifts: [], estop_ok: '' } };
  const tags = ['B1', 'S2', 'PLAN.S2_filtered'].map((name) => ({ name, type: 'INT', address: '' }));
  cell.take({ type: 'hello', protocol: 5, epoch: 'e', cell: 'bench', version: '1', recipes: false, drawing: false, synoptic });
  cell.take({ type: 'program', revision: 1, digest: 'ab', charts: [], steps: [], transitions: [], tags, points: [[0], [2, 1], []] });
  assert.equal(cell.forcedPoints.size, 0);
  cell.take({ type: 'forces', revision: 1, forces: [force('s2')] });
  assert.deepEqual([...cell.forcedPoints], ['a1.level'], 'its raw counts are forced');
  cell.take({ type: 'forces', revision: 2, forces: [force('PLAN'), force('b1')] });
  assert.deepEqual([...cell.forcedPoints], ['B1', 'a1.level']);
  cell.take({ type: 'program', revision: 2, digest: '', charts: [], steps: [], transitions: [], tags: [], points: [] });
  assert.equal(cell.forcedPoints.size, 0, 'without a program nothing is');
});

test('Text_WhenAVariableHasOne_ThenItIsShownAndIsNoNumber', () => {
  assert.equal(tagValue('ready', 'STRING'), 'ready');
  assert.equal(tagValue('', 'STRING'), '', 'an empty text is empty, and no dash');
  assert.equal(tagValue('ready', 'WSTRING'), 'ready');
  assert.equal(tagValue('D#2026-11-26', 'DATE'), 'D#2026-11-26');
  assert.equal(tagValue(null, 'STRING'), '–');
  assert.ok(!isTrue('1') && isTrue(1) && !isTrue(0) && !isTrue(null));
  const cell = new Cell();
  const tags = [{ name: 'Main.word', type: 'STRING', address: '' }, { name: 'Main.n', type: 'INT', address: '' }];
  cell.take({ type: 'program', revision: 1, digest: 'ab', charts: [], steps: [], transitions: [], tags, points: [] });
  cell.take({ type: 'state', seq: 1, program: 'ab', points: [], unread: [], tags: { 0: 'ready', 1: 7 } });
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
