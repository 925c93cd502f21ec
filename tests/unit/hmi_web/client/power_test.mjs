// The power that the page draws against what the engines do: a ladder program whose inputs change with every scan runs on both
// engines, and after each scan what the page computes for a coil is what the coil is.
//
//   node --test power_test.mjs, with CLIENT: the folder in which the client is built, STEPWRIGHT: the program

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';

import { load } from './load_modules.mjs';

const page = await load(process.env.CLIENT, ['program/document', 'program/power', 'program/scope', 'program/lines', 'program/expression']);

const SCANS = 400;
// Bits of a generator of random numbers, so that every combination of the inputs comes.
const DRIVER = `
PROGRAM Driver
  VAR_EXTERNAL a, b, c, d : BOOL; n : INT; END_VAR
  VAR seed : UDINT := 7; END_VAR
  seed := seed * 1664525 + 1013904223;
  a := (seed / 65536) MOD 2 = 1;
  b := (seed / 131072) MOD 2 = 1;
  c := (seed / 262144) MOD 2 = 1;
  d := (seed / 524288) MOD 4 = 1;
  n := UDINT_TO_INT((seed / 1048576) MOD 20);
END_PROGRAM
CONFIGURATION Plant
  VAR_GLOBAL a, b, c, d : BOOL; n : INT; END_VAR
  RESOURCE Cpu ON Any
    TASK Cycle(INTERVAL := T#10ms, PRIORITY := 1);
    PROGRAM First WITH Cycle : Driver;
    PROGRAM Rungs WITH Cycle : Ladder;
  END_RESOURCE
END_CONFIGURATION
`;

const at = (element, id, x, y, inside, attributes = '') => `<${element} localId="${id}"${attributes}><position x="${x}" y="${y}"/>${inside}</${element}>`;
const from = (ids) =>
  `<connectionPointIn>${ids.map((one) => `<connection refLocalId="${String(one).split(':')[0]}"${String(one).includes(':') ? ` formalParameter="${one.split(':')[1]}"` : ''}/>`).join('')}</connectionPointIn>`;
const rail = (id, y) => at('leftPowerRail', id, 0, y, '<connectionPointOut formalParameter=""/>');
const symbol = (kind) => (id, x, y, source, name, more = '') => at(kind, id, x, y, `${from(source)}<connectionPointOut/><variable>${name}</variable>`, more);
const contact = symbol('contact');
const coil = symbol('coil');
const input = (id, x, y, text) => at('inVariable', id, x, y, `<connectionPointOut/><expression>${text}</expression>`);
const block = (id, x, y, type, inputs, output, instance = '') =>
  at('block', id, x, y, `<inputVariables>${inputs.map(([pin, source]) => `<variable formalParameter="${pin}">${from([source])}</variable>`).join('')}</inputVariables><inOutVariables/><outputVariables><variable formalParameter="${output}"><connectionPointOut/></variable></outputVariables>`, ` typeName="${type}"${instance && ` instanceName="${instance}"`}`);
const LOCALS = ['o1', 'o2', 'o3', 'o4', 'o5', 'o6', 'latch', 'risen', 'fell'];
const variable = (name, type) => `<variable name="${name}"><type>${type === 'TON' ? '<derived name="TON"/>' : `<${type}/>`}</type></variable>`;
const LADDER = `<?xml version="1.0" encoding="utf-8"?>
<project xmlns="http://www.plcopen.org/xml/tc6_0201" xmlns:xhtml="http://www.w3.org/1999/xhtml">
<fileHeader companyName="t" productName="t" productVersion="1" creationDateTime="2026-11-22T13:00:00"/>
<contentHeader name="logic"><coordinateInfo><fbd><scaling x="0" y="0"/></fbd><ld><scaling x="0" y="0"/></ld><sfc><scaling x="0" y="0"/></sfc></coordinateInfo></contentHeader>
<types><dataTypes/><pous><pou name="Ladder" pouType="program"><interface>
<localVars>${LOCALS.map((name) => variable(name, 'BOOL')).join('')}${variable('wait', 'TON')}</localVars>
<externalVars>${['a', 'b', 'c', 'd'].map((name) => variable(name, 'BOOL')).join('')}${variable('n', 'INT')}</externalVars></interface><body><LD>
${rail(1, 0)}${contact(2, 40, 0, [1], 'a')}${contact(3, 40, 30, [1], 'latch')}${contact(4, 90, 0, [2, 3], 'b', ' negated="true"')}${coil(5, 300, 0, [4], 'latch')}
${rail(10, 100)}${contact(11, 40, 100, [10], 'a')}${contact(12, 90, 100, [11], 'b')}${contact(13, 40, 130, [10], 'c', ' negated="true"')}${coil(14, 300, 100, [12, 13], 'o1')}${coil(15, 300, 130, [12, 13], 'o2', ' negated="true"')}
${rail(20, 200)}${contact(21, 40, 200, [20], 'a')}${contact(22, 90, 200, [21], 'c')}${coil(23, 300, 200, [22], 'o3')}${contact(24, 90, 240, [21], 'd')}${coil(25, 300, 240, [24], 'o4')}
${rail(30, 300)}${contact(31, 40, 300, [30], 'b')}${coil(32, 300, 300, [31], 'o5', ' storage="set"')}
${rail(33, 340)}${contact(34, 40, 340, [33], 'c')}${contact(35, 90, 340, [34], 'd')}${coil(36, 300, 340, [35], 'o5', ' storage="reset"')}
${rail(40, 400)}${contact(41, 40, 400, [40], 'a', ' edge="rising"')}${coil(42, 300, 400, [41], 'risen')}
${rail(43, 440)}${contact(44, 40, 440, [43], 'b', ' edge="falling"')}${contact(45, 90, 440, [44], 'c')}${coil(46, 300, 440, [45], 'fell')}
${rail(50, 500)}${contact(51, 40, 500, [50], 'a')}${block(52, 90, 500, 'TON', [['IN', 51], ['PT', 53]], 'Q', 'wait')}${input(53, 40, 530, 'T#15ms')}${input(54, 150, 600, 'n')}${input(55, 150, 640, '9')}${block(56, 200, 600, 'GT', [['IN1', 54], ['IN2', 55]], 'OUT')}${coil(57, 300, 500, ['52:Q', '56:OUT'], 'o6')}
</LD></body></pou></pous></types><instances><configurations/></instances></project>`;

// The section Document: the twenty-first entry of the table.
function documentOf(container) {
  assert.equal(container.readUInt16LE(6), 21);
  const entry = 24 + 20 * 16;
  const offset = container.readUInt32LE(entry + 4);
  return JSON.parse(container.toString('utf8', offset, offset + container.readUInt32LE(entry + 8)));
}

const NAMES = [...['a', 'b', 'c', 'd', 'n'], ...LOCALS.map((name) => `Rungs.${name}`), 'Rungs.wait.Q', 'Rungs.wait.ET'];

function run(folder, engine) {
  const json = join(folder, `${engine}.json`);
  execFileSync(process.env.STEPWRIGHT, ['exec', join(folder, 'all.swb'), '--scans', SCANS, '--engine', engine, '--trace', NAMES.join(','), '--json', json]);
  return JSON.parse(readFileSync(json, 'utf8')).trace;
}

const folder = mkdtempSync(join(tmpdir(), 'hmi-power-'));
process.on('exit', () => rmSync(folder, { recursive: true, force: true }));
writeFileSync(join(folder, 'driver.st'), DRIVER);
writeFileSync(join(folder, 'ladder.xml'), LADDER);
execFileSync(process.env.STEPWRIGHT, ['compile', join(folder, 'driver.st'), join(folder, 'ladder.xml'), '-o', join(folder, 'all.swb')]);
const sources = page.readSources({ digest: '', state: 'complete', document: documentOf(readFileSync(join(folder, 'all.swb'))), instances: [{ path: 'Rungs', pou: 'Ladder' }] });
const sheet = sources.sheets.find(({ name }) => name === 'Ladder');
const typeOf = (name) => (name === 'n' ? 'INT' : name.endsWith('.ET') ? 'TIME' : 'BOOL');
const tags = new page.TagTable({ charts: [], steps: [], tags: NAMES.map((name) => ({ name, type: typeOf(name), address: '' })) });

for (const engine of ['vm', 'native']) {
  test(`Power_WhenTheLadderRunsOn_${engine}_ThenWhatIsDrawnIsWhatCoilsAre`, () => {
    const trace = run(folder, engine);
    const scope = new page.Scope(sheet, 'Rungs', tags);
    const rungs = sheet.blocks.filter(({ kind }) => kind === 'rung');
    const seen = new Map(); // coil -> how often it was known, and how often TRUE
    for (let scan = 0; scan < SCANS; ++scan) {
      const values = NAMES.map((name) => Number(trace[name][scan]));
      const lookup = page.lookupOf((path) => scope.live(path, values, new Set()));
      const flows = page.flowOf(rungs, lookup, (name) => scope.declares(name));
      rungs.forEach((rung, i) => {
        for (const one of rung.coils.filter(({ name }) => scope.declares(name))) {
          const expected = page.driven(one, flows[i].power);
          const key = `${one.kind} ${one.name}`;
          const count = seen.get(key) ?? { known: 0, on: 0 };
          // What sets may be reset by a later network.
          if (expected !== null && one.kind !== 'set') {
            assert.equal(values[NAMES.indexOf(`Rungs.${one.name}`)], expected.value, `${key} in scan ${scan}`);
          }
          seen.set(key, { known: count.known + Number(expected !== null), on: count.on + Number(expected?.value === 1) });
        }
      });
    }
    for (const name of ['o1', 'o3', 'o4', 'o6', 'latch']) {
      const { known, on } = seen.get(`normal ${name}`);
      assert.equal(known, SCANS, `${name} is always known`);
      assert.ok(on > 0 && on < SCANS, `${name} is TRUE in some scans: ${on}`);
    }
    assert.equal(seen.get('negated o2').known, SCANS);
    for (const name of ['risen', 'fell']) {
      const { known, on } = seen.get(`normal ${name}`);
      assert.ok(known > 0 && known < SCANS && on === 0, `an edge is known to be away, never to be there: ${name}`);
    }
    assert.ok(seen.get('set o5').on > 0 && seen.get('reset o5').known > 0);
  });
}
