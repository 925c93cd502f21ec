// A whole demo under test: `stepwright demo` with all its processes, which are found by the state folder that
// each of them has on its command line.

import { spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import { createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { PACED, until } from './support.mjs';

export async function freePort() {
  const server = createServer();
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  const { port } = server.address();
  await new Promise((resolve) => server.close(resolve));
  return port;
}

// Command line of a process; empty for one that is gone or only waits to be reaped.
function commandLine(pid) {
  try {
    return readFileSync(`/proc/${pid}/cmdline`, 'utf8').split('\0').join(' ');
  } catch {
    return '';
  }
}

function processesWith(text) {
  return readdirSync('/proc')
    .filter((name) => /^\d+$/.test(name))
    .map((name) => ({ pid: Number(name), command: commandLine(name) }))
    .filter(({ command }) => command.includes(text));
}

// Starts `stepwright demo CELL` at `speed` times real time and waits until its page can be fetched.
export async function startDemo(program, speed, cell = 'bench', more = []) {
  const port = await freePort();
  const stateDir = mkdtempSync(join(tmpdir(), 'stepwright-chain-'));
  const demo = spawn(
    program,
    ['demo', cell, '--port', port, '--no-compare', '--set', `clock.speed=${speed}`, '--state-dir', stateDir, ...PACED, ...more].map(String),
    { stdio: ['ignore', 'pipe', 'inherit'] },
  );
  // Whatever ends the test ends the demo, and the demo's death ends its processes.
  process.on('exit', () => demo.kill('SIGKILL'));
  let output = '';
  demo.stdout.on('data', (data) => (output += data));
  let code = null;
  const ended = new Promise((resolve) => {
    demo.once('exit', (exit, signal) => resolve((code = exit ?? signal)));
    demo.once('error', (error) => resolve((code = error.message)));
  });
  const processes = () => processesWith(stateDir);
  const self = {
    url: `http://127.0.0.1:${port}/`,
    stateDir,
    output: () => output,
    processes,
    pidOf: (name) => processes().find(({ command }) => command.includes(`stepwright-${name} `))?.pid,
    end: () => {
      demo.kill('SIGTERM');
      return ended;
    },
    // What its processes wrote; for a failed test.
    logs: () =>
      readdirSync(stateDir)
        .filter((file) => file.endsWith('.log'))
        .map((file) => `--- ${file}\n${readFileSync(join(stateDir, file), 'utf8')}`)
        .reduce((all, one) => `${all}${one}`, `${output}\n`),
    forget: () => rmSync(stateDir, { recursive: true, force: true }),
  };
  await until('the demo serves its page', async () => {
    if (code !== null) throw new Error(`the demo ended with ${code}: ${output}`);
    return fetch(self.url).then((response) => response.ok, () => false);
  }).catch(async (error) => {
    await self.end();
    console.error(self.logs());
    self.forget();
    throw error;
  });
  return self;
}
