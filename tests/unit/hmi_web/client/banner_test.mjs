// What the page says of processes that do not answer: of the one that is lost, and of no other.
//
//   node --test banner_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { load } from './load_modules.mjs';

const { doubtOf } = await load(process.env.CLIENT, ['shell/banner']);

const well = { link: 'live', seen: true, runtime_alive: true, runtime_unlinked: false, runtime_state: 'running', scan: 9, supervisor_alive: true, ended: false, phase: 'executing' };
const of = (more) => doubtOf({ ...well, ...more });

test('Banner_WhenAllIsWell_ThenItSaysNothing', () => {
  assert.equal(of({}), '');
  assert.equal(of({ supervisor_alive: false, phase: null }), '', 'of a cell without a supervisor');
  assert.equal(of({ supervisor_alive: false, phase: 'done' }), '', 'a run that is over needs none');
});

test('Banner_WhenSomebodyLogsOut_ThenTheServerIsNotLost', () => {
  assert.equal(of({ link: 'closed' }), 'loggedOut');
  assert.equal(of({ link: 'closed', seen: false }), '', 'the form says it');
  assert.equal(of({ link: 'connecting' }), '', 'who logs in again has not lost it, either');
});

test('Banner_WhenASessionEndsByItself_ThenItSaysSoAndNotThatTheServerIsLost', () => {
  assert.equal(of({ ended: true }), 'onlyLooks', 'where everybody may look');
  assert.equal(of({ ended: true, link: 'closed' }), 'sessionEnded', 'where nobody may who has not logged in');
  assert.equal(of({ ended: true, link: 'connecting' }), '');
  assert.equal(of({ ended: true, link: 'lost' }), 'staleServer', 'what is lost is told first');
  assert.equal(of({ ended: true, supervisor_alive: false }), 'staleSupervisor');
});

test('Banner_WhenAProcessIsLost_ThenItIsThatOne', () => {
  assert.equal(of({ link: 'lost' }), 'staleServer');
  assert.equal(of({ link: 'lost', seen: false }), 'noServer');
  assert.equal(of({ runtime_alive: false, supervisor_alive: false }), 'staleRuntime');
  assert.equal(of({ runtime_alive: false, scan: 0 }), 'runtimeToCome');
  for (const scan of [0, 9]) assert.equal(of({ runtime_alive: false, runtime_unlinked: true, scan }), 'unlinked');
  assert.equal(of({ supervisor_alive: false }), 'staleSupervisor');
  assert.equal(of({ runtime_state: 'fault', supervisor_alive: false }), 'fault');
});
