// A mixer without a plant: runtime, link and the page's server as real processes, in a folder of its own.

import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { freePort } from './demo_process.mjs';
import { keepProcesses } from './processes.mjs';
import { until } from './support.mjs';

export const PROGRAM = `
PROGRAM Mixer
  VAR
    level : REAL := 12.5;
    batches : INT := 3;
    stir : BOOL := FALSE;
    soak : TIME := T#30s;
    soaking : TON;
    total : REAL;
    before : REAL := 12.5;
    batches_before : INT := 3;
    torn : DINT;
  END_VAR
  // Level and batches come and go together: a scan that sees only one of them new has seen half of a recipe.
  IF (level <> before) <> (batches <> batches_before) THEN
    torn := torn + 1;
  END_IF;
  before := level;
  batches_before := batches;
  soaking(IN := stir, PT := soak);
  total := level * INT_TO_REAL(batches);
END_PROGRAM
CONFIGURATION Plant
  RESOURCE Cpu ON Any
    TASK Cycle(INTERVAL := T#10ms, PRIORITY := 1);
    PROGRAM Main WITH Cycle : Mixer;
  END_RESOURCE
END_CONFIGURATION
`;

const RECIPES = `
[[tag]]
name = "Main.level"
type = "REAL"
min = 0
max = 100
unit = "%"
comment = "how full the mixer is to be"

[[tag]]
name = "Main.batches"
type = "INT"
min = 1
max = 20
comment = "batches in a row"

[[tag]]
name = "Main.stir"
type = "BOOL"
comment = "stirs while it soaks"

[[tag]]
name = "Main.soak"
type = "TIME"
min = 0
max = 600
comment = "before it is drained"
`;

const configuration = (port, more) => `
[cell]
name = "recipes-${process.pid}"
state_dir = "state"
[clock]
mode = "real"
[plant]
kind = "none"
[dds]
domain_id = 67
[hmi]
port = ${port}
anonymous = "viewer"
recipes = "recipes.toml"
${more}`;

// `files`: more of them beside the configuration, by name, or others in place of those above; `more`: lines of its [hmi].
export async function startMixer(program, files = {}, more = '') {
  const folder = mkdtempSync(join(tmpdir(), 'hmi-recipes-'));
  const config = join(folder, 'cell.toml');
  const port = await freePort();
  writeFileSync(config, configuration(port, more));
  const all = { 'recipes.toml': RECIPES, 'main.st': PROGRAM, ...files };
  for (const [name, text] of Object.entries(all)) writeFileSync(join(folder, name), text);
  const processes = keepProcesses(program, folder);
  const start = (name) => processes.start(name, [name, '--config', config]);
  const run = (...arguments_) => execFileSync(program, arguments_, { encoding: 'utf8' });
  const self = {
    url: `http://127.0.0.1:${port}/`,
    folder,
    config,
    // A runtime that was killed begins empty.
    startAgain: () => {
      start('runtime');
      self.begin();
    },
    begin: () => {
      run('download', '--config', config, join(folder, 'main.swb'), '--replace');
      run('start', '--config', config, '--cold');
    },
    recipes: join(folder, 'state', 'recipes'),
    trail: join(folder, 'state', 'access', 'audit.jsonl'),
    stop: processes.end,
    pid: processes.pid,
    run,
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
    start('runtime');
    await until('the runtime listens', () => processes.read('runtime').includes('listens on'));
    run('compile', join(folder, 'main.st'), '-o', join(folder, 'main.swb'));
    self.begin();
    start('link');
    await self.serve();
    return self;
  } catch (error) {
    console.error(self.logs());
    await self.end();
    throw error;
  }
}
