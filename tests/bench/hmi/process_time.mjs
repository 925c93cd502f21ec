// Processor time of a process, all threads together.

import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';

const TICKS_PER_S = Number(execFileSync('getconf', ['CLK_TCK'], { encoding: 'utf8' }));

function cpuSeconds(pid) {
  const stat = readFileSync(`/proc/${pid}/stat`, 'utf8');
  const fields = stat.slice(stat.lastIndexOf(')') + 2).split(' '); // the name may hold blanks
  return (Number(fields[11]) + Number(fields[12])) / TICKS_PER_S;
}

// Cores that the process keeps busy on average over the time given: 0.5 is half of one.
export async function coreShare(pid, seconds) {
  const begin = { cpu: cpuSeconds(pid), at: performance.now() };
  await new Promise((resolve) => setTimeout(resolve, seconds * 1_000));
  return (cpuSeconds(pid) - begin.cpu) / ((performance.now() - begin.at) / 1_000);
}
