// Screens as they are put together: symbols, arranging, what is written of them, and what a page shows.
//
//   node --test screens_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { load } from './load_modules.mjs';

const arrange = await load(process.env.CLIENT, ['screens/editor/arrange']);
const model = await load(process.env.CLIENT, ['screens/editor/model', 'screens/editor/symbols', 'screens/editor/part_symbols', 'screens/editor/idle_parts', 'screens/editor/part_label', 'screens/editor/drawn_elements']);
const sizes = await load(process.env.CLIENT, ['screens/editor/sizing', 'screens/editor/points']);
const view = await load(process.env.CLIENT, ['screens/parts', 'screens/screens', 'screens/overview', 'screens/trend_lines', 'lib/tag_search', 'screens/editor/face_names', 'lib/tag_notes']);

const item = (key, more = {}) => ({ key, symbol: 'pump', x: 0, y: 0, w: 60, h: 60, turn: 0, group: '', params: {}, markup: '', ...more });
const svgOf = (...items) => model.svgOf({ ...model.EMPTY, items }, new Map());

test('Symbols_WhenTheyAreDrawn_ThenEachIsWellFormedAndBoundAsItSays', () => {
  for (const { kind, width, height, fields } of model.SYMBOLS) {
    const params = Object.fromEntries(fields.map((field) => [field, ['from'].includes(field) ? '0' : ['to', 'digits', 'size', 'minutes', 'step'].includes(field) ? '3' : `<"a&'`]));
    const svg = svgOf(item('p1', { symbol: kind, w: width, h: height, params }));
    assert.ok(!svg.includes(`<"a`) && !svg.includes(`a&'`), `${kind} escapes what people type: ${svg}`);
    assert.equal((svg.match(/<g\b/g) ?? []).length, (svg.match(/<\/g>/g) ?? []).length, kind);
    assert.ok(!svg.includes('undefined') && !svg.includes('NaN'), `${kind}: ${svg}`);
  }
});

test('Parts_WhenTheyAreNotComplete_ThenTheyAreSavedWithoutWriting', () => {
  assert.ok(!svgOf(item('p1', { symbol: 'setpoint', params: { write: 'Main.a', from: '5', to: '5' } })).includes('data-part'));
  assert.ok(!svgOf(item('p1', { symbol: 'choice', params: { write: 'Main.a', values: '0=off' } })).includes('data-part'));
  const whole = svgOf(item('p7', { symbol: 'setpoint', params: { write: 'Main.a', from: '0', to: '5', confirm: 'Sure?' } }));
  assert.match(whole, /data-part="setpoint" data-key="p7" data-write="Main.a" data-confirm="Sure\?" data-from="0" data-to="5"/);
});

test('Parts_WhenTheyAreNotComplete_ThenTheyAreNamedAndDrawnAsWhatDoesNothing', () => {
  const parts = [
    item('p1', { symbol: 'button', w: 120, h: 44, params: { label: 'Stop', literal: 'TRUE' } }),
    item('p2', { symbol: 'navigate', w: 120, h: 44, params: {} }),
    item('p3', { symbol: 'setpoint', w: 120, h: 44, params: { write: 'Main.a', from: '90', to: '0' } }),
    item('p4', { symbol: 'switch', w: 120, h: 44, params: { write: 'Main.a' } }),
    item('p5', { symbol: 'trend' }),
  ];
  assert.deepEqual(model.idleIn(parts).map(({ item: { key }, missed }) => [key, missed]), [['p1', 'write'], ['p2', 'go'], ['p3', 'to']]);
  for (const each of parts.slice(0, 3)) assert.ok(model.innerOf(each, new Map()).includes('stroke-dasharray'), each.key);
  assert.ok(!model.innerOf(parts[3], new Map()).includes('stroke-dasharray'));
});

test('Part_WhenSomethingOfItIsNotFilledIn_ThenThePageShowsAPartThatDoesNothing', () => {
  const idle = view.idlePartOf('button', '{"label":"Stop","key":"p1"}');
  assert.deepEqual([idle.kind, idle.label, view.isIdle(idle)], ['button', 'Stop', true]);
  assert.ok(view.isIdle(view.idlePartOf('navigate', '[broken')));
  for (const kind of ['tank', 'trend', '']) assert.equal(view.idlePartOf(kind, '{}'), null, kind);
  assert.ok(!view.isIdle(view.partOf((name) => ({ part: 'switch', write: 'Main.a' })[name] ?? null)));
});

test('Part_WhenTheServerNamesItsLine_ThenItIsFound', () => {
  const items = [item('p1'), item('p2', { symbol: 'drawn', markup: '<g>\n<rect/>\n</g>' }), item('p3', { symbol: 'slider', params: { label: 'Speed' } })];
  for (const title of ['', 'A title']) {
    const content = { settings: { ...model.EMPTY.settings, title }, items };
    const lines = model.svgOf(content, new Map()).split('\n');
    const at = (text) => model.itemInLine(content, new Map(), lines.findIndex((line) => line.includes(text)) + 1)?.key;
    assert.deepEqual([at('"pump"'), at('"drawn"'), at('<rect/>'), at('"slider"')], ['p1', 'p2', 'p2', 'p3']);
    assert.equal(model.itemInLine(content, new Map(), 1), undefined);
    assert.equal(model.itemInLine(content, new Map(), lines.length), undefined);
  }
});

test('Part_WhenItAsks_ThenItSaysWhatIsWritten', () => {
  const words = { start: 'Start', stop: 'Stop', on: 'on', off: 'off' };
  const said = (attributes, wanted) => view.deedOfPart(view.partOf((name) => attributes[name] ?? null), wanted, words, (literal) => `${literal} l`);
  const pair = { part: 'startstop', write: 'Main.motor', label: 'Motor' };
  assert.deepEqual([said(pair, 'start'), said(pair, 'stop')], ['Start', 'Stop']);
  assert.deepEqual([said({ part: 'switch', write: 'Main.v' }, 'TRUE'), said({ part: 'switch', write: 'Main.v' }, 'FALSE')], ['on', 'off']);
  assert.equal(said({ part: 'choice', write: 'Main.m', values: '0=Off;1=By hand' }, '1'), 'By hand');
  assert.equal(said({ part: 'slider', write: 'Main.s' }, '12.5'), '12.5 l');
  assert.equal(said({ part: 'button', write: 'Main.b', value: 'TRUE' }, 'TRUE'), 'TRUE', 'what has only the name of its variable');
  assert.equal(said({ part: 'button', write: 'Main.b', value: 'TRUE', label: 'Flush' }, 'TRUE'), '');
});

test('Drawn_WhenWhatAnotherProgramHasDrawnIsBound_ThenItsElementSaysSoAndCanBeReadAgain', () => {
  assert.deepEqual(model.fieldsOfDrawn('<text x="1">12</text>'), ['value', 'digits', 'unit', 'on', 'warn', 'alarm']);
  assert.deepEqual(model.fieldsOfDrawn('<g><text>12</text></g>'), ['on', 'warn', 'alarm']);
  const text = model.innerOf(item('p1', { symbol: 'drawn', markup: '<text x="1">12</text>', params: { value: 'Main.level', digits: '1', on: '!Main.<a>' } }), new Map());
  assert.equal(text, '<text data-text="Main.level" data-digits="1" data-on="!Main.&lt;a&gt;" x="1">12</text>');
  assert.equal(model.boundMarkup('<rect/>', { value: 'Main.level', alarm: 'Main.hot' }), '<rect data-alarm="Main.hot"/>', 'a shape shows no text');
  assert.equal(model.boundMarkup('<text>a</text>', { unit: 'l' }), '<text>a</text>', 'a unit alone is none');
  const attributes = new Map([['data-text', 'Main.level'], ['data-alarm', 'Main.hot'], ['x', '1']]);
  const element = { tagName: 'text', getAttribute: (name) => attributes.get(name) ?? null, removeAttribute: (name) => attributes.delete(name) };
  assert.deepEqual(model.liftedFrom(element), { value: 'Main.level', alarm: 'Main.hot' });
  assert.deepEqual([...attributes.keys()], ['x']);
});

test('Face_WhenItIsRepeated_ThenEachCopyHasItsOwnNamesAndKeys', () => {
  const face = { name: 'Pump', width: 100, height: 50, inner: '<g data-on="{pump}.on" data-key="go"><text>{pump}</text></g>', params: ['pump'] };
  assert.equal(model.filledFace(face, { pump: 'Main.P1' }, 'p3'), '<g data-on="Main.P1.on" data-key="p3-go"><text>Main.P1</text></g>');
  for (const params of [{}, { pump: ' ' }]) assert.equal(model.filledFace(face, params, 'p3').includes('{pump}'), true, 'what nobody has named stays to be seen');
  assert.equal(model.filledFace(face, { pump: '"><script>' }, 'p3').includes('<script>'), false);
  const drawn = model.innerOf(item('p3', { symbol: 'face', w: 200, h: 50, params: { face: 'Pump', pump: 'a' } }), new Map([['Pump', face]]));
  assert.ok(drawn.startsWith('<g transform="scale(2 1)">'));
});

test('Face_WhenItsParametersArePartsOfNames_ThenThoseNamesAreLookedForAndATextIsNone', () => {
  const inner = '<g data-on="!{pump}.running" data-tags="{pump}.real_speed; {line}.{pump}"><text data-text="{pump}.real_speed">{title}</text></g><g data-label="{title}"/>';
  const patterns = view.patternsOf(inner, 'pump');
  assert.deepEqual(patterns, ['{pump}.running', '{pump}.real_speed', '{line}.{pump}']);
  assert.deepEqual(view.patternsOf(inner, 'title'), []);
  assert.deepEqual(view.namesBy(patterns, { pump: 'Main.pump[5]' }), ['Main.pump[5].running', 'Main.pump[5].real_speed'], 'what is still open is no name yet');
  const known = ['Main.pump[1].running', 'Main.pump[1].real_speed', 'MAIN.PUMP[2].RUNNING', 'Main.pump[2].real_speed', 'Main.fan.running', 'Main.level'];
  assert.deepEqual(view.offersOf(patterns, 'pump', known), ['Main.pump[1]', 'MAIN.PUMP[2]'], 'those that have both names');
  assert.deepEqual(view.offersOf(['{value}'], 'value', known), known);
});

test('Face_WhenACopyLeavesFieldsEmpty_ThenTheyAreNamed', () => {
  const faces = new Map([['Pump', { name: 'Pump', width: 100, height: 50, inner: '<text data-text="{pump}.speed">{title}</text>', params: ['pump', 'title'] }]]);
  const copy = (key, params) => item(key, { symbol: 'face', params: { face: 'Pump', ...params } });
  const found = view.unfilledIn([copy('p1', {}), copy('p2', { pump: 'Main.p', title: 'P' }), copy('p3', { pump: ' ', title: 'P' }), item('p4'), copy('p5', { face: 'Gone' })], faces);
  assert.deepEqual(found.map(({ item: { key }, face, fields }) => [key, face, ...fields]), [['p1', 'Pump', 'pump', 'title'], ['p3', 'Pump', 'pump']]);
});

test('Part_WhenItHasNoLabel_ThenItIsCalledAsTheDeclarationOfItsVariableSays', () => {
  const called = (name) => (name === 'Main.pump[1].speed' ? 'wanted speed [1]' : name);
  const setPoint = (params) => item('p1', { symbol: 'setpoint', w: 180, h: 44, params });
  assert.match(model.innerOf(setPoint({ write: 'Main.pump[1].speed' }), new Map(), called), />wanted speed \[1\]<\/text>/);
  assert.match(model.innerOf(setPoint({ write: 'Main.pump[1].speed', label: 'Speed' }), new Map(), called), />Speed<\/text>/, 'a label of its own wins');
  assert.match(model.innerOf(setPoint({ write: 'Main.pump[1].speed' }), new Map()), />Main.pump\[1\].speed<\/text>/, 'a file has the name');
  const part = svgOf(setPoint({ write: '{pump}.speed', from: '0', to: '9' })).match(/<g data-symbol.*<\/g>/s)[0];
  const face = { name: 'Face', width: 180, height: 44, inner: part, params: ['pump'] };
  assert.match(model.filledFace(face, { pump: 'Main.pump[1]' }, 'p3', called), />wanted speed \[1\]<\/text>/, 'in a copy of a face, too');
  assert.equal(view.labelOf({ label: '', go: 'Mixer', write: '' }, called), 'Mixer');
});

test('Part_WhenItsWordsAreLong_ThenTheyAreCutWithinItsEdgesAndWholeInItsTitle', () => {
  assert.deepEqual(model.fitted('Level', 160, 2), ['Level']);
  assert.deepEqual(model.fitted('Start the conveyor', 108, 2), ['Start the', 'conveyor'], 'words are broken between lines first');
  const long = 'Main.sorting_line.conveyor_of_the_infeed[12].speed_that_is_wanted';
  const lines = model.fitted(long, 168, 2);
  assert.equal(lines.length, 2);
  assert.ok(lines[1].endsWith('…') && long.startsWith(lines[0] + lines[1].slice(0, -1)), lines.join('|'));
  const drawn = model.partLabel(long, 180, 44);
  assert.ok(drawn.includes(`<title>${long}</title>`), drawn);
  assert.ok(!model.partLabel('Level', 180, 44).includes('<title>'));
  assert.deepEqual(model.fitted('🙂🙂🙂', 20, 1).length, 1, 'no sign is cut in two');
  assert.deepEqual([44, 20, 100].map(view.linesIn), [2, 1, 5]);
});

test('Items_WhenTheyAreAlignedSpreadAndGrouped_ThenOnlyTheChosenOnesMove', () => {
  const items = [item('a', { x: 10, w: 20 }), item('b', { x: 100, w: 40 }), item('c', { x: 37 }), item('d', { x: 200, w: 20 })];
  const keys = new Set(['a', 'b', 'd']);
  const xs = (list) => list.map(({ x }) => x);
  assert.deepEqual(xs(arrange.aligned(items, keys, 'left', arrange.ownBox)), [10, 10, 37, 10]);
  assert.deepEqual(xs(arrange.aligned(items, keys, 'right', arrange.ownBox)), [200, 180, 37, 200]);
  assert.deepEqual(xs(arrange.spread(items, keys, 'x', arrange.ownBox)), [10, 95, 37, 200]);
  const grouped = arrange.grouped(items, keys);
  assert.deepEqual([...arrange.withGroups(grouped, new Set(['a']))].sort(), ['a', 'b', 'd']);
  assert.deepEqual([...arrange.withGroups(arrange.ungrouped(grouped, keys), new Set(['a']))], ['a']);
  assert.deepEqual(arrange.ordered(items, new Set(['b']), 'front').map(({ key }) => key), ['a', 'c', 'd', 'b']);
});

test('Items_WhenTheyGoOneStep_ThenTheyKeepTheirOrderAmongThemselves', () => {
  const names = (list) => list.map(({ key }) => key).join('');
  const items = ['a', 'b', 'c', 'd'].map((key) => item(key));
  assert.equal(names(arrange.stepped(items, new Set(['a']), 1)), 'bacd');
  assert.equal(names(arrange.stepped(items, new Set(['a', 'b']), 1)), 'cabd');
  assert.equal(names(arrange.stepped(items, new Set(['c', 'd']), 1)), 'abcd', 'what is in front stays there');
  assert.equal(names(arrange.stepped(items, new Set(['b', 'd']), -1)), 'badc');
});

test('Symbol_WhenAHandleIsDragged_ThenOnlyItsEdgesMoveAndComeToLieOnTheGrid', () => {
  const box = ({ x, y, w, h }) => [x, y, w, h];
  const pump = item('p1', { x: 100, y: 100, w: 60, h: 60 });
  assert.deepEqual(box(sizes.sized(pump, 'se', 17, 4, 10)), [100, 100, 80, 60]);
  assert.deepEqual(box(sizes.sized(pump, 'nw', -13, 22, 10)), [90, 120, 70, 40]);
  assert.deepEqual(box(sizes.sized(pump, 'e', 5, 99, 0)), [100, 100, 65, 60]);
  assert.deepEqual(box(sizes.sized(pump, 'w', 900, 0, 10)), [152, 100, 8, 60], 'it does not turn inside out');
});

test('Symbol_WhenItIsTurned_ThenItFillsTheBoxThatItThenHas', () => {
  const pipe = item('p1', { symbol: 'pipe', x: 100, y: 100, w: 120, h: 12 });
  const turned = sizes.turned(pipe);
  assert.deepEqual([turned.x, turned.y, turned.w, turned.h, turned.turn], [154, 46, 12, 120, 90]);
  assert.match(model.innerOf(turned, new Map()), /translate\(6 60\) rotate\(90\) translate\(-60 -6\)"><g><rect width="120" height="12"/);
  const again = [1, 2, 3].reduce((one) => sizes.turned(one), turned);
  assert.deepEqual({ ...again }, { ...pipe }, 'four quarters are none');
});

test('Line_WhenItGoesThroughPoints_ThenItIsMovedStretchedAndTurnedWithThem', () => {
  const corner = [{ x: 300, y: 200 }, { x: 300, y: 90 }, { x: 420, y: 90 }];
  const line = sizes.through(item('p1', { symbol: 'line', params: { arrow: 'both' } }), corner);
  assert.deepEqual([line.x, line.y, line.w, line.h, line.params.points], [300, 90, 120, 110, '0,110 0,0 120,0']);
  assert.deepEqual(sizes.pointsIn(line), corner);
  assert.equal(sizes.resized(line, 240, 110).params.points, '0,110 0,0 240,0');
  assert.equal(sizes.turned(line).params.points, '0,0 110,0 110,120');
  const flat = sizes.through(line, [{ x: 0, y: 5 }, { x: 40, y: 5 }]);
  assert.deepEqual([flat.h, sizes.resized(flat, 40, 30).params.points], [1, '0,0 40,0'], 'what lies flat stays flat');
  const svg = svgOf(line);
  assert.equal((svg.match(/<path /g) ?? []).length, 2, 'an arrow at both ends');
  assert.match(svg, /<polyline points="0,110 0,0 120,0" fill="none"/);
  assert.deepEqual(sizes.pointsOf('1,2 x 3 4,5'), [{ x: 1, y: 2 }, { x: 4, y: 5 }], 'what is no point is none');
  assert.ok(svgOf(item('p1', { symbol: 'line', params: { points: '1,1' } })).includes('0,0 120,0'), 'one point is no line');
});

test('Name_WhenItCouldLeadElsewhereOrIsNotOfAscii_ThenItIsNone', () => {
  assert.deepEqual(['Mixer 1', 'a', 'a.b_c-d', 'x'.repeat(64)].map(view.isScreenName), [true, true, true, true]);
  assert.deepEqual(['', '..', 'a/b', '../a', 'a.', ' a', '🙂', 'Kälte', 'x'.repeat(65)].filter(view.isScreenName), []);
});

test('Role_WhenAScreenIsForHigherOnes_ThenItDoesNotSeeIt', () => {
  assert.deepEqual(['viewer', 'operator', 'engineer'].map((role) => model.roleSees(role, 'operator')), [false, true, true]);
});

test('Copies_WhenTheyArePasted_ThenTheyHaveNamesAndGroupsOfTheirOwn', () => {
  const items = [item('p1', { group: 'g1' }), item('p2', { group: 'g1' })];
  const { items: all, keys } = arrange.pasted(items, items, 20);
  assert.equal(new Set(all.map(({ key }) => key)).size, 4);
  assert.equal(keys.size, 2);
  assert.deepEqual(all.map(({ group }) => group), ['g1', 'g1', 'g2', 'g2']);
  assert.equal(all[2].x, 20);
  const [third, other] = [arrange.pasted(all, items, 20), arrange.pasted(all, [item('p1', { symbol: 'tank' })], 20)];
  assert.deepEqual(third.items.slice(4).map(({ x, y }) => [x, y]), [[40, 40], [40, 40]], 'the next ones lie beside the first, too');
  assert.equal(other.items[4].x, 20, 'what is of another kind is seen all the same');
});

test('Tags_WhenPartsOfTheirWordsAreTyped_ThenTheyAreFound', () => {
  const names = [
    { name: 'Main.total', type: 'REAL', words: 'level times batches' },
    { name: 'Main.level', type: 'REAL', words: 'how full · buffer' },
    { name: 'Main.high_level', type: 'BOOL', words: '' },
  ];
  const found = (text) => view.found(names, text, 5).map(({ name }) => name);
  assert.deepEqual(found('level'), ['Main.level', 'Main.high_level', 'Main.total'], 'what begins so first, what is only said of it last');
  assert.deepEqual(found('!buffer FULL'), ['Main.level']);
  assert.deepEqual(found('nothing'), []);
});

test('Tag_WhenAnythingOfItIsTyped_ThenItIsTheOneOrThoseThatAreMeant', () => {
  const named = [['Main.temp', 'temperature'], ['Main.saw', 'temperature of the saw'], ['Main.saw_2', ''], ['points/a1.level', 'tank a1']].map(([name, words]) => ({ name, type: '', words }));
  const meant = (text) => view.meantBy(named, text).map(({ name }) => name);
  assert.deepEqual(meant('main.SAW'), ['Main.saw'], 'a whole name is no part of another one');
  assert.deepEqual(meant(' Temperature '), ['Main.temp'], 'what people call it as a whole');
  assert.deepEqual(meant('_2'), ['Main.saw_2']);
  assert.deepEqual(meant('Saw'), ['Main.saw'], 'the last part as a whole');
  assert.deepEqual(meant('sa'), ['Main.saw', 'Main.saw_2']);
  assert.deepEqual(meant('tank'), ['points/a1.level']);
  assert.deepEqual([meant('nothing'), meant(' ')], [[], []]);
});

test('Part_WhenItIsRead_ThenItHasWhatTheServerChecked', () => {
  const read = (attributes) => view.partOf((name) => attributes[name] ?? null);
  assert.equal(read({}), null);
  assert.equal(read({ part: 'lever' }), null);
  const choice = read({ part: 'choice', key: 'a', write: 'Main.mode', values: '0 = Off; 2=By = hand;3', on: '!Main.ok' });
  assert.deepEqual(choice.values, [{ literal: '0', name: 'Off' }, { literal: '2', name: 'By = hand' }, { literal: '3', name: '3' }]);
  assert.deepEqual(view.namesOf(choice), ['Main.mode', 'Main.ok']);
  assert.deepEqual([1, 0, null].map((value) => view.runsBy(choice, value)), [false, true, null], 'its feedback is turned round');
  assert.equal(view.runsBy(read({ part: 'startstop' }), 1), null, 'without a feedback nobody knows');
  assert.deepEqual([view.literalOf(20, 'REAL'), view.literalOf(20.5, 'REAL'), view.literalOf(20, 'INT'), view.literalOf(1.5, 'TIME'), view.literalOf(5e-7, 'TIME'), view.literalOf(60, 'TIME')], ['20.0', '20.5', '20', 'T#1.5s', 'T#0.0000005s', 'T#60s']);
});

test('Screens_WhenThePageOpens_ThenItShowsTheOneAskedForTheStartOrTheFirst', () => {
  const entry = (name, more = {}) => ({ name, symbol: false, removed: false, ...more });
  const list = { start: 'B', screens: [entry('A'), entry('B'), entry('Face', { symbol: true }), entry('Old', { removed: true })] };
  assert.deepEqual(['A', 'Face', 'Old', ''].map((asked) => view.chosenOf(list, asked)), ['A', 'B', 'B', 'B']);
  assert.equal(view.chosenOf({ ...list, start: '' }, ''), 'A');
  assert.equal(view.chosenOf(null, 'A'), '');
  assert.equal(view.askedIn(view.hashOf('Mixer 1 & 2')), 'Mixer 1 & 2');
});

test('a trend asks for the history of those tags that have one', () => {
  assert.deepEqual(view.keptOf(['Main.level', 'Main.label', 'main.PUMP'], ['Main.level', 'Main.pump']), ['Main.level', 'main.PUMP']);
  assert.deepEqual(view.keptOf(['Main.label'], []), []);
});

test('Trend_WhenTheHistoryComesLate_ThenItStandsBeforeWhatWasSeen', () => {
  const lines = new view.TrendLines(2, 1);
  lines.add(100, [1, null]);
  lines.begin([98, 99, 100, 101], [[5, 6, 7, 8]]);
  assert.deepEqual(lines.times, [98, 99, 100]);
  assert.deepEqual(lines.columns, [[5, 6, 1], [null, null, null]]);
  for (let k = 0; k < 300; k++) lines.add(101 + k, [k, k]);
  assert.ok(lines.times.length < 140 && lines.columns[0].length === lines.times.length, 'and what is old goes');
});

test('Trend_WhenTheHistoryKnowsMore_ThenItStandsInPlaceOfWhatItKnewBefore', () => {
  const lines = new view.TrendLines(1, 10);
  lines.add(99, [null]);
  assert.equal(lines.seenSince, null, 'before values come nothing is seen');
  lines.add(100, [1]);
  lines.begin([90, 95], [[5, 6]]);
  assert.equal(lines.seenSince, 100);
  lines.add(101, [2]);
  lines.begin([91, 95, 99, 100.5], [[5, 6, 7, 8]]);
  assert.deepEqual([lines.times, lines.columns], [[91, 95, 99, 100, 101], [[5, 6, 7, 1, 2]]]);
});

test('Trend_WhenAColumnHasExtremes_ThenTheyAreDrawnInTheOrderOfTheLine', () => {
  const history = (series, more = {}) => ({ now_ms: 12_000, known_ms: 12_000, from_ms: 0, to_ms: 12_000, column_ms: 3_000, series: series.map(([tag, least, greatest, last]) => ({ tag, least, greatest, last, damaged: 0 })), ...more });
  const saw = ['Main.saw', [0, 3, 0, 4], [2, 9, 1, 4], [2, 9, 1, 4]];
  const rows = view.rowsOf(history([saw]), ['MAIN.saw']);
  assert.deepEqual(rows.times, [1.5, 3, 4.5, 6, 7.5, 9, 12]);
  assert.deepEqual(rows.columns, [[0, 2, 3, 9, 0, 1, 4]], 'what rises is not drawn as falling');
  assert.deepEqual(view.rowsOf(history([['a', [9, 1], [9, 8], [9, 1]]]), ['a']).columns[0], [9, 8, 1]);
  assert.deepEqual(view.rowsOf(history([['a', [9, 0], [9, 8], [9, 5]]]), ['a']).columns[0], [9, 8, 0, 5]);
  const ramp = [[0, 20, 40, 10], [20, 40, 60, 60], [20, 40, 60, 10]];
  assert.deepEqual(view.rowsOf(history([['a', ...ramp]]), ['a']).columns[0], [0, 20, 40, 60, 10], 'a ramp has no steps');
  const two = view.rowsOf(history([saw, ['b', [1, 1, 1, null], [1, 1, 1, null], [1, 1, 1, null]]]), ['b', 'a', 'Main.saw']);
  assert.deepEqual(two.columns[0], [1, 1, 1, 1, 1, 1, null], 'of what holds nothing else is said');
  assert.ok(two.columns[1].every((value) => value === null) && two.columns[2].includes(9));
});

test('Trend_WhenTheHistoryIsNotThereYet_ThenThereIsNoHoleBeforeWhatWasSeen', () => {
  const nothing = [5, 6, null, null];
  const rows = view.rowsOf({ now_ms: 12_000, known_ms: 4_500, from_ms: 0, to_ms: 12_000, column_ms: 3_000, series: [{ tag: 'a', least: nothing, greatest: nothing, last: nothing, damaged: 0 }] }, ['a']);
  assert.deepEqual([rows.times, rows.columns], [[3, 4.5], [[5, 6]]]);
});

test('ScreenTrend_WhenTagsHaveSeveralUnits_ThenEachUnitHasItsScaleAndEachBoolALane', () => {
  const { of, lanes, units } = view.scalesOf(['degC', view.TRUTH, 'bar', 'degC', view.TRUTH, '']);
  assert.deepEqual(units, ['degC', 'bar', '']);
  assert.equal(of[0], of[3]);
  assert.equal(new Set(of).size, 5);
  assert.deepEqual(lanes, [of[1], of[4]]);
  assert.equal(of[2], view.scaleOfUnit('bar'));
  assert.deepEqual(view.scalesOf([view.TRUTH]).units, []);
});

test('Trend_WhenTruthValuesAreBesideNumbers_ThenEachHasALaneOfItsOwn', () => {
  // Where a value lies in the height of the trend.
  const place = ([least, greatest], value) => (value - least) / (greatest - least);
  const [first, second] = [view.laneOf(0, 2, false), view.laneOf(1, 2, false)];
  assert.ok(place(first, 0) > 0 && place(first, 1) < place(second, 0) && place(second, 1) < 0.25);
  const alone = view.laneOf(0, 1, true);
  assert.ok(place(alone, 0) < 0.2 && place(alone, 1) > 0.8, 'alone it has all of it');
  assert.ok(place(view.laneOf(11, 12, false), 1) <= 0.5, 'many leave half of it to numbers');
});

test('Arrange_WhenSymbolsAreAdded_ThenNoneLiesOnAnotherAndTheFirstIsInTheMiddle', () => {
  const [size, room] = [{ width: 180, height: 44 }, { width: 800, height: 450 }];
  assert.deepEqual(arrange.freePlace([], size, room), { x: 400, y: 225 });
  const taken = [{ x: 350, y: 125, width: 100, height: 200 }];
  for (let k = 0; k < 12; k++) {
    const place = arrange.freePlace(taken, size, room);
    const box = { x: place.x - 90, y: place.y - 22, ...size };
    assert.ok(box.x >= 0 && box.y >= 0 && box.x + 180 <= 800 && box.y + 44 <= 450, `inside: ${JSON.stringify(box)}`);
    assert.ok(!taken.some((each) => arrange.touches(each, box)), `on nothing: ${JSON.stringify(box)}`);
    taken.push(box);
  }
  assert.equal(arrange.freePlace([{ x: 0, y: 0, width: 800, height: 450 }], size, room), null, 'it is full');
  assert.equal(arrange.freePlace([], { width: 900, height: 20 }, room), null, 'it is too small');
});

test('Trend_WhenTheServersClockIsAnother_ThenWhatWasSeenIsMovedOntoItInFrontOfNothingLost', () => {
  const lines = new view.TrendLines(1, 10);
  lines.add(5000, [1]);
  lines.add(5001, [2]);
  lines.shift(-3600);
  lines.begin([1390, 1395, 1400], [[7, 8, 9]]);
  lines.add(1402, [3]);
  assert.deepEqual(lines.times, [1390, 1395, 1400, 1401, 1402]);
  assert.deepEqual(lines.columns, [[7, 8, 1, 2, 3]]);
});

test('Overview_WhenTagsAreOfArrays_ThenTheyStandInTheGroupOfTheirArray', () => {
  const tags = [
    { name: 'Main.x', type: 'BOOL', address: '', comment: '' },
    { name: 'Main.p[1].speed', type: 'REAL', address: '', comment: 'how fast' },
    { name: 'Main.p[2].speed', type: 'REAL', address: '', comment: 'how fast' },
    { name: 'Main.levels[3]', type: 'INT', address: '' },
  ];
  const groups = view.groupsOf(tags, new view.TagNotes([], tags));
  assert.deepEqual(groups.map(({ name, rows }) => [name, rows.map(({ words }) => words)]), [
    ['Main', ['Main.x']], ['Main.p', ['how fast [1].speed', 'how fast [2].speed']], ['Main.levels', ['Main.levels[3]']],
  ]);
});

test('Overview_WhenATagHasAValueThatIsANumber_ThenItCanBeDrawnOverTime', () => {
  const tags = ['REAL', 'LINT', 'BOOL', 'TIME', 'LTIME', 'STRING', 'DT'].map((type) => ({ name: `Main.${type}`, type, address: '' }));
  const notes = new view.TagNotes([], tags);
  const groups = view.groupsOf(tags, notes);
  assert.deepEqual(view.firstDrawn(groups, notes, 9), ['Main.REAL', 'Main.LINT', 'Main.BOOL', 'Main.TIME', 'Main.LTIME']);
});

test('Overview_WhenATagIsTicked_ThenItIsDrawnOrRefusedAndNoneGoesForIt', () => {
  assert.deepEqual(view.picked(['a', 'b'], 'c'), ['a', 'b', 'c']);
  assert.deepEqual(view.picked(['a', 'b'], 'a'), ['b']);
  const six = ['a', 'b', 'c', 'd', 'e', 'f'];
  assert.equal(view.picked(six, 'g'), null);
  assert.deepEqual(view.picked(six, 'f'), six.slice(0, 5));
});

test('Overview_WhenABrowserKeptTicks_ThenThoseThatAreThereAreBack', () => {
  const known = ['a', 'b', 'c'];
  assert.deepEqual(view.pickedBefore('["c","a","gone"]', known), ['c', 'a']);
  assert.deepEqual(view.pickedBefore('[]', known), [], 'nothing may be chosen, too');
  for (const text of [null, '', '{', '7', '["gone"]', '[7]']) assert.equal(view.pickedBefore(text, known), null, String(text));
});

test('Screen_WhenItIsAFile_ThenItsNameKeepsItsWords', () => {
  for (const [file, name] of [['Übersicht Halle.svg', 'Uebersicht Halle'], ['my drawing (1).svg', 'my drawing 1'], ['drawing.svg.svg', 'drawing'], ['école.SVG', 'ecole'], ['盤.svg', 'Import'], ['_x_.svg', 'x']]) {
    assert.equal(view.nameOfFile(file), name);
    assert.ok(view.isScreenName(view.nameOfFile(file)), file);
  }
  assert.ok(view.isScreenName(view.nameOfFile(`${'a -'.repeat(40)}.svg`)));
});

test('Screen_WhenANameEndsAsAFile_ThenItIsNone', () => {
  assert.ok(view.isScreenName('start') && view.isScreenName('svg'));
  assert.ok(!view.isScreenName('mixer.svg') && !view.isScreenName('a.SVG'));
});
