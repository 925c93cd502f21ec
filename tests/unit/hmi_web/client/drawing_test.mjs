// What values make of the elements of a drawing.
//
//   node --test drawing_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { load } from './load_modules.mjs';

const drawing = await load(process.env.CLIENT, ['drawing/bindings']);

const bindings = (attributes) => drawing.bindingsOf((name) => attributes[name] ?? null);
const box = { x: 10, y: 20, width: 30, height: 40 };

test('Bindings_WhenAnElementHasSeveral_ThenEachIsRead', () => {
  assert.deepEqual(bindings({}), []);
  assert.deepEqual(bindings({ text: 'Main.level', digits: '1', unit: 'l', alarm: '!Main.ok' }), [
    { kind: 'text', name: 'Main.level', digits: 1, unit: 'l' },
    { kind: 'alarm', name: 'Main.ok', negated: true },
  ]);
  const [fill] = bindings({ fill: 'a' });
  assert.deepEqual([fill.from, fill.to], [0, 100]);
});

test('Switch_WhenItsValueIsNotKnown_ThenItIsNeitherTrueNorFalse', () => {
  const [plain] = bindings({ on: 'a' });
  const [negated] = bindings({ on: '!a' });
  assert.deepEqual([1, 0, null].map((value) => drawing.isTrue(plain, value)), [true, false, false]);
  assert.deepEqual([1, 0, null].map((value) => drawing.isTrue(negated, value)), [false, true, false]);
});

test('Fill_WhenItsValueIsHalfWay_ThenTheLowerEdgeStays', () => {
  const [fill] = bindings({ fill: 'a', from: '10', to: '20' });
  assert.equal(drawing.transformOf(fill, 15, box), 'translate(0 30) scale(1 0.5)'); // 60 * 0.5 + 30 = 60
  assert.equal(drawing.transformOf(fill, 5, box), 'translate(0 60) scale(1 0)');
  assert.equal(drawing.transformOf(fill, 99, box), 'translate(0 0) scale(1 1)');
});

test('Range_WhenItRunsDownwardsOrIsNotKnown_ThenTheElementMovesOrStaysAsDrawn', () => {
  const [move] = bindings({ move: 'a', from: '1', to: '-1', x: '200', y: '-50' });
  assert.equal(drawing.transformOf(move, 0, box), 'translate(100 -25)');
  assert.equal(drawing.transformOf(move, null, box), '');
  const [turn] = bindings({ turn: 'a', to: '10', degrees: '270' });
  assert.equal(drawing.transformOf(turn, 5, box), 'rotate(135 25 40)');
});

test('Pose_WhenItIsKnown_ThenTheElementIsPlacedOnItsFloor', () => {
  const around = { 'floor-scale': '20', 'floor-x': '10', 'floor-y': '500' };
  const [pose] = drawing.bindingsOf((name) => ({ 'pose-x': 'v1.x', 'pose-y': 'v1.y', 'pose-heading': 'v1.heading' })[name] ?? null, (name) => around[name] ?? null);
  assert.deepEqual(pose, { kind: 'pose', name: 'v1.x', y: 'v1.y', heading: 'v1.heading', floor: { x: 10, y: 500, scale: 20 } });
  assert.deepEqual(drawing.namesOf(pose), ['v1.x', 'v1.y', 'v1.heading']);
  assert.equal(drawing.poseTransform(pose, [2, 3, Math.PI / 2]), 'translate(50 440) rotate(-90)');
  assert.equal(drawing.poseTransform(pose, [2, null, 0]), null);
  assert.equal(drawing.poseTransform(pose, [2, 3, null]), null);
  const [pallet] = drawing.bindingsOf((name) => ({ 'pose-x': 'pallet p1.x', 'pose-y': 'pallet p1.y', ...around })[name] ?? null);
  assert.deepEqual(drawing.namesOf(pallet), ['pallet p1.x', 'pallet p1.y']);
  assert.equal(drawing.poseTransform(pallet, [0, 0]), 'translate(10 500)');
});

test('Pose_WhenHalfOfItIsMissing_ThenThereIsNone', () => {
  assert.deepEqual(bindings({ 'pose-x': 'a' }), []);
});

test('Text_WhenTheCellDescribesItsTag_ThenItHasUnitDecimalsAndNamesAndTheDrawingComesFirst', () => {
  const note = { name: 'Main.level', unit: 'l', decimals: 1 };
  const level = { value: 12.46, type: 'REAL', note };
  assert.equal(drawing.textOf(level), '12.5 l');
  assert.equal(drawing.textOf(level, 0, '%'), '12 %');
  assert.equal(drawing.textOf({ value: 12.46, type: 'REAL' }), '12.460');
  assert.equal(drawing.textOf({ value: 1, type: 'BOOL', note: { name: 'b', values: ['shut', 'open'] } }), 'open');
  assert.equal(drawing.textOf({ value: 7, type: 'INT', names: { 7: 'Auto' } }), 'Auto');
  assert.equal(drawing.textOf({ value: 2.5, type: 'TIME', note: { name: 't', decimals: 0 } }), '2.50 s');
  assert.equal(drawing.textOf({ value: 'ready', type: 'STRING' }), 'ready', 'a text has no quotes');
  assert.equal(drawing.textOf({ value: null, type: 'REAL', note }), '–');
  assert.equal(drawing.textOf(null), '–');
});

test('Fill_WhenItIsReadOut_ThenItHasTheUnitAndTheDigitsThatMeanSomething', () => {
  assert.equal(drawing.spokenOf({ value: 12.5, type: 'REAL' }), '12.5');
  assert.equal(drawing.spokenOf({ value: 12.5, type: 'REAL', note: { name: 'a', unit: 'l' } }), '12.5 l');
  assert.equal(drawing.spokenOf({ value: 1, type: 'BOOL' }), 'TRUE');
  assert.equal(drawing.spokenOf({ value: 3, type: 'TIME' }), '3 s');
  assert.equal(drawing.textOf({ value: 90, type: 'TIME', note: { name: 't', unit: 's' } }, 1, 's'), '1 min 30 s', 'a time has its own unit');
});
