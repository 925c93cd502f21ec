// bench_hmi: how fast the page shows what happens, and what that costs the server. See README.md.

import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { parseArgs } from 'node:util';

import { launchBrowser } from '../../browser/support.mjs';
import { servePage } from './baseline_page.mjs';
import { startCell } from './cell.mjs';
import { percentile, pixelTimes } from './pixels.mjs';
import { coreShare } from './process_time.mjs';
import { screenFrames, screenText, SYMBOLS } from './screen.mjs';
import { soak } from './soak.mjs';
import { bareToPage, upToPage } from './up.mjs';
import { openViewers } from './viewers.mjs';

const INPUT_TAG = '[aria-label="tag values"] tbody tr:first-child td:last-child'; // the only one with an address
const USAGE = `usage: scripts/bench hmi [--clients 50] [--changes 200] [--tags 5000] [--seconds 20] [--seed 1] [--no-historian] [--soak-minutes 0] [--json FILE]

  --clients        pages that look while the plant changes (one of them Chromium)
  --changes        changes of the plant whose way to the pixel is timed
  --tags           tags that change ten times a second while the server's processor time is taken
  --seconds        for how long that is
  --no-historian   leaves out bench_historian
  --soak-minutes   leaves a tab open for so long and looks at its heap (60 for the long mode)
`;

function wrongUsage(why) {
  process.stderr.write(`bench_hmi: ${why}\n${USAGE}`);
  process.exit(2);
}

function readOptions() {
  const text = { type: 'string' };
  const whole = { clients: [1, 120, 50], changes: [10, 8_000, 200], tags: [1, 20_000, 5_000], seconds: [1, 3_600, 20], seed: [0, 2 ** 31, 1], 'soak-minutes': [0, 6_000, 0] };
  const names = Object.fromEntries(Object.keys(whole).map((name) => [name, text]));
  let given;
  try {
    const flag = { type: 'boolean', default: false };
    given = parseArgs({ options: { ...names, json: text, 'no-historian': flag, help: flag, program: text, modules: text, chromium: text } }).values;
  } catch (error) {
    wrongUsage(error.message);
  }
  if (given.help) {
    process.stdout.write(USAGE);
    process.exit(0);
  }
  for (const [name, [least, most, usual]] of Object.entries(whole)) {
    const value = given[name] === undefined ? usual : Number(given[name]);
    if (!Number.isInteger(value) || value < least || value > most) wrongUsage(`--${name} is a whole number from ${least} to ${most}, not "${given[name]}"`);
    given[name] = value;
  }
  return given;
}

// A random source of our own, so that a run can be repeated: numbers from 0 to 1 (mulberry32).
function randomFrom(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

const given = readOptions();
const progress = (line) => process.stderr.write(`${line}\n`);
const browser = await launchBrowser(given, { reducedMotion: 'no-preference' });
const report = { clients: given.clients, changes: given.changes, tags: given.tags, seed: given.seed };

async function timePixels(name, url, selector, set) {
  progress(`${name}: ${given.changes} changes`);
  const times = await pixelTimes(browser.context, url, selector, set, given.changes, randomFrom(given.seed));
  report[`${name}_p50_ms`] = percentile(times, 0.5);
  report[`${name}_p99_ms`] = percentile(times, 0.99);
}

async function timeOurs() {
  const cell = await startCell(given.program, 1);
  try {
    const viewers = await openViewers(cell.port, given.clients - 1);
    report.core_share_idle = await coreShare(cell.serverPid(), 3);
    await timePixels('pixel', cell.url, INPUT_TAG, cell.set);
    viewers.check();
    viewers.close();
    report.first_load_kb = await firstLoad(cell.url);
  } finally {
    await cell.end();
  }
}

async function timeBaselines() {
  for (const kind of ['polling', 'pushed']) {
    const page = await servePage(kind);
    await timePixels(kind, page.url, '#value', page.set);
    page.close();
  }
}

// What a browser that has never been here fetches until the page stands, in kB as it travels (gzip).
async function firstLoad(url) {
  const page = await browser.context.newPage();
  const network = await page.context().newCDPSession(page);
  let bytes = 0;
  await network.send('Network.enable');
  await network.send('Network.setCacheDisabled', { cacheDisabled: true });
  network.on('Network.loadingFinished', ({ encodedDataLength }) => (bytes += encodedDataLength));
  await page.goto(url);
  await page.locator(INPUT_TAG).first().waitFor();
  await page.waitForLoadState('networkidle', { timeout: 30_000 }).catch(() => {}); // the live connection never rests
  await page.close();
  return bytes / 1_000;
}

// `tags`: what of them each client shows, all or none.
async function takeShare(clients, tags) {
  progress(`${given.tags} tags at 10 Hz, ${clients} ${clients === 1 ? 'client' : 'clients'} with ${tags}: ${given.seconds} s`);
  const cell = await startCell(given.program, given.tags);
  try {
    const viewers = await openViewers(cell.port, clients, tags);
    await coreShare(cell.serverPid(), 2);
    const before = viewers.bytes();
    const share = await coreShare(cell.serverPid(), given.seconds);
    viewers.check();
    const perViewer = (viewers.bytes() - before) / given.seconds / clients;
    if (tags === 'all' && perViewer < given.tags) throw new Error(`a viewer got ${perViewer.toFixed(0)} bytes a second: the tags do not change`);
    viewers.close();
    return { share, perViewer };
  } finally {
    await cell.end();
  }
}

async function drawScreen() {
  progress(`a screen of ${SYMBOLS} symbols: ${given.seconds} s`);
  const cell = await startCell(given.program, SYMBOLS, screenText());
  try {
    const { fps, p99_ms, update_ms, updates_per_s } = await screenFrames(browser.context, cell.url, given.seconds);
    report.screen_500_symbols_fps = fps;
    report.screen_500_symbols_p99_frame_ms = p99_ms;
    report.screen_500_symbols_update_ms = update_ms;
    report.screen_500_symbols_updates_per_s = updates_per_s;
  } finally {
    await cell.end();
  }
}

async function timeUp() {
  progress('from a command to the page');
  report.bare_to_page_s = await bareToPage(browser.context);
  report.up_to_page_s = await upToPage(browser.context, given.program);
}

async function leaveOpen(minutes) {
  const cell = await startCell(given.program, given.tags);
  try {
    Object.assign(report, await soak(browser.context, cell, INPUT_TAG, minutes, progress));
  } finally {
    await cell.end();
  }
}

function historian() {
  progress('historian');
  const folder = mkdtempSync(join(tmpdir(), 'stepwright-bench-hmi-'));
  const file = join(folder, 'historian.json');
  execFileSync(join(dirname(given.program), 'bench_historian'), ['--json', file], { stdio: 'ignore' });
  const { historian_samples_per_s, sqlite_rows_samples_per_s, bytes_per_sample, sqlite_rows_bytes_per_sample, trend_query_ms } = JSON.parse(readFileSync(file, 'utf8'));
  rmSync(folder, { recursive: true });
  return { historian_samples_per_s, sqlite_rows_samples_per_s, bytes_per_sample, sqlite_rows_bytes_per_sample, trend_query_ms };
}

function tell() {
  const ms = (value) => `${value.toFixed(1)} ms`.padStart(12);
  const rows = [
    ['pixel', `the page, ${given.clients} looking`],
    ['polling', 'baseline: a page that asks every 500 ms'],
    ['pushed', 'limit: told at once, no PLC between'],
  ].map(([name, what]) => `  ${what.padEnd(44)}${ms(report[`${name}_p50_ms`])}${ms(report[`${name}_p99_ms`])}`);
  const lines = [
    `  ${'from the plant to the pixel'.padEnd(44)}${'p50'.padStart(12)}${'p99'.padStart(12)}`,
    ...rows,
    `  ${given.tags} tags at 10 Hz: ${report.core_share_5000_tags.toFixed(2)} of a core for one client, ${report.core_share_all_clients.toFixed(2)} for ${given.clients}`,
    `  ${given.clients} that show none of them: ${report.core_share_without_tags.toFixed(2)} of a core, ${(report.viewer_bytes_without_tags_per_s / 1_000).toFixed(1)} kB a second each instead of ${(report.viewer_bytes_per_s / 1_000).toFixed(0)}`,
    `  a screen of ${SYMBOLS} symbols at 10 Hz: ${report.screen_500_symbols_fps.toFixed(1)} frames a second, one of a hundred after ${report.screen_500_symbols_p99_frame_ms.toFixed(0)} ms`,
    `    script, style and layout of an update: ${report.screen_500_symbols_update_ms.toFixed(1)} ms, ${report.screen_500_symbols_updates_per_s.toFixed(1)} updates a second; a browser without a display paints with the processor, which limits the frames`,
    `  from “stepwright up” to live values: ${report.up_to_page_s.toFixed(1)} s (a bare server and page: ${report.bare_to_page_s.toFixed(1)} s)`,
    `  first load: ${report.first_load_kb.toFixed(1)} kB`,
  ];
  if ('historian_samples_per_s' in report) {
    lines.push(
      `  historian: ${Math.round(report.historian_samples_per_s)} samples/s (rows of SQLite: ${Math.round(report.sqlite_rows_samples_per_s)}), ` +
        `${report.bytes_per_sample.toFixed(2)} bytes a sample (${report.sqlite_rows_bytes_per_sample.toFixed(1)}), a trend in ${report.trend_query_ms.toFixed(0)} ms`,
    );
  }
  if ('heap_growth_percent' in report) lines.push(`  a tab of ${given['soak-minutes']} minutes: heap ${report.heap_first_mb.toFixed(1)} MB, then ${report.heap_last_mb.toFixed(1)} MB (${report.heap_growth_percent.toFixed(1)} %)`);
  process.stdout.write(`${lines.join('\n')}\n`);
}

try {
  await timeOurs();
  await timeBaselines();
  report.ratio_to_polling_p50 = report.polling_p50_ms / report.pixel_p50_ms;
  const one = await takeShare(1, 'all');
  const all = await takeShare(given.clients, 'all');
  const none = await takeShare(given.clients, 'none');
  report.core_share_5000_tags = one.share;
  report.core_share_all_clients = all.share;
  report.viewer_bytes_per_s = all.perViewer;
  report.core_share_without_tags = none.share;
  report.viewer_bytes_without_tags_per_s = none.perViewer;
  await drawScreen();
  await timeUp();
  if (given['soak-minutes'] > 0) await leaveOpen(given['soak-minutes']);
  if (!given['no-historian']) Object.assign(report, historian());
  tell();
  if (given.json) writeFileSync(given.json, `${JSON.stringify(report, null, 2)}\n`);
} finally {
  await browser.close();
}
