// Runtime, link and HMI of a floor with vehicles, and a supervisor of the test's own that plans them, follows them and
// publishes how it goes (fleet_main.cpp). They begin to drive when they are told: fleet.tell('drive').

import { spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { createInterface } from 'node:readline';

import { freePort } from './demo_process.mjs';
import { PACED, until } from './support.mjs';

// Several tests run on one machine, and what one sends must not reach another.
const DOMAIN = 100 + (process.pid % 90);

export async function startFleet({ server, supervisor }, vehicles, speed) {
  const folder = mkdtempSync(join(tmpdir(), 'stepwright-fleet-'));
  const port = await freePort();
  const planner = spawn(supervisor, [vehicles, folder, DOMAIN, speed].map(String), {
    stdio: ['pipe', 'pipe', 'inherit'],
  });
  const children = [planner];
  const end = async () => {
    const ended = children.map((child) => new Promise((resolve) => (child.exitCode ?? child.signalCode) !== null ? resolve() : child.once('exit', resolve)));
    planner.stdin.end();
    for (const child of children.slice(1)) child.kill('SIGTERM');
    await Promise.all(ended);
  };
  process.on('exit', () => children.forEach((child) => child.kill('SIGKILL')));
  await new Promise((resolve, reject) => {
    createInterface({ input: planner.stdout }).once('line', resolve);
    planner.once('exit', (code) => reject(new Error(`the planner ended with ${code}`)));
  });
  for (const name of ['runtime', 'link', 'hmi']) {
    const more = name === 'hmi' ? ['--port', String(port), '--set', 'hmi.anonymous=viewer', ...PACED] : [];
    const settings = ['--config', join(folder, 'cell.toml'), '--set', `cell.state_dir=${join(folder, 'state')}`];
    children.push(spawn(join(dirname(server), `stepwright-${name}`), [name, ...settings, ...more], { stdio: ['ignore', 'ignore', 'inherit'] }));
  }
  const url = `http://127.0.0.1:${port}/`;
  await until('the HMI serves its page', () => fetch(url).then((response) => response.ok, () => false));
  return {
    url,
    tell: (line) => planner.stdin.write(`${line}\n`),
    end,
    logs: () => readdirSync(folder).map((file) => (file.endsWith('.toml') ? readFileSync(join(folder, file), 'utf8') : file)).join('\n'),
    forget: () => rmSync(folder, { recursive: true, force: true }),
  };
}
