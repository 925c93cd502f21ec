// The picture of a cell of arms: wrong documents, where joints carry links and things, whom an arm waits for, the nearest points of two
// arms, from where it is seen, and which of two solids is in front.
//
//   node --test arms_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { load } from './load_modules.mjs';

const page = await load(process.env.CLIENT, [
  'pictures/document', 'pictures/arms', 'pictures/arms_scene', 'pictures/arms_ink', 'pictures/orbit', 'pictures/raster', 'pictures/solids', 'pictures/space',
]);

const near = (a, b, most = 1e-9) => a.length === b.length && a.every((one, k) => Math.abs(one - b[k]) < most);
const assertNear = (a, b, what) => assert.ok(near(a, b), `${what ?? ''} ${JSON.stringify(a)} is ${JSON.stringify(b)}`);

const value = (variable, more = {}) => ({ variable, factor: 1, offset: 0, rest: 0, ...more });
const upright = (name, parent, x, variable) => ({ name, parent, arm: 0, place: [x, 0, 0], motion: 'turns', axis: [0, 0, 1], value: value(variable), solids: [{ kind: 'box', place: [0.5, 0, 0], size_m: [1, 0.1, 0.1] }] });

// Two links of 1 m in a plane, a finger that slides, and the same arm 5 m beside.
const document = (more = {}) => ({
  kind: 'arms',
  id: 'cell',
  program: 'ab',
  bodies: [{ name: 'board', solids: [{ kind: 'box', place: [0, 0, -1], size_m: [2, 2, 0.1] }] }],
  surfaces: [{ name: 'table', place: [0, 0, 0], size_m: [1, 2] }],
  frames: [
    { name: 'base', parent: -1, arm: -1, place: [0, 0, 0], motion: 'fixed', solids: [] },
    upright('upper', 0, 0, 'q1'),
    upright('lower', 1, 1, 'q2'),
    { name: 'tool', parent: 2, arm: 0, place: [1, 0, 0], motion: 'fixed', solids: [] },
    { name: 'finger', parent: 3, arm: 0, place: [0, 0, 0], motion: 'slides', axis: [0, 1, 0], value: value('width', { factor: 0.5 }), solids: [] },
    { ...upright('other', 0, 5, ''), arm: 1 },
  ],
  arms: [
    {
      name: 'left', joints: [{ name: 'j1', frame: 1 }, { name: 'j2', frame: 2 }], tool: 3, opening: value('width'), progress: 'p', waiting: 'waits', standing: 'stands', grasped: 'felt', error: '',
      capsules: [{ frame: 2, from_m: [0, 0, 0], to_m: [1, 0, 0], radius_m: 0.1 }],
      held: [{ frame: 3, from_m: [0, 0, 0], to_m: [0.5, 0, 0], radius_m: 0.2, from: 1, until: 2.5 }],
      steps: [{ kind: 'approach', thing: '', waits: [] }, { kind: 'grip', thing: 'cup', waits: [{ at: 0, other: 1, progress: 2 }] }, { kind: 'transfer', thing: 'cup', waits: [{ at: 0.5, other: 1, progress: 3 }] }],
    },
    { name: 'right', joints: [{ name: 'k1', frame: 5 }], tool: 5, opening: value(''), progress: 'p2', waiting: '', standing: '', grasped: '', error: '', capsules: [{ frame: 5, from_m: [0, 0, 0], to_m: [0, 0, 1], radius_m: 0.2 }], steps: [{ kind: 'lift', thing: '', waits: [] }] },
  ],
  ways: [[[1, 0, 0, 0], [2, 0, 0, 0.5], [3, 0, 0, 1]], []],
  things: [{ name: 'cup', solids: [{ kind: 'cylinder', place: [0, 0, 0.2], radius_m: 0.3, length_m: 0.4 }], stages: [{ arm: -1, from: 0, frame: -1, place: [2, 0, 0] }, { arm: 0, from: 2, frame: 3, place: [0, 0.1, 0] }, { arm: 0, from: 3, frame: -1, place: [0, 2, 0] }] }],
  seen: [{ kind: 'k', x: value('sx', { factor: 1e-4 }), y: value('sy', { factor: 1e-4 }), z: value('sz', { factor: 1e-4 }), yaw: value('') }],
  kinds: [{ kind: 2, name: 'can' }],
  distance: 'd', least_distance_m: 0.05, cause: 'c', causes: ['none', 'missed grasp'], cause_arm: 'ca', left_out: [],
  ...more,
});
const armsOf = (more) => page.readPictures([document(more)])[0];
const knows = (values) => (name) => values[name] ?? null;

test('Document_WhenItIsRubbish_ThenTheRestIsDrawnAndNothingFails', () => {
  for (const wrong of [null, 7, 'x', {}, [], [null, 1, 'x', {}, []], [{ parent: 9, tool: 'x', frame: -3, solids: [{ kind: 'ball' }], stages: 'x' }]]) {
    for (const key of ['bodies', 'surfaces', 'frames', 'arms', 'ways', 'things', 'seen', 'kinds', 'causes', 'left_out', 'distance', 'program']) {
      const picture = armsOf({ [key]: wrong });
      const places = page.framePlaces(picture, knows({}));
      picture.things.forEach((thing) => page.thingPlace(picture, thing, places, [0, 0]));
      page.fitted('corner', new page.ArmsScene(picture).outline(places), 300, 200);
      page.variablesOf(picture);
    }
  }
  assert.equal(armsOf({ arms: [{ name: 'a', tool: 99 }] }).arms.length, 0, 'a tool that is no frame');
  assert.equal(armsOf({ frames: [{ parent: 3 }, { parent: 0.5 }] }).frames.every(({ parent }) => parent === -1), true, 'no frame hangs on a later one');
  assert.equal(armsOf({ bodies: [{ name: 'a', solids: [{ kind: 'box', size_m: [1, -1, 1] }, { kind: 'ball', radius_m: 1 }] }] }).bodies[0].solids.length, 1);
});

test('Frames_WhenJointsTurnAndSlide_ThenToolsAreWhereTrigonometryHasThem', () => {
  const picture = armsOf();
  for (const [q1, q2, width] of [[0, 0, 0], [0.3, -1.2, 0.08], [-2, 2.5, 0.04]]) {
    const places = page.framePlaces(picture, knows({ q1, q2, width }));
    const tool = [Math.cos(q1) + Math.cos(q1 + q2), Math.sin(q1) + Math.sin(q1 + q2), 0];
    assertNear(places[3].at, tool);
    assertNear(places[4].at, [tool[0] - (width / 2) * Math.sin(q1 + q2), tool[1] + (width / 2) * Math.cos(q1 + q2), 0]);
  }
  assertNear(page.framePlaces(armsOf({ frames: [{ ...upright('a', -1, 0, 'q'), value: value('q', { rest: Math.PI / 2 }) }, { name: 'end', parent: 0, place: [1, 0, 0] }] }), knows({}))[1].at, [0, 1, 0], 'what is not known rests');
});

test('Things_WhenAHandHoldsThem_ThenTheyGoWithItUntilItLetsGo', () => {
  const picture = armsOf();
  const places = page.framePlaces(picture, knows({ q1: Math.PI / 2, q2: 0 }));
  const at = (progress) => page.thingPlace(picture, picture.things[0], places, [progress, 0]);
  assert.deepEqual([at(1.99).place.at, at(1.99).holder], [[2, 0, 0], -1]);
  assertNear(at(2).place.at, [-0.1, 2, 0]);
  assert.equal(at(2.7).holder, 0);
  assert.deepEqual([at(3).place.at, at(3).holder], [[0, 2, 0], -1]);
});

test('Doing_WhenAnArmHasToWait_ThenItIsKnownForWhom', () => {
  const picture = armsOf();
  const [left, right] = picture.arms;
  const doing = (p, p2, values) => page.doing(picture, left, [p, p2], knows(values));
  assert.deepEqual(doing(0.5, 0, {}), { number: 1, step: left.steps[0], share: 0.5 / 3, waitsFor: '' });
  assert.equal(doing(1, 1.5, { stands: 1 }).waitsFor, 'right', 'before a step');
  assert.equal(doing(1, 2, { stands: 1 }).waitsFor, '', 'the other one is there');
  assert.equal(doing(2.3, 2.5, { stands: 0 }).waitsFor, '', 'it still comes on');
  assert.equal(doing(2.3, 2.5, { waits: 1 }).waitsFor, 'right', 'on its way it says so');
  assert.equal(doing(3, 0, {}).step, null, 'all done');
  assert.deepEqual(page.doing(picture, { ...right, steps: [] }, [0, 0], knows({})).number, 0, 'nothing is planned');
});

test('Progress_WhenAnotherProgramRuns_ThenTheLastThatWasKnown', () => {
  const progress = new page.Progress();
  const picture = armsOf();
  assert.deepEqual(progress.of(picture, knows({ p: 1.5, p2: 0.25 })), [1.5, 0.25]);
  assert.deepEqual(progress.of(picture, null), [1.5, 0.25]);
  assert.deepEqual(progress.of(picture, knows({ p: 99 })), [3, 0.25], 'no further than all steps');
  assert.deepEqual(progress.of({ ...picture, program: 'cd' }, null), [0, 0], 'of another plan');
});

test('Distance_WhenArmsAreSomewhere_ThenItIsThatOfTheNearestPointsOfTheirBodies', () => {
  const picture = armsOf();
  const places = page.framePlaces(picture, knows({ q1: 0, q2: 0 }));
  const found = page.distanceOf(picture.arms[0], picture.arms[1], places, null);
  assert.ok(Math.abs(found.metres - (5 - 2 - 0.3)) < 1e-9);
  assertNear(found.from, [2.1, 0, 0]);
  assertNear(found.to, [4.8, 0, 0]);
  // With what is held, while it is.
  for (const [come, metres] of [[0.9, 2.7], [1, 2.1], [2.4, 2.1], [2.5, 2.7]]) {
    const here = page.distanceOf(picture.arms[0], picture.arms[1], places, [come, 0]);
    assert.ok(Math.abs(here.metres - metres) < 1e-9, `${come}: ${here.metres}`);
  }
  // Against looking at many points of both lines.
  let seed = 7;
  const random = () => ((seed = (seed * 16_807) % 2_147_483_647) / 2_147_483_647) * 2 - 1;
  const point = () => [random(), random(), random()];
  for (let round = 0; round < 200; round++) {
    const [a, b] = [[point(), point()], round % 10 === 0 ? [point(), null] : [point(), point()]];
    b[1] ??= b[0];
    const [p, q] = page.nearest(a, b);
    let least = Infinity;
    for (let s = 0; s <= 1; s += 0.02) for (let t = 0; t <= 1; t += 0.02) least = Math.min(least, page.gap(page.plus(a[0], page.minus(a[1], a[0]), s), page.plus(b[0], page.minus(b[1], b[0]), t)));
    assert.ok(page.gap(p, q) <= least + 1e-9 && page.gap(p, q) > least - 0.05, `${page.gap(p, q)} ${least}`);
  }
});

test('Way_WhenTheArmIsOnIt_ThenItIsCutThere', () => {
  const [left, right] = armsOf().arms;
  assert.deepEqual(page.splitWay(left, 0.25), { behind: [[1, 0, 0], [1.5, 0, 0]], ahead: [[1.5, 0, 0], [2, 0, 0], [3, 0, 0]] });
  assert.deepEqual(page.splitWay(left, 1).ahead, []);
  assert.deepEqual(page.splitWay(left, 0).ahead[0], [1, 0, 0]);
  assert.deepEqual(page.splitWay(right, 0), { behind: [], ahead: [] });
});

test('Trails_WhenToolsMove_ThenTheyGrowAndBeginAnewWithAnotherProgram', () => {
  const trails = new page.Trails();
  trails.of('a', [[0, 0, 0]]);
  trails.of('a', [[0.001, 0, 0]]);
  assert.equal(trails.of('a', [[0.1, 0, 0]])[0].length, 2, 'what nobody could see is left out');
  assert.equal(trails.of('a', null)[0].length, 2);
  for (let k = 0; k < 5_000; k++) trails.of('a', [[k, 0, 0]]);
  assert.ok(trails.of('a', null)[0].length <= 4_000);
  assert.deepEqual(trails.of('b', null), []);
});

test('Told_WhenTheCameraSeesOrArmsWereStopped_ThenWhatWhereAndWhy', () => {
  const picture = armsOf();
  assert.deepEqual(page.seenThings(picture, knows({ k: 0 })), []);
  assert.deepEqual(page.seenThings(picture, knows({ k: 2, sx: 4500, sy: -1000, sz: 7000 })).map(({ name, at }) => [name, ...at.map((one) => Math.round(1e6 * one))]), [['can', 450000, -100000, 700000]]);
  assert.equal(page.seenThings(picture, knows({ k: 9 }))[0].name, '9', 'a kind that nobody has named');
  assert.equal(page.stopOf(picture, knows({ c: 0 })), null);
  assert.deepEqual(page.stopOf(picture, knows({ c: 1, ca: 2 })), { cause: 'missed grasp', arm: 'right' });
  assert.deepEqual(page.stopOf(picture, knows({ c: 77 })), { cause: '77', arm: '' });
  const names = page.variablesOf(picture);
  for (const name of ['q1', 'q2', 'width', 'p', 'p2', 'waits', 'k', 'sx', 'd', 'c', 'ca']) assert.ok(names.includes(name), name);
  assert.ok(!names.includes(''));
});

test('Solids_WhenTheyHaveFaces_ThenEachLooksOutwardsAndNoEdgeIsOpen', () => {
  const place = { rows: page.about([0.6, 0, 0.8], 1), at: [1, 2, 3] };
  for (const solid of [{ kind: 'box', place, size: [1, 2, 3] }, { kind: 'cylinder', place, radius: 0.5, length: 2 }, { kind: 'ball', place, radius: 0.7 }]) {
    const { points, faces } = page.facesOf(solid);
    const edges = new Map();
    for (const face of faces) {
      const [a, b, c] = face.map((index) => points[index]);
      const [u, v] = [page.minus(b, a), page.minus(c, b)];
      const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
      assert.ok(page.dot(normal, page.minus(a, place.at)) > 0, `${solid.kind} outwards`);
      face.forEach((from, k) => {
        const to = face[(k + 1) % face.length];
        const [key, sign] = from < to ? [`${from} ${to}`, 1] : [`${to} ${from}`, -1];
        edges.set(key, (edges.get(key) ?? 0) + sign);
      });
    }
    assert.ok([...edges.values()].every((sum) => sum === 0), `${solid.kind} is closed`);
  }
});

test('Orbit_WhenSeenFromASide_ThenAxesPointWhereADrawingHasThem', () => {
  const at = (sight, point) => {
    const orbit = { ...page.SIGHTS[sight], scale: 100, centre: [0, 0, 0] };
    return page.project(orbit, page.axesOf(orbit), 400, 300, point).map((one) => Math.round(one * 1e6) / 1e6 + 0);
  };
  assert.deepEqual(at('front', [1, 0, 0]), [200, 150, 1], 'who looks stands in front');
  assert.deepEqual(at('front', [0, 1, 0]), [300, 150, 0]);
  assert.deepEqual(at('front', [0, 0, 1]), [200, 50, 0], 'up is up');
  assert.deepEqual(at('side', [1, 0, 0]), [300, 150, 0]);
  assert.deepEqual(at('top', [1, 0, 0]), [200, 50, 0], 'forward is up');
  assert.deepEqual(at('top', [0, 1, 0]), [100, 150, 0], 'left is left');
  for (const sight of Object.keys(page.SIGHTS)) {
    const { right, up, towards } = page.axesOf(page.SIGHTS[sight]);
    assertNear([page.dot(right, up), page.dot(up, towards), page.dot(right, towards), page.size(right), page.size(up), page.size(towards)], [0, 0, 0, 1, 1, 1], sight);
  }
});

test('Orbit_WhenItIsMovedAndZoomed_ThenWhatIsUnderTheFingerStaysThere', () => {
  const corners = [-1, 3].flatMap((x) => [-2, 2].flatMap((y) => [0, 1.5].map((z) => [x, y, z])));
  for (const sight of Object.keys(page.SIGHTS)) {
    const whole = page.fitted(sight, corners, 600, 400);
    const seen = corners.map((corner) => page.project(whole, page.axesOf(whole), 600, 400, corner));
    assert.ok(seen.every(([px, py]) => px > 0 && px < 600 && py > 0 && py < 400), `${sight}: all is in sight`);
    const [across, above] = [0, 1].map((k) => Math.max(...seen.map((one) => one[k])) - Math.min(...seen.map((one) => one[k])));
    assert.ok(across > 540 || above > 360, `${sight}: as large as there is room`);
    const point = [0.5, -0.7, 0.9];
    const [x, y] = page.project(whole, page.axesOf(whole), 600, 400, point);
    const closer = page.zoomed(whole, whole.scale, 2, x - 300, y - 200);
    assertNear(page.project(closer, page.axesOf(closer), 600, 400, point).slice(0, 2), [x, y], sight);
    const aside = page.panned(whole, 30, -20);
    assertNear(page.project(aside, page.axesOf(aside), 600, 400, point).slice(0, 2), [x + 30, y - 20], sight);
  }
  const whole = page.fitted('corner', corners, 600, 400);
  assert.equal(page.zoomed(whole, whole.scale, 1e6).scale, 12 * whole.scale, 'not nearer than that');
  assert.equal(page.orbited(whole, 0, 9).elevation, Math.PI / 2, 'never over the top');
  assert.ok(Math.abs(page.between({ ...whole, azimuth: 3 }, { ...whole, azimuth: -3 }, 0.5).azimuth - Math.PI) < 1e-9, 'the shorter way round');
});

const square = (raster, z, colour, owner, slope = [0, 0], x = 2) => raster.face(Float64Array.of(x, x, x + 5, x + 5), Float64Array.of(2, 7, 7, 2), Float64Array.of(z, z, z + 5 * slope[0], z + 5 * slope[0]), 4, slope, colour, owner);

test('Raster_WhenFacesCoverEachOther_ThenTheNearerOneIsSeenInAnyOrder', () => {
  for (const order of [[1, 2], [2, 1]]) {
    const raster = new page.Raster(10, 10);
    raster.clear(9);
    for (const z of order) square(raster, z, z, z);
    assert.equal(raster.colours[4 * 10 + 4], 2);
    assert.equal(raster.colours[0], 9);
    assert.equal(raster.colours.filter((colour) => colour === 2).length, 25, 'five by five pixels');
    assert.ok(raster.hides(4, 4, 1, 0.1) && !raster.hides(4, 4, 2, 0.1) && !raster.hides(-5, 4, 0, 0.1));
  }
});

test('Raster_WhenFacesReachIntoEachOther_ThenEachIsSeenWhereItIsNearer', () => {
  const raster = new page.Raster(10, 10);
  raster.clear(9);
  square(raster, 1, 1, 1);
  square(raster, 0, 2, 2, [0.4, 0]);
  assert.deepEqual([...raster.colours.slice(42, 47)], [1, 1, 1, 2, 2]);
  raster.outline(7);
  assert.equal(raster.colours[44], 7, 'a line where they meet');
  square(raster, 9, 3, 3, [0, 0], -3);
  square(raster, 9, 3, 3, [0, 0], 8);
  assert.equal(raster.colours[49], 3, 'beyond the edge is cut off');
});

test('Scene_WhenACellIsDrawn_ThenArmsThingsAndBodiesAreInTheirColours', () => {
  const picture = armsOf();
  const palette = { background: [0, 0, 0], fixed: [0, 0, 200], arms: [[200, 0, 0], [200, 0, 100]], thing: [0, 200, 0], held: [200, 200, 0], edge: [1, 1, 1] };
  const scene = new page.ArmsScene(picture);
  assert.ok(scene.faceCount > 20);
  const around = [[-3, -3, -1], [5, 3, 1]];
  const seen = (values, sight) => {
    const raster = new page.Raster(400, 300);
    const places = page.framePlaces(picture, knows(values));
    const things = picture.things.map((thing) => page.thingPlace(picture, thing, places, [values.p ?? 0, 0]));
    scene.draw(raster, page.fitted(sight, around, 400, 300), 1, places, things, palette);
    const has = (test) => raster.colours.filter((pixel) => test(pixel & 255, (pixel >> 8) & 255, (pixel >> 16) & 255)).length;
    return { arm: has((r, g, b) => r > 90 && g === 0 && b === 0), thing: has((r, g) => r === 0 && g > 90), held: has((r, g) => r > 90 && g > 90), fixed: has((r, g, b) => r === 0 && g === 0 && b > 90) };
  };
  const before = seen({ q1: 0.4, q2: 0.3 }, 'top');
  assert.ok(before.arm > 100 && before.thing > 5 && before.held === 0 && before.fixed > 1_000, JSON.stringify(before));
  const carried = seen({ q1: 0.4, q2: 0.3, p: 2.5 }, 'top');
  assert.ok(carried.held > 5 && carried.thing === 0, JSON.stringify(carried));
  const below = seen({ q1: 0.4, q2: 0.3 }, 'front');
  assert.ok(below.arm > 20);
});

test('Colours_WhenThePageHasThem_ThenTheyAreRead', () => {
  assert.deepEqual(page.colourOf('#1c63b7'), [28, 99, 183]);
  assert.deepEqual(page.colourOf('red'), [128, 128, 128]);
  assert.deepEqual(page.mixed([0, 0, 0], [100, 200, 50], 0.5), [50, 100, 25]);
  assert.equal(page.pixelOf(1, 2, 3), 0xff030201);
});
