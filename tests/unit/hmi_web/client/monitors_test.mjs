// The panel of monitors: which charts of a program are some, and what their steps say.
//
//   node --test monitors_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { load } from './load_modules.mjs';

const { monitorsOf, verdictOf, stepsLeft, partsOf } = await load(process.env.CLIENT, ['monitors/monitors', 'sfc/parts']);

const steps = (...names) => names.map((name, index) => ({ name, comment: index === 0 ? 'never wash' : '', initial: index === 0 }));
const VERDICTS = ['Undecided', 'Satisfied', 'Failed'];
const program = (...charts) => ({
  charts: charts.map(([name, names]) => ({ name, steps: names.length, transitions: 0 })),
  steps: charts.flatMap(([, names]) => steps(...names)),
  transitions: [],
});

test('Monitors_WhenAProgramHasSome_ThenTheyAreRowsAndNoChartsToDraw', () => {
  const both = program(['plan', ['Start', 'End']], ['monitor_no_wash', VERDICTS], ['monitor_shift', ['Begin', 'End']]);
  const rows = monitorsOf(both);
  assert.deepEqual(rows, [{ program: 'monitor_no_wash', name: 'no_wash', formula: 'never wash', firstStep: 2 }]);
  assert.deepEqual(partsOf(both).map((part) => part.name), ['plan', 'monitor_shift'], 'a chart may be called so');
  const alone = program(['monitor_a', VERDICTS]);
  assert.deepEqual(partsOf(alone).map((part) => part.steps), [0], 'there is no chart to draw');
});

test('Verdict_WhenStepsAreActive_ThenTheOneOfThisMonitor', () => {
  const [first, second] = monitorsOf(program(['monitor_a', VERDICTS], ['monitor_b', VERDICTS]));
  assert.equal(verdictOf(first, [0, 5]), 'undecided');
  assert.equal(verdictOf(second, [0, 5]), 'failed');
  assert.equal(verdictOf(second, []), null);
});

test('StepsLeft_WhenNothingLeadsToTrue_ThenNone', () => {
  assert.deepEqual([stepsLeft(null), stepsLeft(65_535), stepsLeft(3), stepsLeft(0)], [null, null, 3, 0]);
});
