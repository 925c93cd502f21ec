// What the page says of alarms: what stands, what is over, and of which nobody knows.
//
//   node --test records_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { load } from './load_modules.mjs';

const { byUrgency, isOver, summaryOf } = await load(process.env.CLIENT, ['records/records']);

const alarm = (name, state, more = {}) => ({
  name, state, text: name, priority: 'medium', active: /^(un)?acknowledged$/.test(state), since_ms: 1, raised_ms: 1, ...more,
});
const list = (alarms, unknown = 0) => ({ count: 9, alarms, figures: { no_value: unknown } });

test('Bar_WhenTheOnlyAlarmHasReturned_ThenNoneIsActive', () => {
  const gone = alarm('level', 'returned, unacknowledged');
  const { first, active, waiting } = summaryOf(list([gone]));
  assert.equal(first, gone, 'it is still told: somebody is to see it');
  assert.ok(isOver(first));
  assert.deepEqual([active, waiting], [0, 1]);
});

test('Bar_WhenOneStandsAndAMoreUrgentOneHasReturned_ThenTheOneThatStandsComesFirst', () => {
  const gone = alarm('fire', 'returned, unacknowledged', { priority: 'critical', since_ms: 9 });
  const stands = alarm('level', 'unacknowledged', { priority: 'low' });
  const { first, active, waiting } = summaryOf(list([gone, stands]));
  assert.equal(first, stands);
  assert.deepEqual([active, waiting], [1, 2]);
});

test('Bar_WhenALatchIsLeft_ThenItIsOverButNotGone', () => {
  assert.ok(isOver(alarm('door', 'latched, acknowledged')));
  assert.ok(!isOver(alarm('door', 'acknowledged')));
  assert.ok(!isOver(alarm('door', 'shelved')), 'nobody is to look at it');
});

test('Bar_WhenAlarmsHaveNoValue_ThenTheyAreCountedAndDoNotStand', () => {
  const unknown = alarm('misspelt', 'no value');
  const summary = summaryOf(list([unknown], 3));
  assert.deepEqual(summary, { first: undefined, active: 0, waiting: 0, unknown: 3 });
  assert.deepEqual(summaryOf(null), { first: undefined, active: 0, waiting: 0, unknown: 0 });
});

test('List_WhenAlarmsAreOfEveryKind_ThenWhatStandsComesFirstAndWhatIsHiddenLast', () => {
  const states = ['shelved', 'no value', 'latched, acknowledged', 'acknowledged', 'returned, unacknowledged', 'unacknowledged'];
  const sorted = states.map((state) => alarm(state, state)).sort(byUrgency).map(({ state }) => state);
  assert.deepEqual(sorted, [...states].reverse());
});
