// The cell that is measured: runtime, link, Modbus client and the page's server as real processes, and a device whose one
// register the bench changes.

import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { freePort } from '../../browser/demo_process.mjs';
import { startDevice } from '../../browser/modbus_device.mjs';
import { keepProcesses } from '../../browser/processes.mjs';
import { eventually } from '../../browser/support.mjs';

const DOMAIN = 100 + (process.pid % 90);

// `many` variables that all change with each cycle of a task of 100 ms, beside the input that is watched.
function programText(many) {
  const names = Array.from({ length: many }, (_, i) => `v${i}`);
  return `
PROGRAM Fast
  VAR change AT %IW1 : INT; seen : INT; END_VAR
  seen := change;
END_PROGRAM
PROGRAM Many
  VAR ${names.map((name) => `${name} : DINT;`).join(' ')} idle : DINT; END_VAR
  ${names.map((name) => `${name} := ${name} + 1;`).join('\n  ')}
  idle := 0;
END_PROGRAM
CONFIGURATION Plant
  RESOURCE Cpu ON Plc
    TASK Quick(INTERVAL := T#10ms, PRIORITY := 0);
    TASK Tenth(INTERVAL := T#100ms, PRIORITY := 5);
    PROGRAM Watched WITH Quick : Fast;
    PROGRAM Counting WITH Tenth : Many;
  END_RESOURCE
END_CONFIGURATION
`;
}

const configuration = (name, folder, port, device) => `
[cell]
name = "${name}"
state_dir = "${folder}"
[clock]
mode = "real"
[dds]
domain_id = ${DOMAIN}
runtime_id = "${name}"
[guard]
enabled = false
[io]
kind = "modbus"
[modbus.client]
holder_timeout_ms = 60_000
[hmi]
port = ${port}
anonymous = "viewer"
[[modbus.device]]
name = "field"
host = "127.0.0.1"
port = ${device}
on_loss = "hold"
[[modbus.device.group]]
period_ms = 10
tags = [{ name = "change", address = "%IW1", input = 0 }]
`;

// `many`: how many tags change ten times a second; `screen`: an SVG that the page opens with.
export async function startCell(program, many, screen = '') {
  const folder = mkdtempSync(join(tmpdir(), 'stepwright-bench-hmi-'));
  const name = `bench-hmi-${process.pid}-${many}`;
  const port = await freePort();
  let register = 0;
  const device = await startDevice(() => register);
  const config = join(folder, 'cell.toml');
  mkdirSync(join(folder, 'state', 'screens'), { recursive: true });
  if (screen !== '') writeFileSync(join(folder, 'state', 'screens', 'Bench.svg'), screen);
  writeFileSync(config, configuration(name, join(folder, 'state'), port, device.port));
  writeFileSync(join(folder, 'program.st'), programText(many));
  const processes = keepProcesses(program, folder);
  const end = async () => {
    await processes.endAll();
    device.stop();
    rmSync(folder, { recursive: true, force: true });
    rmSync(`/dev/shm/stepwright-io-${name}`, { force: true });
  };
  const url = `http://127.0.0.1:${port}/`;
  const run = (...words) => execFileSync(program, words, { stdio: 'pipe' });
  const done = (...words) => {
    try {
      run(...words);
      return true;
    } catch {
      return false;
    }
  };
  try {
    run('compile', join(folder, 'program.st'), '-o', join(folder, 'program.swb'));
    for (const what of ['modbus-client', 'runtime', 'link', 'hmi']) processes.start(what, [what, '--config', config]);
    await eventually('the runtime takes the program', () => done('download', '--config', config, join(folder, 'program.swb'), '--replace'));
    await eventually('and runs it', () => done('start', '--config', config));
    await eventually('the page is served', () => fetch(url).then((response) => response.ok, () => false));
  } catch (error) {
    console.error(processes.logs());
    await end();
    throw error;
  }
  return {
    url,
    port,
    // The plant changes: what the device holds from now on.
    set: (value) => (register = value),
    serverPid: () => processes.pid('hmi'),
    end,
  };
}
