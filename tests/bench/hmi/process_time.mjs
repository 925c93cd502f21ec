// Processor time of a process, all threads together.

import { readdirSync, readFileSync } from 'node:fs';

// In ns, by the scheduler's own count: ticks of 10 ms are too coarse for a share of a hundredth in a second.
const threadTime = (pid, thread) => Number(readFileSync(`/proc/${pid}/task/${thread}/schedstat`, 'utf8').split(' ')[0]);

function threadTimes(pid) {
  const times = new Map();
  for (const thread of readdirSync(`/proc/${pid}/task`)) {
    try {
      times.set(thread, threadTime(pid, thread));
    } catch {
      // It has ended meanwhile.
    }
  }
  return times;
}

// Cores that the process keeps busy on average over the time given: 0.5 is half of one. Of a thread that ends meanwhile
// nothing is counted.
export async function coreShare(pid, seconds) {
  const [before, at] = [threadTimes(pid), performance.now()];
  await new Promise((resolve) => setTimeout(resolve, seconds * 1_000));
  let busy_ns = 0;
  for (const [thread, time] of threadTimes(pid)) busy_ns += time - (before.get(thread) ?? 0);
  return busy_ns / 1e6 / (performance.now() - at);
}
