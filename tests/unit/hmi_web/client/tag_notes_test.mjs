// What the cell says of tags: units, decimals, names of values, what is normal.
//
//   node --test tag_notes_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { load } from './load_modules.mjs';

const { TagNotes, drawnNumber, enumerationOf, exactInteger, isAbnormal, language, nameOr, told, toldNumber, tracesOf, linesOf, pointNote, tagTable } = await load(process.env.CLIENT, [
  'lib/language.svelte', 'lib/number_input', 'lib/tag_notes', 'lib/value', 'records/history_chart', 'trend/chart', 'tags/tag_table',
]);

const level = { name: 'Main.level', unit: 'l', description: 'level of the buffer', decimals: 1, normal: [0, 200] };
const mode = { name: 'Main.mode', values: ['off', 'by hand'] };

test('Notes_WhenATagIsLookedUp_ThenCaseDoesNotMatterAndAnArrayIsMeantWithAllItsElements', () => {
  const notes = new TagNotes([level, { name: 'Main.levels', unit: 'm' }, { name: 'main.levels[2]', unit: 'mm' }, { name: 'Tank.at', unit: 'cm' }]);
  assert.equal(notes.of('MAIN.LEVEL'), level);
  assert.equal(notes.of('Main.levels[1]').unit, 'm');
  assert.equal(notes.of('Main.levels[2]').unit, 'mm', 'what is said of one element wins');
  assert.equal(notes.of('Tank[3].at').unit, 'cm');
  assert.equal(notes.of('Main.other'), undefined);
  assert.equal(new TagNotes().of('Main.level'), undefined);
});

test('Notes_WhenTheDeclarationSaysSomething_ThenTheCellWinsKeyByKey', () => {
  const tags = [
    { name: 'Main.level', type: 'REAL', address: '', note: { unit: 'm3', group: 'buffer', decimals: 3 } },
    { name: 'Main.levels[1]', type: 'INT', address: '', note: { unit: 'mm', group: 'tanks' } },
    { name: 'Main.levels[2]', type: 'INT', address: '', note: { unit: 'mm', group: 'tanks' } },
    { name: 'Main.bare', type: 'INT', address: '' },
  ];
  const notes = new TagNotes([level, { name: 'Main.levels', unit: 'cm' }], tags);
  assert.deepEqual(notes.of('main.level'), { ...level, group: 'buffer' });
  assert.deepEqual(notes.of('Main.levels[2]'), { name: 'Main.levels', unit: 'cm', group: 'tanks' });
  assert.equal(notes.of('Main.bare'), undefined);
  assert.equal(new TagNotes([], tags).of('Main.levels[1]').unit, 'mm');
  const table = tagTable(tags, [level]).split('\r\n');
  assert.equal(table[1], 'Main.level,REAL,,l,level of the buffer,buffer,1,0,200,');
  assert.equal(table[2], 'Main.levels,INT,,mm,,tanks,,,,');
  assert.equal(table.length, 5, 'one row for the array');
});

test('Value_WhenItHasAUnitAndDecimals_ThenBothAreShown', () => {
  assert.equal(told(12.46, 'REAL', level), '12.5 l');
  assert.equal(told(12.46, 'REAL'), '12.460', 'without a note as ever');
  assert.equal(told(7, 'INT', { name: 'n', unit: 'pcs' }), '7 pcs');
  assert.equal(told(2.5, 'TIME', { name: 't', decimals: 3, unit: 's' }), '2.50 s', 'a time has its own form');
  assert.equal(told(null, 'REAL', level), '–', 'what is not known has no unit');
  assert.deepEqual([told('ready', 'STRING', { name: 's', unit: 'l' }), told('ready', 'WSTRING')], ['ready', 'ready'], 'a text has no quotes, as in a drawing');
  assert.equal(told(1, 'BOOL', { name: 'b' }), 'TRUE');
  assert.equal(told(2e38, 'REAL', level), '2E38 l');
});

test('Value_WhenItHasAName_ThenTheNameIsShownAndTheCellWins', () => {
  const names = { '-1': 'Fault', 0: 'Off', 1: 'Manual', 7: 'Auto' };
  assert.equal(told(7, 'INT', undefined, names), 'Auto');
  assert.equal(told(-1, 'INT', undefined, names), 'Fault');
  assert.equal(told(3, 'INT', undefined, names), '3', 'a value that has none');
  assert.equal(told(1, 'INT', mode, names), 'by hand');
  assert.equal(told(1, 'BOOL', { name: 'b', values: ['shut', 'open'] }), 'open');
  assert.equal(nameOr(null, names), null);
  const program = { tags: [{ name: 'm', enumeration: 0 }, { name: 'n' }], enumerations: [names] };
  assert.equal(enumerationOf(program, 0), names);
  assert.equal(enumerationOf(program, 1), undefined);
  assert.equal(enumerationOf(null, 0), undefined);
});

test('Number_WhenItIsOfTheHistory_ThenItIsWrittenInTheLanguageOfThePage', () => {
  language.code = language.locale = 'de';
  assert.equal(toldNumber(12.46, level), '12,5 l');
  assert.equal(toldNumber(1, mode), 'by hand');
  language.code = language.locale = 'en';
  assert.equal(toldNumber(0.42), '0.42');
  assert.equal(toldNumber(undefined, level), '–');
  assert.equal(toldNumber(30, undefined, undefined, 'TIME'), '30 s');
  assert.equal(toldNumber(1, undefined, undefined, 'BOOL'), 'TRUE');
});

test('Number_WhenItIsInTableHistoryAndAlarms_ThenItIsWrittenInOneWayOfTheLanguage', () => {
  const plain = { name: 'Main.flow', unit: 'l' };
  for (const [code, decided, free, huge] of [['de', '95,00 l', '12,460 l', '1E38 l'], ['en', '95.00 l', '12.460 l', '1E38 l'], ['fr', '95,00 l', '12,460 l', '1E38 l'], ['es', '95,00 l', '12,460 l', '1E38 l']]) {
    language.code = language.locale = code;
    for (const write of [(value, note) => told(value, 'REAL', note), (value, note) => toldNumber(value, note, undefined, 'REAL')]) {
      assert.equal(write(95, { ...level, decimals: 2 }), decided, code);
      assert.equal(write(12.46, plain), free, code);
      assert.equal(write(1e38, plain), huge, code);
    }
    assert.equal(told(2.5, 'TIME'), code === 'en' ? '2.50 s' : '2,50 s', code);
  }
  language.code = language.locale = 'en';
});

test('Value_WhenItIsBeyondWhatIsNormal_ThenItIsMarked', () => {
  assert.deepEqual([-0.1, 0, 200, 200.1, null, 'x'].map((value) => isAbnormal(value, level)), [true, false, false, true, false, false]);
  assert.equal(isAbnormal(1e9, mode), false);
});

test('Trend_WhenATagIsDescribed_ThenItsLineIsCalledSoAndHasItsUnit', () => {
  const points = [{ id: 'a1.level', label: 'a1', unit: '%' }];
  const [point, tag, plain] = tracesOf(['points/a1.level', 'Main.level', 'x'], points, new TagNotes([level]));
  assert.deepEqual([point.label, point.unit], ['a1 (a1.level)', '%']);
  assert.deepEqual([tag.label, tag.unit], ['level of the buffer (Main.level)', 'l']);
  assert.deepEqual([plain.label, plain.unit], ['x', '']);
});

test('Trend_WhenOnlyTheDeclarationHasAComment_ThenItsLineIsCalledByIt', () => {
  const tags = [{ name: 'Main.level', type: 'REAL', address: '', comment: 'level of the buffer', note: { unit: 'l', group: 'tank' } }, { name: 'Main.p[1].speed', type: 'REAL', address: '', comment: 'how fast' }];
  const notes = new TagNotes([{ name: 'main.P', group: 'pumps' }], tags);
  const [line] = tracesOf(['Main.level'], [], notes);
  assert.deepEqual([line.label, line.unit], ['level of the buffer (Main.level)', 'l']);
  assert.deepEqual(['MAIN.level', 'Main.p[1].speed', 'Main.x'].map((name) => notes.calledBy(name)), ['level of the buffer', 'how fast [1].speed', 'Main.x']);
  assert.equal(new TagNotes([level], [{ ...tags[0], comment: 'another' }]).descriptionOf('Main.level'), 'level of the buffer', 'the cell wins');
});

test('Point_WhenTheCellDescribesIt_ThenTrendsCallItSoAndElseAsThePictureDoes', () => {
  const points = [{ id: 'a1.level', label: 'tank a1', unit: '%', trend: true }, { id: 'in.speed', label: 'belt in', unit: 'm/s', trend: true }];
  const notes = new TagNotes([{ name: 'A1.LEVEL', unit: 'l', description: 'buffer', decimals: 0, normal: [0, 90] }]);
  const [level, speed] = linesOf(points, notes);
  assert.deepEqual([level.label, level.unit, toldNumber(12.46, level.note)], ['buffer', 'l', '12 l']);
  assert.deepEqual([speed.label, speed.unit, toldNumber(0.456, speed.note)], ['belt in', 'm/s', '0.46 m/s']);
  assert.equal(isAbnormal(91, level.note), true);
  assert.deepEqual(pointNote(points[0], new TagNotes(), 1), { name: 'a1.level', unit: '%', description: 'tank a1', decimals: 1 });
  const [line] = tracesOf(['points/a1.level'], points, notes);
  assert.deepEqual([line.label, line.unit], ['buffer (a1.level)', 'l']);
});

test('Table_WhenTagsAndPointsAreDescribed_ThenEachHasARowAndAnArrayOne', () => {
  const tags = [
    { name: 'Main.level', type: 'REAL', address: '', comment: 'how full' },
    { name: 'Main.levels[1]', type: 'INT', address: '%IW1' },
    { name: 'Main.levels[2]', type: 'INT', address: '%IW2' },
    { name: 'Main.mode', type: 'INT', address: '' },
  ];
  const said = [level, { name: 'Main.levels', unit: 'mm, "deep"' }, mode, { name: 'a1.level', decimals: 0 }];
  assert.equal(tagTable(tags, said), [
    'name,type,address,unit,description,group,decimals,least,greatest,values',
    'Main.level,REAL,,l,level of the buffer,,1,0,200,',
    'Main.levels,INT,%IW1,"mm, ""deep""",,,,,,',
    'Main.mode,INT,,,,,,,,off|by hand',
    'a1.level,,,,,,0,,,',
    '',
  ].join('\r\n'));
  assert.match(tagTable(tags, []), /Main\.level,REAL,,,how full/);
  assert.match(tagTable(tags, [{ name: 'Main.mode', values: ['a|b', 'c\\', 'd'] }]), /Main\.mode,INT,,,,,,,,a\\\|b\|c\\\\\|d\r/);
});

test('Value_WhenAnIntegerHasMoreDigitsThanANumber_ThenAllOfThemAreShown', () => {
  const digits = '9007199254740993';
  assert.equal(told(digits, 'LINT'), digits);
  assert.equal(told(digits, 'ULINT', { name: 'x', unit: 'pcs', decimals: 1 }), `${digits} pcs`);
  assert.equal(told(Number('18446744073709551615'), 'ULINT', { name: 'x', unit: 'pcs' }), '≈ 18446744073709600000 pcs', 'what was kept of it is rounded');
  assert.equal(told(-9007199254740994, 'LINT'), '≈ -9007199254740990');
  assert.equal(told(9007199254740992, 'LINT'), '9007199254740992');
  assert.equal(told(1767312000e9, 'DATE', { name: 'x', unit: 'd' }), 'D#2026-01-02', 'of an alarm');
  assert.equal(told(45000.5e9, 'TOD'), 'TOD#12:30:00.5');
  assert.equal(told(1767357000.25e9, 'DT'), 'DT#2026-01-02-12:30:00.25');
  assert.equal(told(digits, 'STRING'), digits);
  assert.equal(drawnNumber(digits, 'LINT'), 9007199254740992);
  assert.equal(drawnNumber('12', 'STRING'), null);
  assert.equal(exactInteger(` -${digits} `), `-${digits}`);
  assert.equal(exactInteger('1.5'), null);
});
