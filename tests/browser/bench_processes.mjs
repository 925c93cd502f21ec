// The tank bench as four processes that nobody starts again by himself: runtime, link, supervisor and the page's server,
// with history, in a folder of their own.

import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { freePort } from './demo_process.mjs';
import { keepProcesses } from './processes.mjs';
import { until } from './support.mjs';

const SPEED = 5; // times real time: a run lasts while somebody kills what belongs to it

export async function startBench(program, config) {
  const folder = mkdtempSync(join(tmpdir(), 'hmi-bench-'));
  const port = await freePort();
  const settings = [`cell.name="bench-${process.pid}"`, `cell.state_dir="${folder}"`, `clock.speed=${SPEED}`,
    `hmi.port=${port}`, 'hmi.anonymous="viewer"', `history.folder="${join(folder, 'history')}"`];
  const processes = keepProcesses(program, folder);
  const start = (name) => processes.start(name, [name, '--config', config, ...settings.flatMap((one) => ['--set', one])]);
  const self = {
    url: `http://127.0.0.1:${port}/`,
    trail: join(folder, 'access', 'audit.jsonl'),
    start,
    kill: (name) => processes.end(name, 'SIGKILL'),
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
    for (const name of ['runtime', 'link', 'hmi', 'supervisor']) start(name);
    await until('the page is served', () => fetch(self.url).then((response) => response.ok, () => false));
    return self;
  } catch (error) {
    console.error(self.logs());
    await self.end();
    throw error;
  }
}
