// The tank bench as four processes that nobody starts again by himself: runtime, link, supervisor and the page's server,
// with history, in a folder of their own.

import { join } from 'node:path';

import { cellInFolder } from './cell_folder.mjs';

const SPEED = 2; // times real time, once it is started: a run lasts while somebody kills what belongs to it

export async function startBench(program, config) {
  const cell = await cellInFolder(program, 'bench', (folder, port) => {
    const settings = [`cell.name="bench-${process.pid}"`, `cell.state_dir="${folder}"`, `clock.speed=${SPEED}`, 'executive.start="operator"',
      `hmi.port=${port}`, 'hmi.anonymous="viewer"', `history.folder="${join(folder, 'history')}"`];
    return ['--config', config, ...settings.flatMap((one) => ['--set', one])];
  });
  cell.trail = cell.file('access/audit.jsonl');
  return cell.begins(async () => {
    for (const name of ['runtime', 'link', 'hmi', 'supervisor']) cell.start(name);
    await cell.pageIsServed();
  });
}
