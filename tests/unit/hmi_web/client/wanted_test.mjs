// Which tags the page asks for: ranges, choices of panels, numbers of answers, and what it says after a gap.
//
//   node --test wanted_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { load } from './load_modules.mjs';

const { rangesOf, Wanted, TrendData } = await load(process.env.CLIENT, ['lib/wanted', 'lib/trend_data']);

const wantedOf = (count = 100) => {
  const wanted = new Wanted();
  wanted.setProgram('ab', count);
  return wanted;
};

test('Ranges_WhenIndicesTouch_ThenTheyAreOneRange', () => {
  assert.deepEqual(rangesOf([]), []);
  assert.deepEqual(rangesOf([5, 3, 4, 4, 9]), [[3, 3], [9, 1]]);
});

test('Ranges_WhenThereAreTooMany_ThenThoseWithTheLeastBetweenBecomeOne', () => {
  assert.deepEqual(rangesOf([0, 2, 10, 12, 30], 3), [[0, 3], [10, 3], [30, 1]]);
  assert.deepEqual(rangesOf([0, 2, 10, 12, 30], 1), [[0, 31]]);
  const many = Array.from({ length: 5_000 }, (_, i) => 3 * i + (i % 7));
  const ranges = rangesOf(many);
  assert.equal(ranges.length, 200);
  for (const index of many) assert.ok(ranges.some(([first, count]) => index >= first && index < first + count), `${index}`);
  ranges.slice(1).forEach(([first], i) => assert.ok(first > ranges[i][0] + ranges[i][1], 'none touches another'));
});

test('Ranges_WhenTheMessageIsAsLongAsItCanBe_ThenTheServerTakesIt', () => {
  const wanted = wantedOf(10_000_000);
  wanted.show({}, Array.from({ length: 200 }, (_, i) => 9_000_000 + 1_000 * i));
  assert.ok(JSON.stringify({ type: 'show', ...wanted.next() }).length < 4_000);
});

test('Wanted_WhenPanelsShowTags_ThenAllOfThemAreAskedFor', () => {
  const wanted = wantedOf();
  const [table, program] = [{}, {}];
  wanted.show(table, [1, 2]);
  wanted.show(program, [2, 7]);
  wanted.showTrend(1);
  assert.deepEqual(wanted.next(), { number: 1, digest: 'ab', tags: [[1, 2], [7, 1]], also: ['plan', 'routes', 'pictures', 'trend'] });
  assert.equal(wanted.next(), null, 'nothing is said twice');
  wanted.show(program, []);
  wanted.showTrend(-1);
  assert.deepEqual(wanted.next(), { number: 2, digest: 'ab', tags: [[1, 2]], also: ['plan', 'routes', 'pictures'] });
});

test('Wanted_WhenTheProgramIsAnother_ThenOldIndicesAreForgotten', () => {
  const wanted = wantedOf();
  wanted.show({}, [1, 2]);
  wanted.setProgram('ab', 100);
  assert.deepEqual(wanted.first().tags, [[1, 2]]);
  wanted.setProgram('cd', 100);
  assert.deepEqual(wanted.first(), { number: 2, digest: 'cd', tags: [], also: ['plan', 'routes', 'pictures'] });
});

test('Wanted_WhenAPanelNamesWhatTheProgramHasNot_ThenItIsLeftOut', () => {
  const wanted = wantedOf(5);
  wanted.show({}, [-1, 3, 4, 5, 99]);
  assert.deepEqual(wanted.first().tags, [[3, 2]]);
});

test('Wanted_WhenTheNewestChoiceIsAnswered_ThenThePageHasItsTags', () => {
  const wanted = wantedOf();
  assert.equal(wanted.isAnswered, false);
  wanted.show({}, [1]);
  assert.equal(wanted.next().number, 1);
  wanted.show({}, [2]);
  assert.equal(wanted.next().number, 2);
  wanted.answer(1);
  assert.equal(wanted.isAnswered, false, 'that was the one before');
  wanted.answer(2);
  assert.equal(wanted.isAnswered, true);
  assert.equal(wanted.first().number, 2, 'another connection goes on with it');
  assert.equal(wanted.isAnswered, true);
  wanted.show({}, [3]);
  assert.equal(wanted.isAnswered, false, 'more is wanted than it has');
  wanted.next();
  wanted.answer(3);
  wanted.forget();
  assert.equal(wanted.isAnswered, false, 'of another run of the server it has nothing');
});

test('Trend_WhenRowsComeInPieces_ThenItKnowsWhichIsNext', () => {
  const trend = new TrendData(1);
  trend.add({ run: 2, first: 40, restart: true, rows: [[1, 10], [2, 20]] });
  assert.deepEqual([trend.run, trend.next], [2, 42]);
  trend.add({ run: 2, first: 42, restart: false, rows: [[3, 30]] });
  assert.deepEqual([trend.next, trend.times], [43, [1, 2, 3]]);
  trend.add({ run: 3, first: 0, restart: true, rows: [[0.5, 5]] });
  assert.deepEqual([trend.run, trend.next, trend.times], [3, 1, [0.5]]);
});
