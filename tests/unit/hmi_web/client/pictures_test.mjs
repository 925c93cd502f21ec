// Pictures of a plan: wrong documents, how far the way is covered, where the links are, what a task's automaton looks like.
//
//   node --test pictures_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { load } from './load_modules.mjs';

const page = await load(process.env.CLIENT, ['pictures/document', 'pictures/floor', 'pictures/automaton']);

const SQUARE = [[0, 0], [4, 0], [4, 4], [0, 4]];
const floorOf = (more) => page.readPictures([{ kind: 'floor', id: 'hall', program: 'ab', border_m: SQUARE, ...more }])[0];
const taskOf = (more) => page.readPictures([{ kind: 'automaton', id: 'task', ...more }])[0];

test('Document_WhenItIsRubbish_ThenThereIsNothingAndNoError', () => {
  for (const value of [null, 7, 'x', {}, [null, 1, [], {}], [{ kind: 'mandala', id: 'a' }]]) assert.deepEqual(page.readPictures(value), []);
  const rubbish = [null, 7, 'x', {}, [], [null, 1, 'x', {}, []]];
  for (const wrong of rubbish) {
    const floor = floorOf({ border_m: wrong, walls: wrong, places: wrong, regions: wrong, earlier_m: wrong, swept: wrong, way: wrong, stops: wrong, body: wrong, left_out: wrong, length_m: wrong });
    assert.deepEqual([floor.border, floor.walls, floor.way, floor.regions], [[], [], [], []]);
    page.stopRows(floor, 0);
    page.linkPoses(floor.body, () => null);
    const task = taskOf({ states: wrong, edges: wrong, planned: wrong, initial: wrong });
    page.drawingOf(task, 300);
  }
});

test('Document_WhenPartsOfItAreWrong_ThenTheRestIsDrawn', () => {
  const floor = floorOf({
    places: [{ name: 'press', corners_m: SQUARE, at: 'at_press' }, { name: 'far', corners_m: [[0, 0], [1e9, 0], [1, 1]] }],
    regions: { corners_m: [[0, 0], [1, 0], [1, 1], ['x', 2]], triangles: [[0, 1, 2], [0, 1, 3], [0, 1, 9], [0, 1]] },
    way: [[0, 0, 0, 1], [1, 0, 1, -1], [1, 0], 'x'],
    stops: [{ places: ['press'], arc_m: 1 }, { places: [], arc_m: 2 }, { places: ['a'] }],
  });
  assert.deepEqual(floor.places.map(({ name }) => name), ['press']);
  assert.equal(floor.regions.length, 1);
  assert.deepEqual(floor.way.map(({ reverse }) => reverse), [false, true]);
  assert.equal(floor.stops.length, 1);
  const task = taskOf({ states: [{ state: 0 }, { state: 1, verdict: 'wild' }], edges: [{ from: 0, to: 1 }, { from: 0, to: 9 }, { from: 1, to: 1 }], planned: [0, 9, 1] });
  assert.deepEqual(task.states.map(({ verdict }) => verdict), ['undecided', 'undecided']);
  assert.deepEqual([task.edges.length, task.planned], [1, [0, 1]]);
});

test('Document_WhenTwoPicturesHaveOneName_ThenTheLastIsShown', () => {
  const pictures = page.readPictures([{ kind: 'floor', id: 'a', length_m: 1 }, { kind: 'automaton', id: 'a' }, { kind: 'floor', id: 'a', length_m: 2 }]);
  assert.deepEqual(pictures.map(({ kind, lengthM }) => [kind, lengthM]), [['floor', 2], ['automaton', undefined]]);
});

test('Covered_WhenAnotherProgramRuns_ThenTheLastThatWasKnown', () => {
  const covered = new page.Covered();
  const first = floorOf({ length_m: 10, covered_m: 2 });
  assert.equal(covered.of(first, null), 2, 'as the picture says');
  assert.equal(covered.of(first, 5), 5);
  assert.equal(covered.of(first, 4.9), 5, 'it does not tremble back');
  assert.equal(covered.of(first, null), 5);
  assert.equal(covered.of(first, 0.1), 0.1, 'the first scan had shown the arc of the program before');
  assert.equal(covered.of(first, 99), 10, 'no further than the way is long');
  assert.equal(covered.of({ ...first, program: 'cd', coveredM: 0 }, null), 0, 'of another plan');
});

test('Swept_WhenTheBodyDrivesOn_ThenPieceByPieceIsBehindIt', () => {
  const { swept } = floorOf({ swept: [0, 1, 2].map((k) => ({ from_m: k, to_m: k + 1, outlines_m: [SQUARE] })) });
  assert.deepEqual([0, 0.4, 0.6, 1.6, 3].map((arc) => page.piecesDriven(swept, arc)), [0, 0, 1, 2, 3]);
});

test('Way_WhenItIsCutWhereTheBodyIs_ThenBothPartsMeetThere', () => {
  const { way } = floorOf({ way: [[0, 0, 0, 1], [4, 0, 4, 1], [4, 0, 4, -1], [2, 0, 6, -1]] });
  const parts = page.wayParts(way, 1);
  assert.deepEqual(parts.map(({ driven, reverse }) => [driven, reverse]), [[true, false], [false, false], [false, true]]);
  assert.deepEqual(parts[0].points.at(-1), [1, 0]);
  assert.deepEqual(parts[1].points[0], [1, 0]);
  assert.deepEqual(page.pointAt(way, 5), [3, 0]);
  assert.deepEqual(page.pointAt(way, 99), [2, 0]);
  assert.equal(page.pointAt([], 1), null);
});

test('Stops_WhenTheWayGoesOn_ThenTheyAreVisitedInTheirOrder', () => {
  const floor = floorOf({
    length_m: 9,
    places: [{ name: 'a', visited: true }, { name: 'b' }, { name: 'c' }, { name: 'd' }, { name: 'e' }].map((place) => ({ ...place, corners_m: SQUARE })),
    stops: [{ places: ['b'], arc_m: 2 }, { places: ['e'], arc_m: 4, counts: false }, { places: ['c'], arc_m: 6 }],
  });
  const told = (arc) => page.stopRows(floor, arc).map(({ number, places, state }) => `${number ?? '-'} ${places.join('+')} ${state}`);
  assert.deepEqual(told(0), ['- a done', '1 b next', '- e through', '2 c ahead', '- d off']);
  assert.deepEqual(told(3), ['- a done', '1 b done', '- e through', '2 c next', '- d off']);
  assert.deepEqual(page.stopRows({ ...floor, program: '', stops: [] }, 0).map(({ state }) => state), ['done', 'open', 'open', 'open', 'open']);
  const rows = page.stopRows(floor, 9);
  assert.deepEqual(['a', 'b', 'c', 'd', 'e'].map((name) => page.stateOfPlace(rows, name)), ['done', 'done', 'done', 'off', 'through']);
});

test('Links_WhenHitchesBend_ThenEachStandsBehindTheOneInFront', () => {
  const link = (more) => ({ length_m: 0.9, width_m: 0.5, behind_m: 1, hitch_rad: Math.PI / 18_000, ...more });
  const { body } = floorOf({ body: { x: 'v.X', y: 'v.Y', heading: 'v.H', coupled: 'n', links: [link({ behind_m: 0 }), link({ hitch: 'h1' }), link({ hitch: 'h2' })] } });
  const at = (values) => page.linkPoses(body, (name) => values[name] ?? null).map(({ x, y, headingRad }) => [x, y, headingRad].map((each) => Math.round(each * 1e6) / 1e6));
  assert.deepEqual(at({ 'v.X': 5, 'v.Y': 1, 'v.H': 0, n: 2, h1: 0, h2: -9_000 }), [[5, 1, 0], [4, 1, 0], [4, 0, 1.570796]]);
  assert.equal(at({ 'v.X': 5, 'v.Y': 1, n: 1 }).length, 2, 'one trailer was left');
  assert.equal(at({ 'v.X': 5, 'v.Y': 1, n: 40 }).length, 3);
  assert.deepEqual(at({}), []);
});

const task = taskOf({
  variable: 's',
  planned: [0, 1, 3],
  states: [
    { state: 0, column: 0, row: 0, verdict: 'undecided', left: 2 }, { state: 1, column: 1, row: 0, verdict: 'undecided', left: 1 },
    { state: 2, column: 1, row: 1, verdict: 'undecided', left: 1 }, { state: 3, column: 2, row: 0, verdict: 'done', left: 0 },
    { state: 4, column: 2, row: 1, verdict: 'failed', left: null },
  ],
  edges: [
    { from: 0, to: 2, letters: [['b']] }, { from: 0, to: 1, letters: [['a'], ['a', 'c']] }, { from: 1, to: 3, letters: [['b']] },
    { from: 2, to: 3, letters: [['a']] }, { from: 0, to: 4, letters: [[]] }, { from: 0, to: 3, letters: [['a', 'b']] }, { from: 3, to: 0, letters: [] },
  ],
});

test('Automaton_WhenThePanelIsWideOrNarrow_ThenNothingLeavesIt', () => {
  for (const room of [230, 300, 500, 900]) {
    const drawing = page.drawingOf(task, room);
    assert.equal(drawing.downwards, room < 300);
    assert.ok(drawing.letters >= 6);
    assert.ok(drawing.width <= room, `${drawing.width} in ${room}`);
    for (const { x, y } of drawing.states) assert.ok(x >= page.RADIUS_PX && x <= drawing.width - page.RADIUS_PX && y >= page.RADIUS_PX && y <= drawing.height - page.RADIUS_PX);
    assert.equal(new Set(drawing.states.map(({ x, y }) => `${x} ${y}`)).size, task.states.length);
    for (const { path, head } of drawing.edges) assert.doesNotMatch(path + head, /NaN|Infinity/);
  }
});

test('Automaton_WhenAStateHolds_ThenItIsKnownWhatIsBehindAndWhatLeadsOn', () => {
  assert.deepEqual([...page.passedStates(task, 1)], [0]);
  assert.deepEqual([...page.passedStates(task, 2)], [], 'not on the plan');
  assert.deepEqual(page.nextRows(task, 0).map(({ to, verdict, planned }) => [to, verdict, planned]), [
    [1, 'undecided', true], [2, 'undecided', false], [4, 'failed', false], [3, 'done', false]]);
  assert.deepEqual(page.nextRows(task, null), []);
  assert.deepEqual(task.edges.map((edge) => page.isPlanned(task, edge)), [false, true, true, false, false, false, false]);
});

test('Letters_WhenPlacesOverlapOrThereAreSeveral_ThenTheyAreToldApart', () => {
  assert.equal(page.lettersText([['a'], ['a', 'c'], []], 'no place'), 'a / a + c / no place');
  assert.equal(page.shortened('x'.repeat(40), 22).length, 22);
  assert.equal(page.shortened('press', 5), 'press');
});
