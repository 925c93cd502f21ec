// A cell in a folder of its own, whose commands are processes that nobody starts again by himself.

import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';

import { freePort } from './demo_process.mjs';
import { keepProcesses } from './processes.mjs';
import { PACED, until } from './support.mjs';

// `optionsOf`: what each command is told after its name, of the folder and the port of the page.
export async function cellInFolder(program, name, optionsOf) {
  const folder = mkdtempSync(join(tmpdir(), `hmi-${name}-`));
  const port = await freePort();
  const options = optionsOf(folder, port);
  const processes = keepProcesses(program, folder);
  const url = `http://127.0.0.1:${port}/`;
  const self = {
    url,
    folder,
    file: (one) => join(folder, one),
    start: (command) => processes.start(command, [command, ...options, ...PACED]),
    stop: processes.end,
    pid: processes.pid,
    logs: processes.logs,
    run: (...words) => execFileSync(program, words, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] }),
    // Says so once for each time that it was started: its log goes on.
    startRuntime: async () => {
      const said = () => processes.read('runtime').split('listens on').length;
      const before = said();
      self.start('runtime');
      await until('the runtime listens', () => said() > before);
    },
    pageIsServed: () => until('the page is served', () => fetch(url).then((response) => response.ok, () => false)),
    serve: async () => {
      self.start('hmi');
      await self.pageIsServed();
    },
    setupToken: async () => {
      await until('the set-up token is on standard error', () => /set-up token [A-Z2-9-]{24}/.test(processes.read('hmi')));
      return /set-up token ([A-Z2-9-]{24})/.exec(processes.read('hmi'))[1];
    },
    // The cell, once all of it runs; what its processes wrote, if it does not.
    begins: async (deeds) => {
      try {
        await deeds();
        return self;
      } catch (error) {
        console.error(processes.logs());
        await self.end();
        throw error;
      }
    },
    end: async () => {
      await processes.endAll();
      rmSync(folder, { recursive: true, force: true });
    },
  };
  return self;
}

// Text of a cell's file: `clock` and `plant` are lines of their tables, `more` of [hmi].
export const configurationOf = (name, domain, port, { clock = 'mode = "real"', plant = 'kind = "none"', more = '' } = {}) => `
[cell]
name = "${name}-${process.pid}"
state_dir = "state"
[clock]
${clock}
[plant]
${plant}
[dds]
domain_id = ${domain}
[hmi]
port = ${port}
anonymous = "viewer"
${more}`;

// A cell without a plant, in real time: runtime, link and the page's server; `files`: text by name, beside its configuration;
// `more`: lines of its [hmi]. It runs once `load` has given the runtime its program.
export async function cellWithFiles(program, name, { domain, files, more = '' }) {
  const cell = await cellInFolder(program, name, (folder, port) => {
    writeFileSync(join(folder, 'cell.toml'), configurationOf(name, domain, port, { more }));
    for (const [one, text] of Object.entries(files)) {
      mkdirSync(dirname(join(folder, one)), { recursive: true });
      writeFileSync(join(folder, one), text);
    }
    return ['--config', join(folder, 'cell.toml')];
  });
  const config = cell.file('cell.toml');
  return Object.assign(cell, {
    config,
    trail: cell.file('state/access/audit.jsonl'),
    force: (variable, value) => cell.run('force', '--config', config, variable, value),
    download: (container) => {
      cell.run('download', '--config', config, cell.file(container), '--replace');
      cell.run('start', '--config', config, '--cold');
    },
    runs: (load) =>
      cell.begins(async () => {
        await cell.startRuntime();
        load();
        cell.start('link');
        await cell.serve();
      }),
  });
}
