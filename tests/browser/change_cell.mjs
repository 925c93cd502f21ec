// A bottle line without a plant whose program is changed: runtime, link and the page's server as real processes, in a folder of
// its own, and the programs that come after the first.

import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { freePort } from './demo_process.mjs';
import { keepProcesses } from './processes.mjs';
import { until } from './support.mjs';

const FIRST = `
PROGRAM Bottles
  VAR_EXTERNAL
    Count : DINT;
    Lamp : BOOL;
  END_VAR
  VAR
    limit : INT := 20;
    speed : INT := 3;
    ready : BOOL;
    label : STRING[20] := 'line 1';
  END_VAR
  (* one bottle a scan *)
  Count := Count + 1;
  ready := speed > 0;
  IF ready THEN
    Lamp := Count MOD 2 = 0;
  END_IF;
END_PROGRAM

PROGRAM Filler
  VAR
    fill : BOOL;
    go : BOOL;
  END_VAR
  INITIAL_STEP Waiting:
  END_STEP
  STEP Filling:
    fill(N);
  END_STEP
  TRANSITION begins FROM Waiting TO Filling := go;
  END_TRANSITION
  TRANSITION ends FROM Filling TO Waiting := NOT go;
  END_TRANSITION
END_PROGRAM

CONFIGURATION Plant
  VAR_GLOBAL
    Count : DINT;
    Lamp AT %QX0.0 : BOOL;
  END_VAR
  RESOURCE Cpu ON Any
    TASK Cycle(INTERVAL := T#10ms, PRIORITY := 1);
    PROGRAM Main WITH Cycle : Bottles;
    PROGRAM Station WITH Cycle : Filler;
  END_RESOURCE
END_CONFIGURATION
`;

// Another type, a new and a lost variable, other lines, a step more.
const SECOND = FIRST.replace('speed : INT := 3;', 'speed : DINT := 4;')
  .replace('    label : STRING[20] := \'line 1\';\n', '    rejected : UINT;\n')
  .replace('Count MOD 2 = 0', 'Count MOD 3 = 0')
  .replace('  STEP Filling:', '  STEP Draining:\n  END_STEP\n  STEP Filling:')
  .replace('TO Waiting := NOT go;', 'TO Draining := NOT go;')
  .replace('END_PROGRAM\n\nCONFIGURATION', '  TRANSITION drained FROM Draining TO Waiting := TRUE;\n  END_TRANSITION\nEND_PROGRAM\n\nCONFIGURATION');

export const PROGRAMS = {
  first: FIRST,
  second: SECOND,
  // Ten scans of it can be seen.
  slow: SECOND.replace('INTERVAL := T#10ms', 'INTERVAL := T#300ms'),
  // Divides by zero in its fourth scan.
  trapping: FIRST.replace('limit : INT := 20;', 'limit : INT := 20;\n    scans : INT;\n    zero : INT;').replace(
    '  Count := Count + 1;',
    '  Count := Count + 1;\n  scans := scans + 1;\n  IF scans > 3 THEN\n    limit := limit / zero;\n  END_IF;',
  ),
  // Without the step that is active while the station fills.
  stepless: FIRST.replace(/Filling/g, 'Pouring'),
  // The lamp's output at another terminal.
  moved: FIRST.replace('%QX0.0', '%QX0.3'),
  wrong: FIRST.replace('ready := speed > 0;', 'ready := speeed > 0;').replace('go : BOOL;', 'go : BOOOL;'),
};

const configuration = (port) => `
[cell]
name = "bottles-${process.pid}"
state_dir = "state"
[clock]
mode = "real"
[plant]
kind = "none"
[dds]
domain_id = 84
[hmi]
port = ${port}
anonymous = "viewer"
`;

export async function startBottles(program) {
  const folder = mkdtempSync(join(tmpdir(), 'hmi-change-'));
  const config = join(folder, 'cell.toml');
  const port = await freePort();
  writeFileSync(config, configuration(port));
  const file = (name) => join(folder, name);
  const processes = keepProcesses(program, folder);
  const start = (name) => processes.start(name, [name, '--config', config]);
  const run = (...words) => execFileSync(program, words, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
  const self = {
    url: `http://127.0.0.1:${port}/`,
    versions: join(folder, 'state', 'programs'),
    trail: join(folder, 'state', 'access', 'audit.jsonl'),
    file,
    stop: processes.end,
    // Compiled as `name`.swb, with further options of the compiler.
    compile: (name, ...options) => run('compile', file(`${name}.st`), '-o', file(`${name}.swb`), ...options),
    // Brought with the tool, past the server.
    change: (name) => run('download', '--config', config, file(`${name}.swb`), '--change'),
    force: (name, value) => run('force', '--config', config, name, value),
    serve: async () => {
      start('hmi');
      await until('the page is served', () => fetch(self.url).then((response) => response.ok, () => false));
    },
    setupToken: async () => {
      await until('the set-up token is on standard error', () => /set-up token [A-Z2-9-]{24}/.test(processes.read('hmi')));
      return /set-up token ([A-Z2-9-]{24})/.exec(processes.read('hmi'))[1];
    },
    logs: processes.logs,
    end: async () => {
      await processes.endAll();
      rmSync(folder, { recursive: true, force: true });
    },
  };
  try {
    for (const [name, text] of Object.entries(PROGRAMS)) writeFileSync(file(`${name}.st`), text);
    start('runtime');
    await until('the runtime listens', () => processes.read('runtime').includes('listens on'));
    self.compile('first');
    run('download', '--config', config, file('first.swb'), '--replace');
    run('start', '--config', config, '--cold');
    start('link');
    await self.serve();
    return self;
  } catch (error) {
    console.error(self.logs());
    await self.end();
    throw error;
  }
}
