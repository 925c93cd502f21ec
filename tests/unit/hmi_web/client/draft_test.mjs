// What was drawn and not saved comes back to who has drawn it, in each tab its own.
//
//   node --test draft_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { beforeEach, test } from 'node:test';

import { load } from './load_modules.mjs';

const { draftOf, forgetDraft, keepDraft } = await load(process.env.CLIENT, ['screens/editor/draft']);

const storage = (kept = new Map()) => ({ getItem: (key) => kept.get(key) ?? null, setItem: (key, value) => kept.set(key, String(value)) });
// A tab has a session of its own and shares what the browser keeps.
const tabs = { one: storage(), two: storage() };
const inTab = (name) => (globalThis.sessionStorage = tabs[name]);
const draft = (name, svg, version = 1) => ({ name, version, svg });

beforeEach(() => {
  globalThis.localStorage = storage();
  inTab('one');
});

test('Draft_WhenTwoTabsDraw_ThenEachHasItsOwn', () => {
  keepDraft('emil', draft('', 'first'));
  inTab('two');
  keepDraft('emil', draft('', 'second'));
  assert.equal(draftOf('emil', '').svg, 'second');
  inTab('one');
  assert.equal(draftOf('emil', '').svg, 'first');
  forgetDraft('emil', '');
  assert.equal(draftOf('emil', '').svg, 'second', 'of a tab that may be closed');
});

test('Draft_WhenSomebodyElseLogsIn_ThenItIsNotHis', () => {
  keepDraft('emil', draft('Mixer', 'of emil', 3));
  assert.equal(draftOf('erna', 'Mixer'), null);
  keepDraft('erna', draft('Mixer', 'of erna'));
  assert.deepEqual(draftOf('emil', 'Mixer'), draft('Mixer', 'of emil', 3));
});

test('Draft_WhenSeveralScreensAreDrawn_ThenNoneIsLost', () => {
  for (const name of ['A', 'B', 'C']) keepDraft('emil', draft(name, `of ${name}`));
  keepDraft('emil', draft('B', 'of B again'));
  assert.deepEqual(['A', 'B', 'C'].map((name) => draftOf('emil', name).svg), ['of A', 'of B again', 'of C']);
  for (let n = 0; n < 20; n++) keepDraft('emil', draft(`more ${n}`, 'x'));
  assert.equal(draftOf('emil', 'A'), null, 'only the newest: a browser has little room');
  assert.equal(draftOf('emil', 'more 19').svg, 'x');
});

test('Draft_WhenTheBrowserHoldsSomethingElse_ThenThereIsNone', () => {
  for (const wrong of ['', 'x', '{}', 'null', '[null, 1, {"user": "emil"}]']) {
    globalThis.localStorage.setItem('stepwright.screen-drafts', wrong);
    assert.equal(draftOf('emil', 'Mixer'), null, wrong);
    keepDraft('emil', draft('Mixer', 'x'));
    assert.equal(draftOf('emil', 'Mixer').svg, 'x');
  }
});
