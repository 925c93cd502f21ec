// The logic of the fleet's page: wrong documents, joining vehicles, progress, poses, the view, missions over time.
//
//   node --test fleet_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { load } from './load_modules.mjs';

const fleet = await load(process.env.CLIENT, [
  'fleet/document', 'fleet/gantt', 'fleet/geometry', 'fleet/poses', 'fleet/progress', 'fleet/vehicles', 'fleet/view',
  'fleet/words', 'sfc/parts',
]);

const SQUARE = [[0, 0], [4, 0], [4, 4], [0, 4]];
const forklift = (id) => ({ id, label: id, front: 1.6, rear: 2.4, width: 1.4, wheelbase: 1.9, x: 'x', y: 'y', heading: 'h', true_x: 'tx', true_y: 'ty', true_heading: 'th' });
const news = (...vehicles) => fleet.readFleet({ epoch_s: 10, vehicles });
const routes = (value = {}) => fleet.readRoutes(value);

test('Document_WhenItIsRubbish_ThenThereIsNothingAndNoError', () => {
  const rubbish = [null, 7, 'x', [], [[]], {}, { vehicles: 3, goals: {}, waits: 'x', blocked: 1 }, { vehicles: [null, 1, [], {}], goals: [0, {}], waits: [{}] }];
  for (const value of rubbish) {
    fleet.readFleet(value);
    const read = fleet.readRoutes(value);
    assert.deepEqual(read.sections, []);
  }
  assert.equal(fleet.readFleet(null), null);
  assert.equal(fleet.readFleet([]), null);
  const read = fleet.readRoutes({ paths: [null, 3], polygons: [null, { polygons: [null, 5, {}] }], sections: [null, {}, { order: [1, 2] }] });
  assert.equal(read.paths.length, 2);
  assert.equal(read.polygons[1].polygons.length, 3);
});

test('Document_WhenCoordinatesAreAbsurd_ThenTheseAreLeftOutAndNothingElse', () => {
  const read = fleet.readRoutes({
    paths: [{ vehicle: 'v1', length_m: 5, poses_m_m_deg: [[0, 0, 0], [1e300, 0, 0], [1, 'a', 0], [2, 0], [NaN, 1, 0], [5, 0, 90]] }],
    polygons: [{ vehicle: 'v1', polygons: [{ corners_m: SQUARE }, { corners_m: [[0, 0], [1e9, 0], [1, 1]] }, { corners_m: [[0, 0], [1, 1]] }] }],
  });
  assert.deepEqual(read.paths[0].poses, [[0, 0, 0], [2, 0, 0], [5, 0, 90]]);
  assert.deepEqual(read.polygons[0].polygons.map(({ corners }) => corners.length), [4, 0, 0]);
});

test('Document_WhenASectionHasOneAreaOrSeveral_ThenBothAreRead', () => {
  const section = (corners_m) => fleet.readRoutes({ sections: [{ order: ['a', 'b'], corners_m, polygons: [{ vehicle: 'a', polygon: 2 }] }] }).sections[0];
  assert.equal(section(SQUARE).areas.length, 1);
  assert.equal(section([SQUARE, SQUARE, 'x']).areas.length, 2);
  assert.deepEqual(section(undefined).areas, []);
});

test('Vehicles_WhenThePlanNamesThemLikeThePlant_ThenTheyAreJoinedByName', () => {
  const joined = fleet.joined([forklift('v1'), forklift('v2'), forklift('v3')], news({ vehicle: 'V2' }, { vehicle: 'x', variable: 'v1' }), routes());
  assert.deepEqual(joined.map((one) => [one.name, one.forklift?.id]), [['V2', 'v2'], ['x', 'v1'], ['v3', 'v3']]);
});

test('Vehicles_WhenThePlanHasNamesOfItsOwn_ThenTheirOrderCounts', () => {
  const joined = fleet.joined([forklift('v1'), forklift('v2')], news({ vehicle: 'truck 1' }, { vehicle: 'truck 2' }, { vehicle: 'truck 3' }), routes());
  assert.deepEqual(joined.map((one) => [one.name, one.variable, one.forklift?.id]), [
    ['truck 1', 'truck_1', 'v1'], ['truck 2', 'truck_2', 'v2'], ['truck 3', 'truck_3', undefined]]);
});

test('Vehicles_WhenThereIsNoPlan_ThenThePlantsAreShown', () => {
  assert.deepEqual(fleet.joined([forklift('v1')], null, routes()).map(({ name }) => name), ['v1']);
});

test('Body_WhenTheOutlineIsAbsurd_ThenItIsThatOfAForklift', () => {
  const [lone] = fleet.joined([], news({ vehicle: 'a', outline_m: [[2, 1], [-3, 1], [-3, -1], [2, -1]] }), routes());
  assert.deepEqual([fleet.bodyOf(lone).front, fleet.bodyOf(lone).rear, fleet.bodyOf(lone).half], [2, 3, 1]);
  const [wrong] = fleet.joined([{ ...forklift('v1'), front: -1, width: 1e9 }], null, routes());
  assert.deepEqual([fleet.bodyOf(wrong).front, fleet.bodyOf(wrong).half], [1.6, 0.7]);
});

function program() {
  const chart = (name, ...steps) => ({ name, steps: steps.map((step) => ({ name: step, comment: '', initial: false })) });
  const charts = [chart('MISSION_A', 'START', 'P000', 'S01_PICK_UP', 'P001', 'DONE'), chart('x.mission_b', 'START', 'P000', 'P001')];
  return {
    steps: charts.flatMap(({ steps }) => steps),
    transitions: [{ name: 'T', from: [0], to: [1], condition: '' }, { name: 'U', from: [5], to: [6], condition: '' }],
    charts: charts.map(({ name, steps }) => ({ name, steps: steps.length, transitions: 1 })),
    tags: [],
  };
}

test('Progress_WhenStepsAreActive_ThenEachVehicleHasThoseOfItsChart', () => {
  const polygons = [{ vehicle: 'a', polygons: [{}, {}, {}] }];
  const paths = [{ vehicle: 'a', stops: [{ arc_m: 1, polygon: 1, kind: 'pick_up' }] }];
  const [a, b] = fleet.joined([], news({ vehicle: 'a' }, { vehicle: 'b' }), routes({ polygons, paths }));
  const tags = { areas_a: 1, arc_a: 2.5, permitted_a: 4, areas_b: 0 };
  const of = (vehicle, steps) => fleet.progressOf(vehicle, program(), fleet.chartRanges(program()), steps, (name) => tags[name] ?? null);
  assert.deepEqual(of(a, [3, 6]), { left: 1, heldTo: 1, arcM: 2.5, permittedM: 4, step: 'P001' });
  assert.equal(of(a, [2, 6]).heldTo, 1); // where the stop is
  assert.equal(of(a, [4]).heldTo, 2);
  assert.deepEqual([of(b, [3, 7]).heldTo, of(b, [3, 7]).step], [1, 'P001']);
  assert.equal(fleet.progressOf(a, null, [], [], () => null).heldTo, -1);
});

test('Parts_WhenAProgramHasCharts_ThenOneIsCutOutWithItsTransitions', () => {
  const parts = fleet.partsOf(program());
  assert.equal(parts.length, 3); // both together first
  const b = fleet.partOf(program(), fleet.partNamed(parts, 'mission_b'));
  assert.deepEqual([b.steps.length, b.transitions.map(({ from, to }) => [from, to])], [3, [[[0], [1]]]]);
  assert.deepEqual(fleet.within([1, 5, 7], 5, 3), [0, 2]);
});

test('Pose_WhenItTurnsOverHalfACircle_ThenTheHeadingGoesOn', () => {
  const poses = new fleet.Poses();
  const at = (x, y, h) => poses.of(forklift('v1'), (id) => ({ x, y, h })[id] ?? null);
  at(5, 5, 3.1);
  assert.ok(Math.abs(at(5, 5, -3.1).heading - (2 * Math.PI - 3.1)) < 1e-9);
});

test('Pose_WhenAVehicleAnswersZeros_ThenItIsWhereItWasLast', () => {
  const poses = new fleet.Poses();
  const at = (x, y, h) => poses.of(forklift('v1'), (id) => ({ x, y, h })[id] ?? null);
  at(5, 6, 1);
  assert.deepEqual(at(0, 0, 0), { x: 5, y: 6, heading: 1, silent: true });
  assert.equal(at(null, null, null).x, 5);
  assert.equal(at(1e200, 0, 0).x, 5);
});

test('Pose_WhenNothingIsMeasured_ThenThePlantKnows', () => {
  const pose = new fleet.Poses().of(forklift('v1'), (id) => ({ tx: 3, ty: 4, th: 0.5 })[id] ?? null);
  assert.deepEqual(pose, { x: 3, y: 4, heading: 0.5, silent: false });
});

test('View_WhenItIsZoomed_ThenWhatIsUnderThePointerStays', () => {
  const bounds = { low: [0, 0], high: [80, 60] };
  const whole = fleet.fit(bounds, 800, 600);
  const near = fleet.zoomAt(whole, whole, 2, 100, 200);
  const floorX = (view) => (100 - view.x) / view.scale;
  assert.ok(Math.abs(floorX(near) - floorX(whole)) < 1e-9);
  assert.ok(near.scale > 1.9 * whole.scale);
  const gone = fleet.keepInSight(fleet.pan(near, 1e6, -1e6), bounds, 800, 600);
  assert.ok(gone.x < 800 && gone.y > 0);
});

test('Geometry_WhenWallsAreWrong_ThenOnlyTheseAreMissing', () => {
  assert.equal(fleet.wallData([[1, 2, 3, 4, -3], 'x', [1], [1, 2, null, 4, 5], []]), 'M1 2h3v4h-3z');
  assert.equal(fleet.wallData(undefined), '');
});

test('Geometry_WhenAWayIsThinnedOut_ThenAPlaceIsFoundByItsArc', () => {
  const { paths } = routes({ paths: [{ vehicle: 'a', length_m: 10, poses_m_m_deg: [[0, 0, 0], [6, 0, 0], [2, 0, 180]] }] });
  const at = (arc) => fleet.placeAt(paths[0], arc);
  assert.deepEqual([at(3).x, at(6).x, at(8).x, at(99).x], [3, 6, 4, 2]);
  assert.equal(fleet.placeAt(routes({ paths: [{}] }).paths[0], 1), null);
});

test('Gantt_WhenMissionsHaveTimes_ThenTheyAreOnTheClockOfTheCell', () => {
  const read = routes({
    paths: [{ vehicle: 'a', stops: [{ arc_m: 1, service_ms: 2_000, end_ms: 9_000, location: 'dock' }] }],
    polygons: [{ vehicle: 'a', polygons: [{ earliest_ms: [0, 5_000] }, { earliest_ms: [4_000, 20_000] }, {}] }],
  });
  const said = fleet.readFleet({ epoch_s: 100, vehicles: [{ vehicle: 'a', arrives_ms: 30_000 }, { vehicle: 'b' }], waits: [{ vehicle: 'a', for: 'b', from_ms: 1_000, until_ms: 2_000 }] });
  const rows = fleet.rowsOf(fleet.joined([], said, read), said);
  assert.deepEqual(rows[0].mission, { from: 100, to: 120 });
  assert.deepEqual(rows[0].services, [{ from: 107, to: 109, place: 'dock' }]);
  assert.deepEqual(rows[0].waits, [{ from: 101, to: 102, other: 'b' }]);
  assert.equal(rows[1].mission, null);
  assert.deepEqual([fleet.timeOf(rows, 90).from, fleet.timeOf(rows, 1e6).to], [100, 133]);
  assert.equal(fleet.timeOf(fleet.rowsOf([], null), 5), null);
});

test('Words_WhenAStateIsUnknown_ThenItIsShownAsItCame', () => {
  assert.equal(fleet.stateText('dancing'), 'dancing');
  assert.equal(fleet.errorText(77), 'error 77');
  assert.equal(fleet.delayText(400), 'on time');
  assert.equal(fleet.delayText(125_000), '2:05 min late');
  assert.equal(fleet.delayText(null), '–');
});
