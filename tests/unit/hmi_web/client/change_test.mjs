// What the page makes of two programs: their sheets as lines, and the differences of these.
//
//   node --test change_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { load } from './load_modules.mjs';

const { compareLines, compareSheets, fold, linesOf, readSources, base64Of, readChoice } = await load(process.env.CLIENT, [
  'change/change', 'change/sheet_lines', 'change/source_diff', 'program/document',
]);

const line = (text, number = 0) => ({ text, number });
const lines = (texts) => texts.map((text, index) => line(text, index + 1));
const before = (rows) => rows.filter(({ kind }) => kind !== 'added').map(({ text }) => text);
const after = (rows) => rows.filter(({ kind }) => kind !== 'removed').map(({ text }) => text);

test('Lines_WhenTheyAreCompared_ThenEachSideCanBeReadOffTheRows', () => {
  // The same sequence of numbers every time.
  let seed = 7;
  const random = (most) => (seed = (seed * 1_103_515_245 + 12_345) % 2 ** 31) % most;
  for (let turn = 0; turn < 300; ++turn) {
    const old = Array.from({ length: random(40) }, () => `line ${random(12)}`);
    const fresh = old.flatMap((text) => (random(5) === 0 ? [] : random(5) === 0 ? [`new ${random(4)}`, text] : [text]));
    const rows = compareLines(lines(old), lines(fresh));
    assert.deepEqual(before(rows), old);
    assert.deepEqual(after(rows), fresh);
    rows.forEach(({ kind, before: left, after: right }) => assert.deepEqual([left > 0, right > 0], [kind !== 'added', kind !== 'removed']));
    if (old.join() === fresh.join()) assert.ok(rows.every(({ kind }) => kind === 'same'));
  }
});

test('Lines_WhenOneIsChanged_ThenNoOtherIsShownAsDifferent', () => {
  const old = Array.from({ length: 2_000 }, (_, index) => `line ${index}`);
  const fresh = old.with(1_000, 'another one');
  const rows = compareLines(lines(old), lines(fresh)).filter(({ kind }) => kind !== 'same');
  assert.deepEqual(rows, [
    { kind: 'removed', text: 'line 1000', before: 1_001, after: 0 },
    { kind: 'added', text: 'another one', before: 0, after: 1_001 },
  ]);
});

// The shortest way from one to the other would keep the line that both have. It is not looked for to its end: that takes a time
// that grows with the square of the length.
test('Lines_WhenTheyHaveNextToNothingInCommon_ThenOneGoesAndTheOtherComes', () => {
  const old = Array.from({ length: 20_000 }, (_, index) => `line ${index}`);
  const fresh = old.map((text, index) => (index === 10_000 ? text : `new ${text}`));
  const rows = compareLines(lines(old), lines(fresh));
  assert.deepEqual([before(rows).length, after(rows).length], [20_000, 20_000]);
  assert.ok(rows.every(({ kind }) => kind !== 'same'));
});

test('Lines_WhenOnlyBlanksAtTheEndDiffer_ThenTheyAreTheSame', () => {
  assert.ok(compareLines(lines(['a  ', 'b']), lines(['a', 'b\t'])).every(({ kind }) => kind === 'same'));
});

test('Fold_WhenManyLinesAreTheSame_ThenOnlyTheNearOnesAreShown', () => {
  const old = Array.from({ length: 30 }, (_, index) => `line ${index}`);
  const stretches = fold(compareLines(lines(old), lines(old.with(15, 'x'))));
  assert.deepEqual(stretches.map(({ folded, rows }) => [folded, rows.length]), [[true, 12], [false, 8], [true, 11]]);
  assert.deepEqual(fold([]), []);
  const short = fold(compareLines(lines(['a', 'b', 'c', 'd', 'e']), lines(['a', 'b', 'c', 'd', 'x'])));
  assert.ok(short.every(({ folded }) => !folded), 'a single line is not worth folding');
});

const sheet = (name, texts, more = {}) => ({ name, kind: 'PROGRAM', language: 'ST', file: 'a.st', blocks: [{ kind: 'text', first: 5, lines: texts }], ...more });
const sheetsOf = (...sheets) => readSources({ state: 'complete', document: { version: 1, sheets } }).sheets;

test('Sheets_WhenSomeAreNewOrGone_ThenEachIsToldWithItsState', () => {
  const old = sheetsOf(sheet('Stays', ['a']), sheet('Changes', ['a', 'b']), sheet('Goes', ['a']));
  const fresh = sheetsOf(sheet('STAYS', ['a']), sheet('Comes', ['a']), sheet('Changes', ['a', 'c'], { file: 'other.st' }));
  const told = compareSheets(old, fresh).map(({ name, state, added, removed }) => [name, state, added, removed]);
  assert.deepEqual(told, [['STAYS', 'changed', 1, 1], ['Comes', 'added', 2, 0], ['Changes', 'changed', 1, 1], ['Goes', 'removed', 0, 2]]);
  assert.ok(compareSheets(old, old).every(({ state, stretches }) => state === 'same' && stretches.length === 0));
});

test('Sheets_WhenTheyAreInAnyLanguage_ThenWhatChangesInThemIsSeen', () => {
  const rung = { kind: 'rung', number: 1, condition: { kind: 'all', of: [{ kind: 'contact', name: 'Start' }, { kind: 'contact', name: 'Stop', negated: true }] }, coils: [{ kind: 'set', name: 'Run' }] };
  const chart = [
    { kind: 'step', name: 'Wait', initial: true, actions: [{ qualifier: 'L', target: 'pump', duration: 'T#2s' }] },
    { kind: 'step', name: 'Fill' },
    { kind: 'transition', name: 'begins', from: [0], to: [1], lines: ['go'] },
    { kind: 'action', name: 'Act', lines: ['x := 1;'] },
  ];
  const drawn = { kind: 'diagram', elements: [{ kind: 'inVariable', name: 'level' }, { kind: 'block', name: 'ADD', inputs: [{ name: 'IN1', connections: [{ from: 0 }] }, { name: 'IN2', text: '5' }] }] };
  const variables = [{ name: 'x', type: 'INT', section: 'VAR', initial: '3', address: '%MW2', comment: 'why' }];
  const texts = (blocks, more = {}) => linesOf(sheetsOf({ name: 'P', kind: 'PROGRAM', variables, blocks, ...more })[0]).map(({ text }) => text);
  assert.deepEqual(texts([]), ['PROGRAM P', 'VAR', '  x AT %MW2 : INT := 3; (* why *)', 'END_VAR']);
  assert.deepEqual(texts([rung]).slice(4), ['(* 1 *)', '  (Start AND NOT Stop)', '    → S Run']);
  assert.deepEqual(texts(chart).slice(4), [
    'INITIAL_STEP Wait:', '  pump(L, T#2s);', 'END_STEP', 'STEP Fill:', 'END_STEP',
    'TRANSITION begins FROM Wait TO Fill', '  go', 'END_TRANSITION', 'ACTION Act:', '  x := 1;', 'END_ACTION',
  ]);
  assert.deepEqual(texts([drawn]).slice(4), ['#1 inVariable level', '#2 block ADD ← IN1 := #1, IN2 := 5']);
  // Every single change of a block is a change of its lines.
  const changes = [
    [rung, { ...rung, coils: [{ kind: 'reset', name: 'Run' }] }], [rung, { ...rung, jump: 'End' }], [rung, { ...rung, comment: 'c' }], [rung, { ...rung, return: true }],
    [chart[0], { ...chart[0], initial: false }], [chart[2], { ...chart[2], to: [0] }],
    [drawn, { ...drawn, elements: [{ ...drawn.elements[0], negated: true }, drawn.elements[1]] }],
  ];
  for (const [one, other] of changes) assert.notDeepEqual(texts([chart[0], one]), texts([chart[0], other]), JSON.stringify(other));
});

test('Choice_WhenFilesAreChosen_ThenOneContainerOrSourcesAreSent', async () => {
  const bytes = Uint8Array.from({ length: 30_001 }, (_, index) => index % 251);
  assert.deepEqual(Buffer.from(base64Of(bytes), 'base64'), Buffer.from(bytes));
  const container = new File([bytes], 'Main.SWB');
  const one = await readChoice([container]);
  assert.deepEqual(one.ok && one.body, { name: 'Main.SWB', container: base64Of(bytes) });
  const source = new File(['a\r\nb'], 'a.st');
  const texts = await readChoice([source, new File(['<x/>'], 'b.xml')]);
  assert.deepEqual(texts.ok && texts.body, { files: { 'a.st': 'a\r\nb', 'b.xml': '<x/>' } });
  assert.deepEqual(texts.texts.get('a.st'), ['a', 'b']);
  assert.deepEqual(await readChoice([container, source]), { ok: false, why: 'mixed' });
  assert.deepEqual(await readChoice([new File([new Uint8Array(2 ** 21 + 1)], 'large.st')]), { ok: false, why: 'large' });
});
