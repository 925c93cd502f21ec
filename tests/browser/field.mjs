// Two cells of our own as processes: one with Modbus devices, in real time, of which one is there and one is not, and one with a
// simulated plant.

import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { freePort } from './demo_process.mjs';
import { keepProcesses } from './processes.mjs';
import { until } from './support.mjs';

const DOMAIN = 77;

const PROGRAM = `
PROGRAM Main
  VAR sum : DINT; i : INT; level AT %IW1 : INT; pump AT %IW2 : INT; END_VAR
  FOR i := 1 TO 50 DO sum := sum + i; END_FOR;
END_PROGRAM
CONFIGURATION Plant
  RESOURCE Cpu ON Plc
    TASK Fast(INTERVAL := T#10ms, PRIORITY := 0);
    TASK Slow(INTERVAL := T#100ms, PRIORITY := 5);
    PROGRAM quick WITH Fast : Main;
    PROGRAM steady WITH Slow : Main;
  END_RESOURCE
END_CONFIGURATION
`;

// Starts both cells with their links, and the page of the first, which also follows the second and one that is nowhere.
// `page`: keys of its [hmi]; `more`: tables of its file.
export async function startField(program, device, { page = '', more = '' } = {}) {
  const folder = mkdtempSync(join(tmpdir(), 'stepwright-field-'));
  const names = { line: `line-${process.pid}`, press: `press-${process.pid}` };
  const port = await freePort();
  const dead = await freePort();
  const processes = keepProcesses(program, folder);
  const base = (name) => `[cell]\nname = "${name}"\nstate_dir = "${join(folder, name)}"\n[dds]\ndomain_id = ${DOMAIN}\nruntime_id = "${name}"\n[guard]\nenabled = false\n`;
  const tags = (place) => `[[modbus.device.group]]\nperiod_ms = 50\ntags = [{ name = "level${place}", address = "%IW${place}", input = 0 }]\n`;
  const texts = {
    [names.line]:
      `${base(names.line)}[clock]\nmode = "real"\n[watchdog]\ntime_us = 2_000_000\nsensitivity = 3\n[io]\nkind = "modbus"\n` +
      // A busy machine keeps the client from running for longer than plants allow.
      `[modbus.client]\nsilence_ms = 10_000\nholder_timeout_ms = 60_000\n` +
      `[hmi]\nport = ${port}\nanonymous = "viewer"\nrefresh_ms = 100\nmetrics_of = ["${names.press}", "ghost"]\n${page}${more}` +
      `[[modbus.device]]\nname = "levels"\nhost = "127.0.0.1"\nport = ${device.port}\non_loss = "hold"\n${tags(1)}` +
      `[[modbus.device]]\nname = "pumps"\nhost = "127.0.0.1"\nport = ${dead}\non_loss = "hold"\n${tags(2)}`,
    [names.press]: `${base(names.press)}[clock]\nspeed = 1\n`, // else it takes all of a processor
  };
  const config = (name) => join(folder, `${name}.toml`);
  for (const [name, text] of Object.entries(texts)) {
    mkdirSync(join(folder, name));
    writeFileSync(config(name), text);
  }
  const key = (name, what) => `${name}-${what}`;
  const start = (name, what) => processes.start(key(name, what), [what, '--config', config(name)]);
  const image = join(folder, 'program.swb');
  writeFileSync(join(folder, 'program.st'), PROGRAM);
  execFileSync(program, ['compile', join(folder, 'program.st'), '-o', image]);
  start(names.line, 'modbus-client');
  for (const name of Object.values(names)) {
    start(name, 'runtime');
    start(name, 'link');
  }
  start(names.line, 'hmi');
  const self = {
    url: `http://127.0.0.1:${port}/`,
    names,
    kill: (name, what) => processes.end(key(name, what), 'SIGKILL'),
    start,
    logs: processes.logs,
    end: async () => {
      await processes.endAll();
      rmSync(folder, { recursive: true, force: true });
      rmSync(`/dev/shm/stepwright-io-${names.line}`, { force: true });
    },
  };
  let told = ''; // by the command that failed last
  const done = (...words) => {
    try {
      execFileSync(program, words, { stdio: 'pipe' });
      return true;
    } catch (error) {
      told = String(error.stderr);
      return false;
    }
  };
  try {
    for (const name of Object.values(names)) {
      await until(`${name} takes its program`, () => done('download', '--config', config(name), image, '--replace'));
      await until(`${name} runs it`, () => done('start', '--config', config(name)));
    }
    await until('the page is served', () => fetch(self.url).then((response) => response.ok, () => false));
  } catch (error) {
    console.error(`${told}\n${self.logs()}`);
    await self.end();
    throw error;
  }
  return self;
}
