// How fluently the page of twenty vehicles is drawn, by hand:
//
//   node tests/browser/fleet_fluency.mjs --server build/release/bin/stepwright --modules CLIENT/node_modules
//     --chromium /usr/bin/chromium --out FOLDER [--cell CELL.toml] [--speed 1] [--url OF_ONE_THAT_RUNS] [--rounds 3] [--slower 1] [--pages old=DIST,new=DIST]
//
// CLIENT is build/release/hmi_web/client/work, and DIST the `dist` in it or a copy of an older one. Pages of several
// builds are shown by turns to the same cell, so that a busy machine is busy for all of them; an empty page that counts
// frames beside them says what the machine gives at all. What the browser's main thread did is summed from its trace.

import { readFileSync, writeFileSync } from 'node:fs';
import { extname, join } from 'node:path';

import { startDemo } from './demo_process.mjs';
import { FLUENT, launchBrowser, options } from './support.mjs';

const WINDOW_MS = 8_000;
const SETTLE_MS = 3_000;
const PLANNED_WITHIN_MS = 600_000;
const WORK = ['FunctionCall', 'UpdateLayoutTree', 'Layout', 'PrePaint', 'Paint', 'Layerize', 'Commit', 'RasterTask', 'RunTask'];
const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.svg': 'image/svg+xml' };

const given = options();
const pages = (given.pages ?? '').split(',').filter((page) => page !== '').map((page) => page.split('='));
if (pages.length === 0) pages.push(['page', '']);

// The page of another build, with everything else from the server.
async function serveFrom(page, dist) {
  if (dist === '') return;
  await page.route('**/*', (route) => {
    const { pathname } = new URL(route.request().url());
    const file = join(dist, pathname === '/' ? 'index.html' : pathname);
    return route.fulfill({ body: readFileSync(file), contentType: TYPES[extname(file)] ?? 'application/octet-stream' });
  });
}

function countFrames(forMs) {
  return new Promise((resolve) => {
    const gaps = [];
    let last = performance.now();
    const begin = last;
    const next = (now) => {
      gaps.push(now - last);
      last = now;
      if (now - begin < forMs) return requestAnimationFrame(next);
      gaps.sort((a, b) => a - b);
      resolve({ frames: gaps.length / ((now - begin) / 1_000), p95: gaps[Math.floor(gaps.length * 0.95)] });
    };
    requestAnimationFrame(next);
  });
}

async function traced(page, work) {
  const session = await page.context().newCDPSession(page);
  const events = [];
  session.on('Tracing.dataCollected', ({ value }) => events.push(...value));
  await session.send('Tracing.start', { transferMode: 'ReportEvents', traceConfig: { includedCategories: ['devtools.timeline', 'cc', 'toplevel'] } });
  const result = await work();
  const ended = new Promise((resolve) => session.once('Tracing.tracingComplete', resolve));
  await session.send('Tracing.end');
  await ended;
  const sums = {};
  for (const { name, dur, ph } of events) if (ph === 'X' && WORK.includes(name)) sums[name] = (sums[name] ?? 0) + dur / 1_000;
  return { ...result, perSecond: Object.fromEntries(Object.entries(sums).map(([name, ms]) => [name, Math.round((ms / WINDOW_MS) * 1_000)])) };
}

// A plan of many vehicles takes its time.
async function awaitDriving(page) {
  const driving = () => document.querySelector('[data-vehicle][data-state=driving]') !== null;
  for (const deadline = Date.now() + PLANNED_WITHIN_MS; !(await page.evaluate(driving)); ) {
    if (Date.now() > deadline) throw new Error('no vehicle drives');
    await new Promise((resolve) => setTimeout(resolve, 500));
  }
}

async function measure(context, url, [name, dist]) {
  const page = await context.newPage();
  if (url !== '') {
    await serveFrom(page, dist);
    await page.goto(url);
    await awaitDriving(page);
  }
  await new Promise((resolve) => setTimeout(resolve, SETTLE_MS));
  const driving = await page.evaluate(() => document.querySelectorAll('[data-vehicle][data-state=driving]').length);
  // Of the page's own thread, as if the machine were so many times slower.
  await (await context.newCDPSession(page)).send('Emulation.setCPUThrottlingRate', { rate: Number(given.slower ?? 1) });
  const result = await traced(page, () => page.evaluate(countFrames, WINDOW_MS));
  await page.close();
  console.log(`${name.padEnd(10)} ${result.frames.toFixed(1)} frames/s, 95 % within ${result.p95.toFixed(0)} ms, ${driving} drive; ms/s: ${JSON.stringify(result.perSecond)}`);
  return { name, ...result, driving };
}

// A page that comes from elsewhere may not open a socket to this machine otherwise.
const browser = await launchBrowser(given, { flags: ['--disable-features=LocalNetworkAccessChecks'], reducedMotion: 'no-preference' });
const cell = given.cell ?? join(import.meta.dirname, '../cells/fleet/large_hall.toml');
const running = { url: given.url, end: () => {}, forget: () => {} };
const demo = given.url ? running : await startDemo(given.server, Number(given.speed ?? 1), cell, FLUENT);
const results = [];
try {
  await new Promise((resolve) => setTimeout(resolve, 1_000));
  for (let round = 0; round < Number(given.rounds ?? 3); round++) {
    results.push(await measure(browser.context, '', ['empty', '']));
    for (const page of pages) results.push(await measure(browser.context, demo.url, page));
  }
} finally {
  writeFileSync(join(given.out, 'fleet_fluency.json'), JSON.stringify(results, null, 1));
  await demo.end();
  await browser.close();
  demo.forget();
}
