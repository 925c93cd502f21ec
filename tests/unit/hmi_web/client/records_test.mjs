// What the page says of alarms: what stands, what is over, and of which nobody knows.
//
//   node --test records_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { load } from './load_modules.mjs';

const { axisOf, AlarmSound, byUrgency, dayBefore, isOver, language, evidenceText, isAsSaved, isGroupName, msOf, partedBy, rangeText, readView, summaryOf, tracesOf, translated, withoutAxis, wordsOf } = await load(process.env.CLIENT, [
  'records/records', 'records/trend_view', 'records/history_chart', 'records/alarm_words', 'records/alarm_sound.svelte', 'lib/language.svelte', 'plan/evidence',
]);

const alarm = (name, state, more = {}) => ({
  name, state, text: name, priority: 'medium', active: /^(un)?acknowledged$/.test(state), since_ms: 1, raised_ms: 1, ...more,
});
const list = (alarms, unknown = 0, gone = 0) => ({ count: 9, alarms, figures: { no_value: unknown, no_variable: gone } });

test('Bar_WhenTheOnlyAlarmHasReturned_ThenNoneIsActive', () => {
  const gone = alarm('level', 'returned, unacknowledged');
  const { first, active, waiting } = summaryOf(list([gone]));
  assert.equal(first, gone, 'it is still told: somebody is to see it');
  assert.ok(isOver(first));
  assert.deepEqual([active, waiting], [0, 1]);
});

test('Bar_WhenOneStandsAndAMoreUrgentOneHasReturned_ThenTheOneThatStandsComesFirst', () => {
  const gone = alarm('fire', 'returned, unacknowledged', { priority: 'critical', since_ms: 9 });
  const stands = alarm('level', 'unacknowledged', { priority: 'low' });
  const { first, active, waiting } = summaryOf(list([gone, stands]));
  assert.equal(first, stands);
  assert.deepEqual([active, waiting], [1, 2]);
});

test('Bar_WhenALatchIsLeft_ThenItIsOverButNotGone', () => {
  assert.ok(isOver(alarm('door', 'latched, acknowledged')));
  assert.ok(!isOver(alarm('door', 'acknowledged')));
  assert.ok(!isOver(alarm('door', 'shelved')), 'nobody is to look at it');
});

test('Bar_WhenAlarmsHaveNoValue_ThenTheyAreCountedAndDoNotStand', () => {
  const unknown = alarm('misspelt', 'no value');
  const summary = summaryOf(list([unknown, alarm('removed', 'no variable')], 3, 2));
  assert.deepEqual(summary, { first: undefined, active: 0, waiting: 0, unknown: 3, gone: 2 });
  assert.deepEqual(summaryOf(null), { first: undefined, active: 0, waiting: 0, unknown: 0, gone: 0 });
});

test('List_WhenAlarmsAreOfEveryKind_ThenWhatStandsComesFirstAndWhatIsHiddenLast', () => {
  const states = ['shelved', 'no value', 'latched, acknowledged', 'acknowledged', 'returned, unacknowledged', 'unacknowledged'];
  const sorted = states.map((state) => alarm(state, state)).sort(byUrgency).map(({ state }) => state);
  assert.deepEqual(sorted, [...states].reverse());
});

test('Axis_WhenTheServerOrAPersonSaysIt_ThenOnlyWhatCanBeDrawnIsTaken', () => {
  assert.deepEqual(axisOf(undefined), { kind: 'unit' });
  assert.deepEqual(axisOf('own'), { kind: 'own' });
  assert.deepEqual(axisOf('-1.5..100'), { kind: 'range', least: -1.5, greatest: 100 });
  for (const wrong of ['5..1', 'a..b', '1..1', 'other']) assert.deepEqual(axisOf(wrong), { kind: 'unit' });
  assert.equal(rangeText('0,5', ' 10 '), '0.5..10', 'a comma is a point');
  assert.equal(rangeText('10', '0.5'), null);
  assert.equal(rangeText('', '1'), null);
});

test('View_WhenABrowserKeptIt_ThenItIsUsedAndElseNothing', () => {
  const kept = { tags: ['a', 'b', 'a'], axes: { a: 'own', b: 3 }, spanMs: 3_600_000, compares: true, group: 'g' };
  assert.deepEqual(readView(JSON.stringify(kept)), { tags: ['a', 'b'], axes: { a: 'own' }, spanMs: 3_600_000, compares: true, group: 'g' });
  for (const wrong of [null, '', '{', 'null', '{}', '{"tags": [1]}', '[]']) assert.equal(readView(wrong), null, String(wrong));
  assert.equal(readView('{"tags": [], "spanMs": -3}').spanMs, 600_000);
});

test('Group_WhenATagHasNoHistoryAnyMore_ThenItIsKeptAndNamed', () => {
  const tags = ['Main.sine', 'Main.sinee', 'Main.txt'];
  assert.deepEqual(partedBy(tags, ['Main.sine']), { drawn: ['Main.sine'], missing: ['Main.sinee', 'Main.txt'] });
  assert.deepEqual(partedBy(tags, null), { drawn: tags, missing: [] }, 'before anybody knows');
});

test('Group_WhenNoAddressLeadsToItsName_ThenItIsNone', () => {
  assert.deepEqual(['', ' ', '.', '..', '...', 'a/b', '50 %'].map(isGroupName), [false, false, false, false, true, true, true]);
});

test('Trace_WhenATagHasAnAxisOfItsOwnOrIsATruthValue_ThenItHasItsOwnScale', () => {
  const [level, own, range, on] = tracesOf(['a', 'b', 'c', 'd'], [], undefined, { b: 'own', c: '0..100' }, (tag) => (tag === 'd' ? 'BOOL' : 'REAL'));
  assert.deepEqual([level.scale, level.range], ['', undefined]);
  assert.deepEqual([own.scale, own.range], ['@b', undefined]);
  assert.deepEqual([range.scale, range.range], ['@c', [0, 100]]);
  assert.deepEqual([on.scale, on.isBool, on.range], ['@bool', true, [-0.1, 1.1]]);
});

test('DayBefore_WhenColumnsDiffer_ThenValuesAreTakenByTheirTime', () => {
  const day = 86_400_000;
  const now = { from_ms: day + 1_000, to_ms: day + 5_000, column_ms: 1_000, series: [{ tag: 'a', last: [1, 2, 3, 4] }, { tag: 'b', last: [1, 1, 1, 1] }] };
  const before = { from_ms: 0, to_ms: 8_000, column_ms: 2_000, series: [{ tag: 'a', last: [10, 20, 30, null] }] };
  assert.deepEqual(dayBefore(now, before), [[20, 20, 30, 30], [null, null, null, null]]);
  assert.deepEqual(dayBefore(now, null), [[null, null, null, null], [null, null, null, null]]);
});

test('Words_WhenAnAlarmIsToldInALanguage_ThenInThoseOfItsDefinitionOrOfEveryCell', () => {
  const lost = { text: 'The level of tank a1 is high', consequence: '', response: 'stop what fills it' };
  assert.deepEqual(wordsOf(lost), { ...lost, lang: undefined });
  const own = { text: 'Door open', consequence: 'it is cold', response: '', words: { de: { text: 'Tür offen', consequence: '', response: '' } } };
  language.code = 'de';
  assert.deepEqual(wordsOf(own), { text: 'Tür offen', consequence: 'it is cold', response: '', lang: undefined });
  language.code = 'fr';
  assert.equal(wordsOf(own).lang, 'en', 'what has no words in it stays as it is');
  language.code = 'en';
  assert.equal(translated("the program has no variable 'Main.x'"), "the program has no variable 'Main.x'");
  assert.equal(translated('something else'), 'something else');
});

test('Sound_WhenAnAlarmWaits_ThenItIsHeardUnlessThisPersonHasMutedIt', () => {
  const kept = new Map();
  globalThis.localStorage = { getItem: (key) => kept.get(key) ?? null, setItem: (key, value) => kept.set(key, value) };
  let tones = 0;
  let timers = 0;
  globalThis.window = { ...globalThis.window, setInterval: () => (timers += 1), clearInterval: () => (timers = 0) };
  const node = () => ({ frequency: {}, gain: { setValueAtTime() {}, exponentialRampToValueAtTime() {} }, connect: (to) => to, start: () => (tones += 1), stop() {} });
  globalThis.AudioContext = class {
    state = 'running';
    currentTime = 0;
    createOscillator = node;
    createGain = node;
  };
  const sound = new AlarmSound();
  sound.setUser('ada');
  sound.show('high');
  assert.deepEqual([tones, timers], [1, 1]);
  sound.show('critical');
  assert.deepEqual([tones, timers], [1, 1], 'the next one comes with the beat');
  sound.show(null);
  assert.equal(timers, 0);
  sound.mute(true);
  sound.show('high');
  assert.equal(tones, 1, 'she has muted it');
  sound.show(null);
  sound.setUser('bob');
  assert.equal(sound.muted, false);
  sound.show('high');
  assert.equal(tones, 2, 'he has not');
  sound.setUser('ada');
  assert.equal(sound.muted, true, 'and it is remembered');
  delete globalThis.AudioContext;
  sound.show(null);
  sound.setUser('bob');
  sound.show('low');
  sound.show(null);
});

test('Time_WhenAFieldHasOne_ThenItIsOfThisPlace', () => {
  assert.equal(msOf('2026-05-01T12:30'), new Date(2026, 4, 1, 12, 30).getTime());
  assert.equal(msOf(''), '');
  assert.equal(msOf('soon'), '');
});

test('Evidence_WhenASentenceIsKnown_ThenItIsInThePagesLanguageAndElseMarkedAsEnglish', () => {
  assert.deepEqual(evidenceText('stopped from outside: by hand'), { text: 'stopped from outside: by hand', lang: undefined });
  assert.equal(evidenceText("'rack 1' is free again").text, '“rack 1” is free again');
  assert.equal(evidenceText('spill is blocked at (1.0 m, -2.5 m)').text, 'spill is blocked at (1.0 m, -2.5 m)');
  language.code = 'de';
  assert.deepEqual(evidenceText('level of a2 differs'), { text: 'level of a2 differs', lang: 'en' });
  assert.equal(evidenceText('held by the operator').lang, undefined);
  language.code = 'en';
});

test('Group_WhenTagsOrAxesDiffer_ThenItIsNotAsItWasSaved', () => {
  const group = { name: 'G', tags: ['a', 'b'], axes: { a: 'own' }, span_s: 60, saved_by: 'olga', saved_ms: 1 };
  assert.ok(isAsSaved(group, ['a', 'b'], { a: 'own', b: '', gone: 'own' }), 'of tags that are not shown no axis counts');
  assert.ok(!isAsSaved(group, ['a'], { a: 'own' }));
  assert.ok(!isAsSaved(group, ['a', 'b'], {}));
  assert.ok(!isAsSaved(group, ['a', 'b'], { a: '0..9' }));
});

test('Traces_WhenThereAreMoreScalesThanAxesAndLinesThanColours_ThenTheOthersAreToldAndDashed', () => {
  const tags = ['a', 'b', 'c', 'd', 'e', 'f', 'g'];
  const traces = tracesOf(tags, [], undefined, { a: 'own', b: 'own', c: 'own', d: 'own', e: 'own', f: '0..5', g: 'own' });
  const series = tags.map((tag, k) => ({ tag, least: [null, k, k + 1], greatest: [null, k + 2, k + 1], last: [null, k, k], damaged: 0 }));
  const told = withoutAxis(traces, { now_ms: 9, known_ms: 9, from_ms: 0, to_ms: 9, column_ms: 3, series });
  assert.deepEqual(told.map(({ trace, least, greatest }) => [trace.tag, least, greatest]), [['e', 4, 6], ['f', 0, 5], ['g', 6, 8]]);
  assert.deepEqual(withoutAxis(traces, null).map(({ least }) => least), [null, 0, null]);
  assert.deepEqual(withoutAxis(traces.slice(0, 4), null), []);
  assert.deepEqual(traces.map(({ dashed }) => dashed), [false, false, false, false, false, false, true]);
});
