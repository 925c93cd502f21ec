// The logic of the program's panel: documents and values of any shape, names and their tags, uses, search.
//
//   node --test program_test.mjs, with CLIENT: the folder in which the client is built

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { load } from './load_modules.mjs';

const program = await load(process.env.CLIENT, [
  'program/diagram_layout', 'program/document', 'program/lines', 'program/live', 'program/rung_layout', 'program/scope', 'program/uses',
]);

const TAGS = [
  ['Main.level', 'INT', ''], ['Main.f.y', 'REAL', ''], ['Main.f.x', 'REAL', ''], ['Main.a[1]', 'INT', ''], ['Main.a[2]', 'INT', ''],
  ['Second.level', 'INT', ''], ['Alarm', 'BOOL', '%QX0.1'], ['Main.t.Q', 'BOOL', ''], ['Main.i', 'INT', ''],
].map(([name, type, address]) => ({ name, type, address }));
const MESSAGE = {
  type: 'program', digest: 'd', tags: TAGS, transitions: [], charts: [{ name: 'Main', steps: 2, transitions: 0 }],
  steps: ['S1', 'S2'].map((name) => ({ name, comment: '', initial: false })),
};
const LINES = ['f(x := level);', 'IF f.y > 10.0 THEN', '  Alarm := a[i] = 2; (* or', '  later *) t();', 'END_IF;'];
const SHEETS = [
  {
    name: 'Mixer', kind: 'PROGRAM', language: 'ST',
    variables: [
      { name: 'level', type: 'INT', section: 'VAR' }, { name: 'f', type: 'Filter', section: 'VAR' }, { name: 'a', type: 'ARRAY', section: 'VAR' },
      { name: 'i', type: 'INT', section: 'VAR' }, { name: 't', type: 'TON', section: 'VAR' }, { name: 'temp', type: 'INT', section: 'VAR_TEMP' },
      { name: 'Alarm', type: 'BOOL', section: 'VAR_EXTERNAL' },
    ],
    blocks: [{ kind: 'text', first: 20, lines: LINES }],
    uses: [
      ['f', 'call', 0, 1, 1, 1], ['level', 'read', 0, 1, 8, 5], ['f.y', 'read', 0, 2, 4, 3], ['Alarm', 'write', 0, 3, 3, 5],
      ['a', 'read', 0, 3, 12, 1], ['i', 'read', 0, 3, 14, 1], ['t', 'call', 0, 4, 12, 1],
    ],
  },
  {
    name: 'Filter', kind: 'FUNCTION_BLOCK', language: 'ST',
    variables: [{ name: 'x', section: 'VAR_INPUT', type: 'REAL' }, { name: 'y', section: 'VAR_OUTPUT', type: 'REAL' }],
    blocks: [{ kind: 'text', first: 5, lines: ['y := y + 0.1 * (x - y);'] }],
    uses: [['y', 'write', 0, 1, 1, 1], ['y', 'read', 0, 1, 6, 1], ['x', 'read', 0, 1, 17, 1]],
  },
  { name: '', kind: 'VAR_GLOBAL', language: 'ST', variables: [{ name: 'Alarm', type: 'BOOL', section: 'VAR_GLOBAL' }], blocks: [], uses: [] },
];
const ANSWER = {
  digest: 'd', state: 'complete', document: { version: 1, sheets: SHEETS },
  instances: [{ path: 'Main', pou: 'Mixer' }, { path: 'Main.f', pou: 'FILTER' }, { path: 'Second', pou: 'Mixer' }, { path: 'Main.t', pou: 'TON' }],
};
const sources = program.readSources(ANSWER);
const tags = new program.TagTable(MESSAGE);
const VALUES = [7, 12.5, 3, 1, 2, 9, 1, 0, 2];
const scopeOf = (sheet, instance) => new program.Scope(sources.sheets[sheet], instance, tags);
const liveOf = (scope) => (path) => scope.live(path, VALUES, new Set([1]));

test('Document_WhenItHasAnyShape_ThenWhatIsWrongIsLeftOut', () => {
  for (const wrong of [null, 5, 'x', [], {}, { document: [] }, { document: { sheets: {} } }, { document: { sheets: [null, 3, { blocks: 'x', uses: [[]], variables: [1] }] } }]) {
    const read = program.readSources(wrong);
    assert.equal(read.state, 'damaged');
    for (const sheet of read.sheets) assert.deepEqual([sheet.blocks, sheet.uses, sheet.variables], [[], [], []]);
  }
  const odd = program.readSources({ state: 'complete', document: { sheets: [{ blocks: [{ kind: 'rung', condition: { kind: 'all', of: [1, { kind: '?' }] }, coils: [{ kind: 'huge' }] }, 7], uses: [['x', 'read', 9, 1, 1, 1], ['y', '?', 0]] }] } });
  const [{ blocks, uses }] = odd.sheets;
  assert.deepEqual(blocks.map(({ kind }) => kind), ['rung', 'unknown']);
  assert.equal(blocks[0].coils[0].kind, 'normal');
  assert.equal(blocks[0].condition.of.length, 2);
  assert.deepEqual(uses.map(({ path, access }) => [path, access]), [['y', 'read']]);
});

test('Scope_WhenNamesAreResolved_ThenTheyAreTagsOfTheInstance', () => {
  const main = scopeOf(0, 'Main');
  assert.equal(main.resolve('level'), 'Main.level');
  assert.equal(main.resolve('LEVEL'), 'Main.LEVEL');
  assert.equal(main.resolve('Alarm'), 'Alarm');
  assert.equal(main.resolve('temp'), '');
  assert.equal(main.resolve('%QX0.1'), 'Alarm');
  const live = liveOf(main);
  assert.deepEqual(live('LEVEL'), { value: 7, type: 'INT' });
  assert.deepEqual(live('temp'), { value: null, type: '' });
  assert.deepEqual([live('S1.X').value, live('s2.x').value, live('S3.X').type], [0, 1, '']);
  assert.equal(liveOf(scopeOf(0, 'Second'))('level').value, 9);
  assert.equal(liveOf(scopeOf(1, 'Main.f'))('y').value, 12.5);
  assert.deepEqual(program.instancesOf(sources.sheets[0], sources.instances), ['Main', 'Second']);
  assert.deepEqual(program.homeOf('main.F.y', sources), { sheet: 1, instance: 'Main.f' });
});

test('Live_WhenTheAnswerHasAnyShape_ThenWhatIsWrongIsNotKnown', () => {
  for (const wrong of [null, 5, [], {}, { blocks: [], tags: 'x', steps: 7, scan: 'y' }, { blocks: { 0: null } }]) {
    const live = program.readLive(wrong);
    assert.deepEqual([live.digest, live.scan, live.steps.size, live.tags.length], ['', 0, 0, 0]);
  }
  const live = program.readLive({
    digest: 'd', scan: 12, steps: [1, 'x'], tags: { 3: 1.5, 4: 'text', 5: null },
    blocks: {
      0: { ran: true, power: '1', nodes: '110?00x', coils: '10' },
      1: { ran: false },
      2: { tested: [[2, true], [5, false], 7], indexed: [[3, 12, 'a[2]'], []] },
      3: { wires: { '0 ': [7, 'INT'], '1 OUT': null } },
    },
  });
  assert.deepEqual([live.digest, live.scan, [...live.steps], live.tags[3], live.tags[4], live.tags[5]], ['d', 12, [1], 1.5, 'text', null]);
  assert.deepEqual(live.rungs.get(0), { ran: true, power: 'on', coils: [true, false], nodes: [{ in: 'on', out: 'on', closed: false }, { in: 'open', out: 'off', closed: false }] });
  assert.deepEqual(live.rungs.get(1), { ran: false, power: 'open', nodes: [], coils: [] });
  assert.deepEqual([live.bodies.get(2).tested.get(2), live.bodies.get(2).tested.get(5), live.bodies.get(2).tested.get(1)], [true, false, undefined]);
  assert.equal(live.bodies.get(2).indexed.get(program.placeKey(3, 12)), 'a[2]');
  assert.deepEqual([live.diagrams.get(3).get(program.wireKey(0, '')), live.diagrams.get(3).get(program.wireKey(1, 'out'))], [{ value: 7, type: 'INT' }, null]);
});

test('Live_WhenAConditionHasParts_ThenTheyComeInTheOrderOfTheFlow', () => {
  const condition = { kind: 'all', of: [{ kind: 'any', of: [contact('a'), contact('b')] }, contact('c')] };
  assert.deepEqual(program.partsOf(condition).map((part) => part.name ?? part.kind), ['all', 'any', 'a', 'b', 'c']);
});

test('Lines_WhenTheyNameVariables_ThenTheirValuesStandBesideThem', () => {
  const live = liveOf(scopeOf(0, 'Main'));
  const usesOf = (line) => sources.sheets[0].uses.filter((use) => use.line === line);
  const body = { tested: new Map(), indexed: new Map([[program.placeKey(3, 12), 'a[2]']]) };
  const values = (line) =>
    program.lineValues(usesOf(line), live, (path) => (path === 'f' ? ['y'] : ['Q']), body).map(({ name, live: { value } }) => [name, value]);
  assert.deepEqual(values(1), [['f.y', 12.5], ['level', 7]]);
  assert.deepEqual(values(3), [['Alarm', 1], ['a[2]', 2], ['i', 2]]);
  assert.deepEqual(values(4), [['t.Q', 0]]);
  const comments = program.commentRanges(LINES);
  const kinds = (line) => program.pieces(LINES[line - 1], usesOf(line), comments[line - 1]).map(({ text, kind }) => `${kind}:${text}`);
  assert.deepEqual(kinds(2), ['keyword:IF', 'plain: ', 'variable:f.y', 'plain: > ', 'literal:10.0', 'plain: ', 'keyword:THEN']);
  assert.deepEqual(kinds(3).at(-1), 'comment:(* or');
  assert.deepEqual(kinds(4).slice(0, 2), ['comment:  later *)', 'plain: ']);
  for (const line of LINES) {
    const text = program.pieces(line, usesOf(LINES.indexOf(line) + 1), []).map((piece) => piece.text).join('');
    assert.equal(text, line);
  }
});

test('Uses_WhenATagIsLookedFor_ThenEveryInstanceAndTheWholeOfItAreFound', () => {
  const found = (target) => program.crossReference(target, sources, tags).map(({ where, access }) => `${access} ${where}`);
  assert.deepEqual(found('Main.f.y'), [
    'call Mixer (Main), line 20', 'write Filter (Main.f), line 5', 'read Mixer (Main), line 21', 'read Filter (Main.f), line 5',
  ]);
  assert.deepEqual(found('second.LEVEL'), ['read Mixer (Second), line 20']);
  assert.deepEqual(found('Alarm'), ['write Mixer (Main), line 22', 'write Mixer (Second), line 22']);
  assert.deepEqual(found('nothing'), []);
  assert.ok(program.touches('Main.t', 'main.T.q') && !program.touches('Main.t', 'Main.total'));
  assert.deepEqual(program.declarationOf('Alarm', sources), { sheet: 2, instance: '', block: -1, line: 0 });
});

test('Search_WhenNamesAndTextsFit_ThenTheBestComeFirst', () => {
  const titles = (query) => program.search(query, sources, tags).map(({ kind, title }) => `${kind} ${title}`);
  assert.equal(titles('filter')[0], 'sheet Filter');
  assert.deepEqual(titles('%qx0.1'), ['variable Alarm']);
  assert.deepEqual(titles('later'), ['text later *) t();']);
  assert.deepEqual(titles('  '), []);
  assert.deepEqual(titles('nowhere'), []);
});

const contact = (name, more = {}) => ({ kind: 'contact', name, ...more });
const rungOf = (condition, more = {}) => ({ kind: 'rung', number: 1, condition, boxes: [], coils: [], ...more });
const readRungs = (rungs) => program.readSources({ state: 'complete', document: { sheets: [{ blocks: rungs }] } }).sheets[0].blocks;

test('Drawing_WhenALineEndsInAConnector_ThenItHasItsSymbolAndNoWireToTheRail', () => {
  const read = readRungs([rungOf(contact('x'), { coils: [{ kind: 'connector', name: '>1>' }] })]);
  const layout = program.layOutRung(read[0], () => [], 500);
  const symbol = layout.symbols.find(({ kind }) => kind === 'connector');
  assert.equal(symbol.name, '>1>');
  assert.ok(!layout.symbols.some(({ kind }) => kind === 'coil'));
  const ends = layout.wires.flatMap(({ points }) => points.split(' ').map((point) => Number(point.split(',')[0])));
  assert.ok(Math.max(...ends) <= symbol.x && symbol.x + symbol.width < layout.right);
});

test('Drawing_WhenALineBeginsWithAConnector_ThenItHasItsSymbolAndNoWireFromTheRail', () => {
  const condition = { kind: 'all', of: [{ kind: 'any', of: [{ kind: 'all', of: [contact('>1>'), contact('a')] }, contact('>2>'), contact('>1>', { negated: true })] }, contact('>1>')] };
  const read = readRungs([rungOf(condition), rungOf(contact('>1>'))]);
  const named = (layout, kind) => layout.symbols.filter((symbol) => symbol.kind === kind).map((symbol) => symbol.name ?? symbol.condition.name);
  const branches = program.layOutRung(read[0], () => [], 500);
  assert.deepEqual(named(branches, 'connector'), ['>1>', '>2>']);
  assert.deepEqual(named(branches, 'contact'), ['a', '>1>', '>1>']);
  const alone = program.layOutRung(read[1], () => [], 500);
  const [symbol] = alone.symbols.filter(({ kind }) => kind === 'connector');
  assert.equal(symbol.of, read[1].condition);
  const begins = alone.wires.flatMap(({ points }) => points.split(' ').map((point) => Number(point.split(',')[0])));
  assert.ok(Math.min(...begins) >= symbol.x + symbol.width);
  for (const { y, x } of branches.symbols.filter(({ kind }) => kind === 'connector'))
    assert.ok(!branches.wires.some(({ points }) => points.endsWith(` ${x},${y}`)));
});

test('Drawing_WhenRungsAreOfAnySize_ThenNothingSticksOut', () => {
  const wide = { kind: 'all', of: Array.from({ length: 40 }, (_, i) => contact(`a_rather_long_name_${i}`)) };
  const deep = { kind: 'any', of: [wide, { kind: 'all', of: [] }, { kind: 'test', text: 'x > 1' }, { kind: 'any', of: [contact('y'), contact('z', { negated: true })] }] };
  const box = { type: 'TON', instance: 'patience', power: 'IN', inputs: [['PT', 'T#5s']], outputs: [['Q', 'late'], ['ET', '']] };
  for (const rung of [rungOf(wide), rungOf(deep, { boxes: [box, { ...box, text: 'x := 1;' }], coils: [{ name: 'c' }, { kind: 'set', name: 'd' }, { kind: 'connector', name: '>12>' }], jump: 'END', return: true }), rungOf({ kind: 'true' })]) {
    const read = readRungs([rung]);
    const layout = program.layOutRung(read[0], () => ['Q', 'ET'], 500);
    assert.ok(layout.width >= 500);
    for (const symbol of layout.symbols) {
      assert.ok(symbol.x >= layout.left && symbol.x + symbol.width <= layout.right + 1, JSON.stringify(symbol));
      assert.ok(symbol.y >= 0 && symbol.y <= layout.height);
    }
    for (const wire of layout.wires)
      for (const point of wire.points.split(' ')) {
        const [x, y] = point.split(',').map(Number);
        assert.ok(x >= layout.left && x <= layout.right && y >= 0 && y <= layout.height, wire.points);
      }
  }
});

const drawn = (elements) => program.readSources({ state: 'complete', document: { sheets: [{ blocks: [{ kind: 'diagram', elements }] }] } }).sheets[0].blocks[0];
const variableAt = (kind, name, y, inputs = []) => ({ kind, name, at: [10, y], size: [40, 20], inputs });
const pin = (name, from, output = '', more = {}) => ({ name, connections: from === undefined ? [] : [{ from, output, path: [] }], ...more });

test('Diagram_WhenTheFileSaysAnythingAboutPlaces_ThenAllIsOnThePicture', () => {
  const elements = [
    variableAt('inVariable', 'a_name_that_is_much_longer_than_its_box', -50),
    { kind: 'block', name: 'LIMIT', at: [-200, 1e9], size: [0, -5], inputs: [pin('MN', 0, '', { at: [0, 9e5] }), pin('IN', 7), pin('MX', 1)], outputs: [{ name: 'OUT', at: ['x', 1] }] },
    { kind: 'outVariable', name: 'o', at: 'nowhere', inputs: [pin('', 1, 'OUT')] },
    5,
  ];
  const layout = program.layOutDiagram(drawn(elements));
  assert.equal(layout.elements.length, 4);
  for (const { x, y, width, height } of layout.elements) assert.ok(x >= 0 && y >= 0 && x + width <= layout.width && y + height <= layout.height);
  for (const wire of layout.wires) for (const number of wire.points.split(/[ ,]/)) assert.ok(Number.isFinite(Number(number)), wire.points);
});
