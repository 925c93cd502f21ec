// Commands of stepwright as processes of a test, each with a log in the test's folder. Whatever ends the test ends them.

import { spawn } from 'node:child_process';
import { existsSync, openSync, closeSync, readFileSync } from 'node:fs';
import { join } from 'node:path';

export function keepProcesses(program, folder) {
  const running = new Map(); // by name: { child, ended }
  const logs = new Set();
  const log = (name) => join(folder, `${name}.log`);
  process.on('exit', () => running.forEach(({ child }) => child.kill('SIGKILL')));
  const self = {
    // `words`: the command with its options. Started again, it goes on in its log.
    start: (name, words) => {
      logs.add(name);
      const file = openSync(log(name), 'a');
      const child = spawn(program, words, { stdio: ['ignore', file, file] });
      closeSync(file);
      const ended = new Promise((resolve) => child.once('exit', resolve));
      running.set(name, { child, ended });
      child.once('exit', () => {
        if (running.get(name)?.child === child) running.delete(name);
      });
    },
    pid: (name) => running.get(name).child.pid,
    read: (name) => (existsSync(log(name)) ? readFileSync(log(name), 'utf8') : ''),
    end: async (name, signal = 'SIGTERM') => {
      const one = running.get(name);
      if (one === undefined) return;
      one.child.kill(signal);
      await one.ended;
    },
    endAll: async () => {
      for (const name of [...running.keys()].reverse()) await self.end(name);
    },
    logs: () => [...logs].map((name) => `--- ${name}\n${self.read(name)}`).join(''),
  };
  return self;
}
