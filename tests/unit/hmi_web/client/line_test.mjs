// The sorting line from above: every belt, eye, pusher and box is drawn where the plant says, whatever it says.
//
//   node --test line_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { load } from './load_modules.mjs';

const { draw, LinePicture } = await load(process.env.CLIENT, ['synoptic/LinePicture.svelte']);

// Two belts that meet, an eye across each, a pusher at the second that pushes downwards, and two boxes. The picture is
// 4.5 m wide, margins of 0.25 m and all, and 1.5 m high.
const LINE = {
  belts: [
    { id: 'in', label: 'in', running: 'in.on', low: [0, 0], high: [2, 1], direction: [1, 0] },
    { id: 'out', label: 'out', running: '', low: [2, 0], high: [4, 1], direction: [1, 0] },
  ],
  beams: [
    { id: 'eye_in', dark: 'eye_in', from: [1, 0], to: [1, 1] },
    { id: 'eye_out', dark: 'eye_out', from: [3, 0.5], to: [3, 0.5] },
  ],
  pushers: [
    { id: '1', label: '1', out: '1.out', travel: '1.travel', home: [1, 1], size: [0.2, 0.1], direction: [0, -1], stroke: 0.5 },
    { id: '2', label: '2', out: '2.out', travel: '2.travel', home: [3, 1], size: [0.2, 0.1], direction: [0, -1], stroke: 0.5 },
  ],
  boxes: [1, 2].map((n) => ({ id: `box ${n}`, label: `b${n}`, size: [0.4, 0.3], state: `b${n}.state`, x: `b${n}.x`, y: `b${n}.y`, angle: `b${n}.angle` })),
};
const WIDTH = 450; // px: 100 a metre

const cell = (points, forced = []) => ({
  point: (id) => points[id] ?? null,
  isOn: (id) => (points[id] ?? 0) > 0.5,
  forcedPoints: new Set(forced),
});
// The attributes of the elements that carry `data-NAME`, in their order.
function drawn(points, name, forced) {
  const { body } = draw(LinePicture, { props: { cell: cell(points, forced), description: LINE, width: WIDTH } });
  return [...body.matchAll(new RegExp(`<\\w+ ([^>]*data-${name}="[^>]*)>`, 'g'))].map(([, attributes]) =>
    Object.fromEntries([...attributes.matchAll(/([\w-]+)="([^"]*)"/g)].map(([, key, value]) => [key, value])),
  );
}
const places = (points, name) => drawn(points, name).map(({ style }) => style.match(/translate\(([-\d.]+)px, ([-\d.]+)px\)/).slice(1).map(Number));
const isLit = (word) => (one) => one.class.split(' ').includes(word);

test('Pusher_WhenThePlantSaysHowFarItIs_ThenItIsDrawnThere', () => {
  for (const travel of [0, 0.1, 0.25, 0.5])
    assert.deepEqual(places({ '1.travel': 0, '2.travel': travel }, 'pusher'), [[125, 25], [325, 25 + 100 * travel]], `${travel} m`);
  assert.deepEqual(drawn({ '2.out': 1 }, 'pusher').map(isLit('on')), [false, true]);
});

test('Pusher_WhenThePlantDoesNotSay_ThenItIsDrawnWhereItIsToldToBe', () => {
  assert.deepEqual(places({ '2.out': 1 }, 'pusher'), [[125, 25], [325, 75]]);
});

test('Belt_WhenItsMotorIsOn_ThenItIsLit', () => {
  assert.deepEqual(drawn({ 'in.on': 0 }, 'belt').map(isLit('on')), [false, true], 'one without a motor always runs');
  assert.deepEqual(drawn({ 'in.on': 1 }, 'belt').map(isLit('on')), [true, true]);
});

test('Eye_WhenABoxIsInItsBeam_ThenItIsDark', () => {
  assert.deepEqual(drawn({ eye_in: 1, eye_out: 0 }, 'beam').map(isLit('dark')), [true, false]);
  assert.deepEqual(drawn({ eye_in: 0, eye_out: 1 }, 'beam').map(isLit('dark')), [false, true]);
});

test('Box_WhenItIsOnTheLine_ThenItIsDrawnWhereItIs', () => {
  assert.deepEqual(places({ 'b1.state': 0, 'b1.x': 1, 'b1.y': 0.5 }, 'box'), [], 'not before, not after');
  assert.deepEqual(places({ 'b1.state': 1, 'b1.x': 1, 'b1.y': 0.5, 'b2.state': 1, 'b2.x': 3.25, 'b2.y': 0 }, 'box'), [[125, 75], [350, 125]]);
});

test('Forced_WhenAPointIs_ThenItsPartSaysSo', () => {
  const labels = (...forced) => drawn({}, 'forced', forced).map((one) => one['aria-label']);
  assert.deepEqual(labels(), []);
  assert.deepEqual(labels('in.on', 'eye_out', '2.travel'), ['belt in, forced', 'photo-eye eye_out, forced', 'pusher 2, forced']);
});
