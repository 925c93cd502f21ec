// What the page knows of its cell: values of the variables that it asked for, and what it says to a server that it has lost.
//
//   node --test cell_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { load } from './load_modules.mjs';

let reloads = 0;
class Socket {
  static OPEN = 1;
  static last = null;
  constructor() {
    Socket.last = this;
  }
  readyState = 1;
  close() {}
  send() {}
}
globalThis.WebSocket = Socket;
globalThis.document = { addEventListener() {}, visibilityState: 'visible' };
globalThis.window = {
  setTimeout, clearTimeout, addEventListener() {}, location: { reload: () => (reloads += 1), protocol: 'http:', host: 'localhost' },
};
const { Cell } = await load(process.env.CLIENT, ['lib/cell.svelte']);

const synoptic = { points: [{ id: 'a', label: 'a', unit: '', trend: true }], floor: { forklifts: [], estop_ok: '' } };
const hello = (epoch, protocol = 5) => ({ type: 'hello', protocol, epoch, cell: 'bench', version: '1', recipes: false, drawing: false, synoptic });
const tags = ['Main.Level', 'x', 'y', 'z'].map((name) => ({ name, type: 'INT', address: '' }));
const program = (digest = 'ab', revision = 1) => ({ type: 'program', revision, digest, charts: [], steps: [], transitions: [], tags, points: [] });
const state = (more) => ({ type: 'state', seq: 5, runtime_alive: true, program: 'ab', scan: 7, points: [1], unread: [], tags: {}, ...more });

function cellAt(...messages) {
  const cell = new Cell();
  for (const message of messages) cell.take(message);
  return cell;
}
const said = (cell) => JSON.parse(cell.greeting());

test('Cell_WhenItKnowsNothing_ThenItBeginsWithNothing', () => {
  const message = said(new Cell());
  assert.deepEqual(message, { type: 'begin', protocol: 5, epoch: '', show: { number: 1, digest: '', tags: [], also: ['plan', 'routes', 'pictures'] } });
});

test('Cell_WhenVariablesAreTold_ThenTheOthersAreNotKnown', () => {
  const cell = cellAt(hello('e1'), program(), state({ show: 1, tags: { 0: 10, 2: 30 } }));
  assert.deepEqual([0, 1, 2].map((index) => cell.tags[index] ?? null), [10, null, 30]);
  assert.equal(cell.tag('main.level'), 10);
  assert.equal(cell.tagNumber('y'), 2);
  cell.take({ type: 'delta', seq: 6, tags: { 2: 31 } });
  assert.deepEqual([0, 2].map((index) => cell.tags[index]), [10, 31]);
  cell.take({ type: 'delta', seq: 7, show: 2, tags: { 1: 20 } });
  assert.deepEqual([0, 1, 2].map((index) => cell.tags[index] ?? null), [null, 20, null], 'of what was wanted before nothing more is told');
});

test('Cell_WhenADeviceDoesNotAnswer_ThenItsTagsHaveNoValueUntilItDoesOrTheyAreForced', () => {
  const unread = [{ device: 'tank', why: 'lost', tags: [[0, 1], [2, 2]] }, { device: 'drive', why: 'never', tags: [] }];
  const cell = cellAt(hello('e1'), program(), state({ unread, tags: { 0: 10, 1: 20, 2: 30 } }));
  assert.deepEqual([0, 1, 2, 3].map((index) => cell.value(index)), [null, 20, null, null]);
  assert.equal(cell.tag('main.level'), null);
  assert.equal(cell.tagValue('x'), 20);
  assert.equal(cell.tags[0], 10, 'what the program works with');
  assert.deepEqual(cell.unread.of(2), { device: 'tank', why: 'lost' });
  assert.equal(cell.unread.of(1), null);
  cell.take({ type: 'forces', revision: 1, forces: [{ name: 'MAIN.LEVEL', value: '10', user: 'a', reason: '', since_s: 0, until_s: 0, also: [] }] });
  assert.equal(cell.value(0), 10, 'what is forced has a value');
  cell.take({ type: 'delta', seq: 6, unread: [] });
  assert.equal(cell.value(2), 30);
});

test('Cell_WhenItsServerIsLost_ThenItSaysWhatItHas', () => {
  const cell = cellAt(hello('e1'), program());
  cell.showTags({}, [0, 1]);
  assert.equal(said(cell).show.number, 1);
  cell.take(state({ show: 1, tags: { 0: 1, 1: 2 } }));
  cell.take({ type: 'plan', revision: 4, document: {} });
  cell.take({ type: 'alarms', revision: 9, alarms: [], figures: {}, journal: {} });
  cell.take({ type: 'trend', run: 2, first: 40, restart: true, rows: [[1, 10], [2, 20]] });
  cell.take({ type: 'delta', seq: 6, scan: 8 });
  const { epoch, has, show } = said(cell);
  assert.equal(epoch, 'e1');
  assert.deepEqual(has, { seq: 6, program: 1, plan: 4, routes: 0, pictures: 0, alarms: 9, forces: 0, tags: true, trend_run: 2, trend_next: 42 });
  assert.deepEqual(show.tags, [[0, 2]]);
  cell.showTags({}, [3]);
  assert.equal(said(cell).has.tags, false, 'of what it wants now it has not all');
});

test('Cell_WhenTheSameServerAnswers_ThenEverythingStays', () => {
  const cell = cellAt(hello('e1'), program(), state({ tags: { 0: 1 } }), { type: 'trend', run: 0, first: 0, restart: true, rows: [[1, 10]] });
  cell.take(hello('e1'));
  assert.equal(cell.program.digest, 'ab');
  assert.equal(cell.tag('main.level'), 1);
  assert.deepEqual(cell.trend.times, [1]);
});

test('Cell_WhenTheServerIsAnother_ThenNothingOfTheOldOneStays', () => {
  const cell = cellAt(hello('e1'), program(), state({ show: 1 }), { type: 'plan', revision: 4, document: {} }, { type: 'trend', run: 0, first: 0, restart: true, rows: [[1, 10]] });
  cell.take(hello('e2'));
  assert.equal(cell.program, null);
  assert.equal(cell.plan, null);
  assert.deepEqual(cell.trend.times, []);
  const { epoch, has } = said(cell);
  assert.equal(epoch, 'e2');
  assert.deepEqual(has, { seq: 0, program: 0, plan: 0, routes: 0, pictures: 0, alarms: 0, forces: 0, tags: false, trend_run: 0, trend_next: 0 });
});

test('Cell_WhenTheServerSpeaksAnotherProtocol_ThenThePageIsLoadedAnew', () => {
  const cell = cellAt(hello('e1', 6));
  assert.equal(reloads, 1);
  assert.equal(cell.hello, null);
});

test('Cell_WhenTheProgramChanges_ThenIndicesOfTheOldOneAreAskedForNoMore', () => {
  const cell = cellAt(hello('e1'), program());
  cell.showTags({}, [0, 1]);
  assert.deepEqual(said(cell).show, { number: 1, digest: 'ab', tags: [[0, 2]], also: ['plan', 'routes', 'pictures'] });
  cell.take(program('cd', 2));
  assert.deepEqual(said(cell).show, { number: 2, digest: 'cd', tags: [], also: ['plan', 'routes', 'pictures'] });
});

test('Cell_WhenSomebodyLogsOut_ThenItIsClosedAndItsServerIsNotLost', () => {
  const cell = cellAt(hello('e1'), program());
  let losses = 0;
  const connection = cell.connect(() => [], async () => void (losses += 1));
  connection.restart(false);
  assert.equal(cell.link, 'closed');
  assert.equal(losses, 0);
  assert.ok(cell.isStale, 'what is shown is old');
  connection.restart(true);
  assert.equal(cell.link, 'connecting', 'who logs in again');
  connection.restart(false);
});

test('Cell_WhenItsSessionIsOver_ThenItAsksWhoLooksAndItsServerIsNotLost', async () => {
  const cell = cellAt(hello('e1'), program());
  let asked = 0;
  let connection = null;
  connection = cell.connect(() => [], async () => {
    asked += 1;
    connection.restart(false); // nobody who has not logged in
  });
  const links = [];
  Socket.last.onclose({ code: 4401 });
  links.push(cell.link);
  await Promise.resolve();
  links.push(cell.link);
  assert.ok(!links.includes('lost'), links.join());
  assert.equal(cell.link, 'closed');
  assert.equal(asked, 1);
});

test('Cell_WhenItsSessionIsOverAndTheServerDoesNotAnswer_ThenItIsLost', async () => {
  const cell = cellAt(hello('e1'), program());
  const connection = cell.connect(() => [], async () => {});
  const first = Socket.last;
  first.onclose({ code: 4401 });
  assert.equal(cell.link, 'connecting');
  await new Promise((resolve) => setTimeout(resolve));
  assert.notEqual(Socket.last, first, 'it is tried again at once');
  Socket.last.onclose({ code: 1006 });
  assert.equal(cell.link, 'lost');
  connection.restart(false);
});

test('Cell_WhenAnotherRunOfTheServerAnswers_ThenItAsksWhoLooks', () => {
  const cell = new Cell();
  let asked = 0;
  const connection = cell.connect(() => [], async () => void (asked += 1));
  cell.take(hello('e1'));
  cell.take(hello('e1'));
  assert.equal(asked, 0);
  cell.take(hello('e2'));
  assert.equal(asked, 1);
  connection.restart(false);
});

test('Cell_WhenItDescribesAPoint_ThenPictureHistoryAndAlarmsSayItsUnit', () => {
  const described = { ...hello('e1'), tags: [{ name: 'A', unit: 'l', decimals: 0 }, { name: 'main.level', unit: 'm' }] };
  const cell = cellAt(described, program(), state({ points: [12.4] }));
  assert.equal(cell.toldPoint('a', 1), '12 l');
  assert.equal(cell.toldNumber('points/a', 3.2), '3 l', 'in the history');
  assert.equal(cell.toldNumber('a', 3.2), '3 l', 'as the source of an alarm');
  assert.equal(cell.toldNumber('Main.Level', 3), '3 m');
  assert.equal(cell.toldPoint('nothing'), '–');
  const plain = cellAt(hello('e1'), program(), state({ points: [12.46] }));
  assert.equal(plain.toldPoint('a', 1), '12.5', 'where nothing is said the picture decides');
});
