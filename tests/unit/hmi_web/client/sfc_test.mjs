// Which steps of a chart are ticked off: those that the run has left behind, and no others; and pictures of any shape.
//
//   node --test sfc_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { load } from './load_modules.mjs';

const { passedSteps, readPicture } = await load(process.env.CLIENT, ['sfc/passed', 'sfc/picture']);

const steps = (...names) => names.map((name, index) => ({ name, comment: '', initial: index === 0 }));
const chart = (names, ways) => ({ steps: steps(...names), transitions: ways.map(([from, to]) => ({ name: '', from, to, condition: '' })) });
const ticked = (program, active, actions = []) => [...passedSteps(program, new Set(active), actions)].sort().map((index) => program.steps[index].name);

const LOOP = chart(['START', 'FILL', 'EMPTY'], [[[0], [1]], [[1], [2]], [[2], [0]]]);

test('Ticks_WhenALoopHasJustStarted_ThenNoStepOfItIsTicked', () => {
  assert.deepEqual(ticked(LOOP, [0]), [], 'the initial step is active without anything before it');
});

test('Ticks_WhenALoopGoesOn_ThenOnlyWhatLiesBehindIsTicked', () => {
  assert.deepEqual(ticked(LOOP, [1]), ['START']);
  assert.deepEqual(ticked(LOOP, [2]), ['START', 'FILL']);
});

test('Ticks_WhenAStepCanBeEnteredTwoWays_ThenNeitherIsTicked', () => {
  const fork = chart(['START', 'A', 'B', 'END'], [[[0], [1]], [[0], [2]], [[1], [3]], [[2], [3]]]);
  assert.deepEqual(ticked(fork, [3]), [], 'one of them was passed, and nobody knows which');
});

test('Ticks_WhenThePlanSaysWhatIsDone_ThenThatHolds', () => {
  const plan = chart(['START', 's1', 'REST', 's2'], [[[0], [1]], [[1], [2]], [[2], [3]]]);
  const actions = [{ index: 0, text: '', step: 's1', state: 'done' }, { index: 1, text: '', step: 's2', state: 'active' }];
  assert.deepEqual(ticked(plan, [3], actions), ['START', 's1', 'REST']);
  assert.deepEqual(ticked(plan, [1], [{ ...actions[0], state: 'active' }, { ...actions[1], state: 'pending' }]), ['START']);
});

test('Ticks_WhenThePlanComesBeforeTheImage_ThenAnActiveStepIsNotTicked', () => {
  const plan = chart(['START', 's1', 's2'], [[[0], [1]], [[1], [2]]]);
  const actions = [{ index: 0, text: '', step: 's1', state: 'done' }, { index: 1, text: '', step: 's2', state: 'active' }];
  assert.deepEqual(ticked(plan, [1], actions), ['START'], 'it is active still');
  assert.deepEqual(ticked(plan, [2], actions), ['START', 's1']);
});

test('Picture_WhenItHasAnyShape_ThenWhatIsWrongIsLeftOut', () => {
  for (const wrong of [null, 7, [], { steps: 5, lines: [[1, 2, 3], 'x'] }]) {
    const picture = readPicture(wrong, 'Main');
    assert.deepEqual([picture.chart, picture.width, picture.steps, picture.lines], ['Main', 0, [], []]);
  }
  const picture = readPicture({ digest: 'd', exits: [2], steps: [{ index: 1, x: 5, y: 6, width: 190, height: 42, entry: null }], lines: [[1, 2, 3, 4]] }, '');
  assert.deepEqual(picture.steps, [{ index: 1, x: 5, y: 6, width: 190, height: 42, entry: null }]);
  assert.deepEqual([picture.digest, picture.exits, picture.lines], ['d', [2], [[1, 2, 3, 4]]]);
});
