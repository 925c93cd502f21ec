// From a command to live values in a browser: `stepwright up` in a folder that `stepwright new` has just written, and beside it a
// bare server of Node whose page shows one value, which no cell stands behind.

import { execFileSync, spawn } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';

import { freePort } from '../../browser/demo_process.mjs';
import { eventually } from '../../browser/support.mjs';

// The level of the model's tank, which changes all the time, in the overview with which such a cell's page opens.
const LEVEL = '[data-testid=tag-groups] div:has(> dt[title="Main.level"]) dd';
const BARE = join(dirname(fileURLToPath(import.meta.url)), 'bare_server.mjs');

const isServed = (url) => fetch(url).then((response) => response.ok, () => false);

// Seconds from `start` until the element that `selector` finds has a number.
async function secondsToValue(context, url, selector, start) {
  await eventually(`${url} is served`, () => isServed(url));
  const page = await context.newPage();
  await page.goto(url);
  const value = page.locator(selector).first();
  await eventually('the page shows a value', async () => /\d/.test((await value.count()) > 0 ? await value.innerText() : ''));
  const seconds = (performance.now() - start) / 1_000;
  await page.close();
  return seconds;
}

export async function upToPage(context, program) {
  const folder = mkdtempSync(join(tmpdir(), 'stepwright-bench-up-'));
  execFileSync(program, ['new', 'line'], { cwd: folder, stdio: 'pipe' });
  const port = await freePort();
  const start = performance.now();
  const up = spawn(program, ['up', '--port', String(port)], { cwd: join(folder, 'line'), stdio: ['ignore', 'pipe', 'pipe'] });
  let output = '';
  for (const stream of [up.stdout, up.stderr]) stream.on('data', (data) => (output += data));
  let code = null;
  const ended = new Promise((resolve) => up.once('exit', (exit, signal) => resolve((code = exit ?? signal))));
  const failed = ended.then(() => Promise.reject(new Error(`stepwright up ended with ${code}: ${output}`)));
  failed.catch(() => {}); // it ends in any case
  try {
    return await Promise.race([secondsToValue(context, `http://127.0.0.1:${port}/`, LEVEL, start), failed]);
  } finally {
    up.kill('SIGTERM');
    await ended;
    rmSync(folder, { recursive: true, force: true });
  }
}

// What of it is the browser and the start of any process.
export async function bareToPage(context) {
  const start = performance.now();
  const server = spawn(process.execPath, [BARE], { stdio: ['pipe', 'pipe', 'inherit'] });
  const ended = new Promise((resolve) => server.once('exit', resolve));
  try {
    const url = await new Promise((resolve, reject) => {
      createInterface({ input: server.stdout }).once('line', resolve);
      server.once('exit', (code) => reject(new Error(`the bare server ended with ${code}`)));
    });
    return await secondsToValue(context, url, '#value', start);
  } finally {
    server.kill('SIGTERM');
    await ended;
  }
}
