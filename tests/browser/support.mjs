// What a browser test needs: the server under test as a child process, Chromium, and checks that say what failed.

import { spawn } from 'node:child_process';
import { mkdirSync, mkdtempSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { createInterface } from 'node:readline';

// Far more than anything here takes, on a machine that is busy with other tests too.
const PATIENCE_MS = 600_000;
const WHOLE_TEST_MS = 1_740_000; // a minute less than ctest waits

// For processes of a cell: a page whose motion nobody looks at gets values ten times a second, which is less work.
export const PACED = ['--set', 'hmi.refresh_ms=100'];
export const FLUENT = ['--set', 'hmi.refresh_ms=20'];

export function options() {
  const given = {};
  for (let i = 2; i < process.argv.length; i += 2) given[process.argv[i].replace(/^--/, '')] = process.argv[i + 1];
  for (const name of ['server', 'modules', 'chromium', 'out']) {
    if (!given[name]) throw new Error(`--${name} is missing`);
  }
  mkdirSync(given.out, { recursive: true });
  return given;
}

// Starts the scripted cell and waits for its address; its script stands still at `startS` until tell('run') or tell('run 30').
export async function startServer(program, port, speed, startS, ...more) {
  const child = spawn(program, [port, speed, startS, ...more].map(String), { stdio: ['pipe', 'pipe', 'inherit'] });
  const ended = new Promise((resolve) => child.once('exit', resolve));
  const url = await new Promise((resolve, reject) => {
    createInterface({ input: child.stdout }).once('line', resolve);
    child.once('exit', (code) => reject(new Error(`the server ended with ${code}`)));
  });
  return {
    url,
    port: Number(new URL(url).port),
    tell: (line) => child.stdin.write(`${line}\n`),
    stop: () => {
      child.stdin.end();
      return ended;
    },
    kill: () => {
      child.kill('SIGKILL');
      return ended;
    },
  };
}

// Without motion, as people may ask of their browser: what glides is drawn at 60 pictures a second, which only Line looks at.
export async function launchBrowser({ modules, chromium }, { flags = [], reducedMotion = 'reduce' } = {}) {
  const { chromium: driver } = createRequire(join(modules, 'playwright-core', 'package.json'))('playwright-core');
  const profile = mkdtempSync(join(tmpdir(), 'hmi-browser-'));
  const context = await driver.launchPersistentContext(profile, {
    executablePath: chromium,
    headless: true,
    viewport: { width: 1440, height: 900 },
    reducedMotion,
    args: [
      '--no-sandbox',
      '--disable-gpu',
      '--no-first-run',
      '--disable-background-networking',
      '--disable-component-update',
      '--disable-sync',
      ...flags,
    ],
  });
  context.setDefaultTimeout(PATIENCE_MS); // of a busy machine: a button that moves is not clicked until it rests
  return {
    context,
    close: async () => {
      await context.close();
      rmSync(profile, { recursive: true, force: true });
    },
  };
}

// A page that remembers what it must not do: log errors, break the content policy, call another host.
export async function openPage(context, url) {
  const page = await context.newPage();
  const problems = [];
  page.on('console', (message) => {
    // A server that is stopped on purpose is reported by the browser itself.
    const expected = /ERR_CONNECTION_(REFUSED|RESET|CLOSED)|ERR_SOCKET_NOT_CONNECTED|ERR_EMPTY_RESPONSE|WebSocket connection to/.test(message.text());
    if (message.type() === 'error' && !expected) problems.push(`console: ${message.text()}`);
  });
  page.on('pageerror', (error) => problems.push(`exception: ${error.message}`));
  const watch = (address) => {
    if (new URL(address).host !== new URL(url).host) problems.push(`foreign request: ${address}`);
  };
  page.on('request', (request) => watch(request.url()));
  page.on('websocket', (socket) => watch(socket.url()));
  await page.addInitScript(() => {
    document.addEventListener('securitypolicyviolation', (event) =>
      console.error(`policy: ${event.violatedDirective} ${event.blockedURI}`),
    );
  });
  await page.goto(url);
  return { page, problems };
}

// Takes pictures of a page, or of a part of it, for people: nothing compares them, and each costs as much as seconds of looking. Those who
// want them set STEPWRIGHT_PICTURES. `usual` is for all of them.
export function pictures({ out }, prefix, { fullPage = false } = {}) {
  const wanted = (process.env.STEPWRIGHT_PICTURES ?? '') !== '';
  return async (where, name, more = {}) => {
    if (!wanted) return;
    const whole = 'goto' in where ? { fullPage } : {}; // a part of a page has its own size
    await where.screenshot({ path: join(out, `${prefix}${name}.png`), animations: 'disabled', ...whole, ...more });
  };
}

// How a page looked when its test failed.
export async function failurePicture({ out }, name, page) {
  await page.screenshot({ path: join(out, `${name}-failure.png`) }).catch(() => {});
}

export function check(condition, what) {
  if (!condition) throw new Error(`not so: ${what}`);
  console.log(`ok: ${what}`);
}

// Asks again and again, less and less often, until the answer is yes; fails with the name of what did not happen.
export async function eventually(what, condition) {
  const deadline = Date.now() + PATIENCE_MS;
  for (let pause = 40; !(await condition()); pause = Math.min(1.2 * pause, 250)) {
    if (Date.now() > deadline) throw new Error(`did not happen within ${PATIENCE_MS / 1_000} s: ${what}`);
    await new Promise((resolve) => setTimeout(resolve, pause));
  }
}

// The same as a check that is told.
export async function until(what, condition) {
  await eventually(what, condition);
  console.log(`ok: ${what}`);
}

// Waits for a condition inside the page. Asks from outside: the page's content policy does not let a test
// evaluate text inside it.
export function waitFor(page, what, condition, argument) {
  return until(what, () => page.evaluate(condition, argument));
}

// A test that hangs ends all the same.
export function endInTime() {
  setTimeout(() => {
    console.error('not so: the whole test ends in time');
    process.exit(1);
  }, WHOLE_TEST_MS).unref();
}

// What was changed is laid out and drawn: the window has its size, and the page has had pictures to follow it.
export async function drawn(page) {
  const wanted = page.viewportSize();
  const hasSize = ({ width, height }) => innerWidth === width && innerHeight === height;
  await eventually('the window has its size', () => page.evaluate(hasSize, wanted));
  await page.evaluate(async () => {
    for (let k = 0; k < 8; k++) await new Promise((resolve) => requestAnimationFrame(resolve));
  });
}

// Nothing sticks out of a window of that width.
export async function fitsWidth(page, width) {
  await page.setViewportSize({ width, height: 900 });
  await drawn(page);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  check(wide <= width, `nothing sticks out at ${width} px (${wide})`);
}

// At each width nothing sticks out; `shot` takes a picture by name: "light-1440" and so on, and both ends in the dark.
export async function fitsEveryWidth(page, widths, shot) {
  for (const width of widths) {
    await fitsWidth(page, width);
    await shot(page, `light-${width}`);
  }
  await page.emulateMedia({ colorScheme: 'dark' });
  await shot(page, `dark-${widths.at(-1)}`);
  await page.setViewportSize({ width: widths[0], height: 900 });
  await drawn(page);
  await shot(page, `dark-${widths[0]}`);
  await page.emulateMedia({ colorScheme: 'light' });
}

// In each of `looks` (colour scheme and width) nothing sticks out; `deed` is done with it there, and named after it.
export async function fitsEachLook(page, looks, deed) {
  for (const [scheme, width] of looks) {
    await page.emulateMedia({ colorScheme: scheme });
    await fitsWidth(page, width);
    await deed(`${scheme}-${width}`);
  }
}
