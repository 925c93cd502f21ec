// The logic of the form of goals: rows to PDDL and back, what is wrong with a row, and documents that are not to be trusted.
//
//   node --test goal_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { load } from './load_modules.mjs';

const goal = await load(process.env.CLIENT, ['goal/words', 'goal/what_if', 'goal/conditions']);

const FORM = {
  available: true,
  objects: { vehicle: ['v1'], place: ['f1', 'a1', 'a2'], distributor: ['a1', 'a2'], client: ['c1', 'c2'] },
  predicates: [{ name: 'is-at', parameters: [{ name: 'v', type: 'vehicle' }, { name: 'p', type: 'place' }], changes: true }],
  functions: [
    { name: 'level', parameters: [{ name: 'd', type: 'distributor' }], changes: true },
    { name: 'received', parameters: [{ name: 'c', type: 'client' }], changes: true },
    { name: 'demand', parameters: [{ name: 'c', type: 'client' }], changes: false },
    { name: 'postponed', parameters: [], changes: true },
  ],
  sensors: [{ fluent: '(level a1)', label: 'level of a1', unit: 'tenths', step: 1, tolerance: 0.2, range: [0, 10] }],
  labels: { '(is-at v1 f1)': 'vehicle at f1' },
};
const PAPER = '(and\n  (is-at v1 f1)\n  (= (level a1) 5)\n  (>= (received c1) (demand c1))\n  (not (is-at v1 a2)))';
const words = goal.readWords(FORM);

test('Goal_WhenItIsOfPlainConditions_ThenItComesBackAsItWas', () => {
  const conditions = goal.readGoal(PAPER, words);
  assert.equal(conditions.length, 4);
  assert.equal(goal.writeGoal(conditions), PAPER);
  assert.equal(conditions[2].other, '(demand c1)');
  assert.equal(conditions[3].holds, false);
  assert.equal(goal.writeGoal(goal.readGoal('(IS-AT v1 F1) ; home', words)), '(is-at v1 f1)');
  assert.deepEqual(goal.readGoal('(and)', words), []);
});

test('Words_WhenACellHasNamedGoals_ThenTheyAreOrders', () => {
  const orders = [{ name: 'P1', goal: '(is-at v1 f1)' }, { name: '', goal: '(x)' }, { name: 'P2' }, 7, null];
  assert.deepEqual(goal.readWords({ ...FORM, orders }).orders, [{ name: 'P1', goal: '(is-at v1 f1)' }]);
  assert.deepEqual(words.orders, []);
});

test('Goal_WhenItSaysMore_ThenTheFormDoesNotTakeItForLess', () => {
  for (const text of [
    '', '(', ')', '(is-at v1 f1', '(is-at v1 f1))', '(or (is-at v1 f1) (is-at v1 a1))', '(forall (?p - place) (is-at v1 ?p))',
    '(= (level a1) (+ 1 2))', '(= (level a9) 3)', '(level a1)', '(is-at v1)', '(not (= (level a1) 3))', '(= (demand c1) 3)',
    '(and (is-at v1 f1) 7)', '(is-at v1 f1) (is-at v1 a1)', '(= (level a1) 3 4)',
  ]) assert.equal(goal.readGoal(text, words), null, text);
});

test('Line_WhenAProblemNamesIt_ThenItIsThatOfOneCondition', () => {
  assert.deepEqual([1, 2, 3, 5, 6].map((line) => goal.conditionOfLine(line, 4)), [-1, 0, 1, 3, -1]);
  assert.deepEqual([0, 1, 2].map((line) => goal.conditionOfLine(line, 1)), [-1, 0, -1]);
});

test('Condition_WhenANumberIsNotRight_ThenItIsSaidWhy', () => {
  const sensor = words.sensors.get('(level a1)');
  const of = (number, more = {}) =>
    goal.problemOf({ ...goal.newCondition('quantity', words), number, ...more }, sensor);
  assert.equal(of('5'), '');
  assert.match(of(''), /missing/);
  assert.match(of('five'), /'five' is no number/);
  assert.match(of('1e3'), /no number/);
  assert.match(of('11'), /from 0 to 10/);
  assert.match(of('4.5'), /steps of 1/);
  assert.equal(of('4.5', { relation: '>=' }), '');
  assert.equal(of('', { other: '(demand c1)' }), '');
  assert.equal(goal.problemOf({ ...goal.newCondition('quantity', words), number: '77' }, undefined), '');
});

test('Condition_WhenItIsAboutSomethingElse_ThenObjectsThatFitStay', () => {
  const level = { ...goal.newCondition('quantity', words), objects: ['a2'] };
  assert.equal(goal.subjectOf(level), '(level a2)');
  assert.deepEqual(goal.named(level, words.functions[1], words).objects, ['c1']);
  assert.deepEqual(goal.named({ ...level, objects: ['c2'] }, words.functions[1], words).objects, ['c2']);
  const received = goal.named(level, words.functions[1], words);
  assert.deepEqual(goal.othersOf(received, words), ['(demand c1)', '(postponed)']);
  assert.deepEqual(goal.symbolsOf('quantity', words).map(({ name }) => name), ['level', 'received', 'postponed']);
});

test('Words_WhenTheyAreWrong_ThenNothingOfThemIsTrusted', () => {
  for (const wrong of [null, 7, [], 'x', {}, { available: 'yes' }]) assert.equal(typeof goal.readWords(wrong), 'string');
  assert.equal(goal.readWords({ available: false, reason: 'a fleet has orders' }), 'a fleet has orders');
  const odd = goal.readWords({ available: true, objects: { place: 'f1', x: [1, 'a'] }, predicates: [7, { name: 3 }, { name: 'p', parameters: [null] }], sensors: [{ fluent: '(l)', range: [5, 1], step: -2 }] });
  assert.deepEqual(odd.objects.get('place'), []);
  assert.deepEqual(odd.objects.get('x'), ['a']);
  assert.deepEqual(odd.predicates, [{ name: 'p', parameters: [{ name: '', type: '' }], changes: false }]);
  assert.equal(odd.sensors.get('(l)').range, null);
  assert.equal(odd.sensors.get('(l)').step, 0);
});

test('Outlook_WhenItIsWrongOrSmall_ThenWhatIsUnknownIsUnknown', () => {
  assert.equal(goal.readOutlook([]), null);
  const small = goal.readOutlook({ goal: '(is-at v1 f1)', what_if: { state: 'thinking' } });
  assert.equal(small.facts, null);
  assert.equal(small.fluents, null);
  assert.equal(small.whatIf, null);
  const whole = goal.readOutlook({ goal: 4, facts: ['(a)', 7], fluents: { '(l)': 2, '(m)': 'x' }, what_if: null });
  assert.deepEqual([...whole.facts], ['(a)']);
  assert.deepEqual([...whole.fluents], [['(l)', 2]]);
});

test('WhatIf_WhenItIsWrong_ThenItHasNoPlan', () => {
  const told = (more) => goal.readWhatIf({ id: '7f', goal: '(a)', state: 'planned', ...more });
  assert.equal(told({}).plan, null);
  assert.equal(told({ plan: { steps: 1, cost_ahead: 'x', makespan_s: 3 } }).plan, null);
  const plan = told({ plan: { steps: 1, cost_ahead: 2, makespan_s: 3, proved_optimal: true, actions: [null, { text: '(move)', planned_start_s: 0, planned_finish_s: 3 }] } }).plan;
  assert.equal(plan.actions.length, 1);
  assert.equal(plan.actions[0].state, 'pending');
  assert.equal(plan.proved, true);
});
