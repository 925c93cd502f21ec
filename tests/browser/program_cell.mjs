// A cell without a plant that runs a program in all languages: runtime, link and the page's server as real processes, in a
// folder of its own.

import { execFileSync, spawn } from 'node:child_process';
import { existsSync, mkdtempSync, openSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { freePort } from './demo_process.mjs';
import { DRAWN, TEXT } from './program_sources.mjs';
import { until } from './support.mjs';

const configuration = (port) => `
[cell]
name = "program-${process.pid}"
state_dir = "state"
[clock]
mode = "real"
[plant]
kind = "none"
[dds]
domain_id = 68
[hmi]
port = ${port}
anonymous = "viewer"
`;

export async function startProgramCell(program) {
  const folder = mkdtempSync(join(tmpdir(), 'hmi-program-'));
  const config = join(folder, 'cell.toml');
  const port = await freePort();
  writeFileSync(config, configuration(port));
  writeFileSync(join(folder, 'main.st'), TEXT);
  writeFileSync(join(folder, 'logic.xml'), DRAWN);
  const children = new Map();
  process.on('exit', () => children.forEach((child) => child.kill('SIGKILL')));

  const log = (name) => join(folder, `${name}.log`);
  const read = (name) => (existsSync(log(name)) ? readFileSync(log(name), 'utf8') : '');
  const start = (name) => {
    const file = openSync(log(name), 'a');
    const child = spawn(program, [name, '--config', config], { stdio: ['ignore', file, file] });
    children.set(name, child);
    child.once('exit', () => children.delete(name));
  };
  const stop = async (name) => {
    const child = children.get(name);
    if (!child) return;
    const ended = new Promise((resolve) => child.once('exit', resolve));
    child.kill('SIGTERM');
    await ended;
  };
  const run = (...given) => execFileSync(program, given, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
  const self = {
    url: `http://127.0.0.1:${port}/`,
    // Compiles and loads the program, with further options of the compiler.
    load: (...options) => {
      run('compile', join(folder, 'main.st'), join(folder, 'logic.xml'), '-o', join(folder, 'main.swb'), ...options);
      run('download', '--config', config, join(folder, 'main.swb'), '--replace');
      run('start', '--config', config, '--cold');
    },
    force: (name, value) => run('force', '--config', config, name, value),
    logs: () => ['runtime', 'link', 'hmi'].map((name) => `--- ${name}\n${read(name)}`).join(''),
    end: async () => {
      for (const name of ['hmi', 'link', 'runtime']) await stop(name);
      rmSync(folder, { recursive: true, force: true });
    },
  };
  try {
    start('runtime');
    await until('the runtime listens', () => read('runtime').includes('listens on'));
    self.load();
    start('link');
    start('hmi');
    await until('the page is served', () => fetch(self.url).then((response) => response.ok, () => false));
    return self;
  } catch (error) {
    console.error(self.logs());
    await self.end();
    throw error;
  }
}
