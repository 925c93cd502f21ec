// Two arms that work on an order, as a person sees them: the cell in space before anything moves, then arms, things, ways and the distance
// as they change, the same as figures beside it, seen from any side, and the same on a telephone.

import { startDemo } from './demo_process.mjs';
import { hiddenFocus, unreadable } from './narrow.mjs';
import { leadOverPage } from './page_run.mjs';
import { BY_OPERATOR, dialogIsGone, isAccessible, startsTheRun } from './people.mjs';
import { check, drawn, fitsEachLook, options, pictures, waitFor } from './support.mjs';

const SPEED = 0.5; // fingers close within a quarter of a second, which a page on a busy machine does not show
const ROUNDED_M = 0.0006; // a page gets three digits of a number with a fraction
const LOOKS = [['light', 1440], ['dark', 1440], ['light', 820], ['light', 360], ['dark', 360]];

const given = options();
const shot = pictures(given, 'arms-', { fullPage: true });

// What the table has said so far, how near the arms were, and by how much the drawn distance is another one than the controller's.
function keepHistory() {
  const seen = { steps: [new Set(), new Set()], held: [new Set(), new Set()], shares: [[], []], joints: [new Set(), new Set()], waits: new Set(), least: Infinity, off: 0, distances: 0 };
  const cells = (row) => [...document.querySelectorAll(`[data-testid=arms-table] [data-row=${row}] td`)];
  const note = (list, value) => {
    if (value !== list.at(-1)) list.push(value);
  };
  const look = () => {
    cells('step').forEach((cell, arm) => seen.steps[arm].add(cell.innerText.replace(/^.*: /, '')));
    cells('holds').forEach((cell, arm) => seen.held[arm].add(cell.innerText));
    cells('progress').forEach((cell, arm) => note(seen.shares[arm], Number(cell.dataset.share)));
    cells('joint-2').forEach((cell, arm) => seen.joints[arm].add(cell.innerText));
    for (const cell of cells('waits')) seen.waits.add(cell.innerText);
    const distance = document.querySelector('[data-testid=arms-distance]');
    if (!distance) return;
    seen.distances += 1;
    seen.least = Math.min(seen.least, Number(distance.dataset.metres));
    seen.off = Math.max(seen.off, Math.abs(Number(distance.dataset.metres) - Number(distance.dataset.drawn)));
  };
  globalThis.seen = seen;
  new MutationObserver(look).observe(document, { subtree: true, childList: true, attributes: true, characterData: true });
}

const view = (page) => page.getByTestId('arms-view');
const frames = (page) => view(page).getAttribute('data-frames').then(Number);
// Colours of the canvas, as a text that another picture does not have.
const pixels = (page) => page.evaluate(() => document.querySelector('[data-testid=arms-view] canvas').toDataURL());

async function showsTheCellBeforeAnythingMoves(page) {
  await waitFor(page, 'the cell is drawn', () => Number(document.querySelector('[data-testid=arms-view]')?.dataset.frames) > 0);
  const colours = await page.evaluate(() => {
    const canvas = document.querySelector('[data-testid=arms-view] canvas');
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    return new Set(new Uint32Array(data.buffer)).size;
  });
  check(colours > 100, `with ${colours} colours: bodies in light and shade`);
  check((await page.locator('[data-panel=arms]').innerText()).includes('no motion is planned'), 'no motion is planned, and the page says so');
}

async function drawsItWorking(page) {
  await waitFor(page, 'each arm has steps', () => [...document.querySelectorAll('[data-row=step] td')].every((cell) => /^\d+ of \d+: /.test(cell.innerText)));
  await waitFor(page, 'joints are told in degrees', () => [...document.querySelectorAll('[data-row=joint-4] td')].every((cell) => /^-?\d+\.\d$/.test(cell.innerText)));
  await waitFor(page, 'an arm carries something', () => globalThis.seen.steps.some((steps) => [...steps].some((step) => step.startsWith('carries, '))));
  await waitFor(page, 'and holds it, in the table', () => globalThis.seen.held.some((held) => held.size > 1));
}

async function isReadEverywhere(page) {
  await fitsEachLook(page, LOOKS, async (look) => {
    const cut = look.endsWith('360') ? await page.evaluate(unreadable) : [];
    check(cut.length === 0, `${look} can be read ${cut.join('; ')}`);
    await shot(page, look);
    await shot(page.locator('[data-panel=arms]'), `panel-${look}`); // light-1440: hmi_web/doc/arms.png
  });
  await page.emulateMedia({ colorScheme: 'light' });
  await isAccessible(page, 'the page at 360 px');
  await page.setViewportSize({ width: 1440, height: 900 });
  await isAccessible(page, 'the page');
}

async function isSeenFromAnySide(page) {
  const read = (name) => view(page).getAttribute(`data-${name}`).then(Number);
  for (const [sight, azimuth, elevation] of [['front', 0, 0], ['side', -1.571, 0], ['top', 3.142, 1.571]]) {
    const before = await pixels(page);
    await page.locator(`[data-sight=${sight}]`).click();
    await drawn(page);
    check((await read('azimuth')) === azimuth && (await read('elevation')) === elevation, `seen from the ${sight}`);
    check((await pixels(page)) !== before, 'another picture');
    await shot(page.locator('[data-testid=arms-view]'), sight);
  }
  await page.locator('[data-sight=corner]').click();
  await drawn(page);
  const [whole, turned] = [await read('scale'), await read('azimuth')];
  await page.locator('[data-panel=arms] header button[aria-label="zoom in"]').focus();
  for (let k = 0; k < 3 && (await page.evaluate(() => document.activeElement.dataset.testid)) !== 'arms-view'; k++) await page.keyboard.press('Tab');
  check((await page.evaluate(() => document.activeElement.dataset.testid)) === 'arms-view', 'Tab leads to the cell');
  const hidden = await page.evaluate(hiddenFocus);
  check(hidden === '', `which shows that it has the focus ${hidden}`);
  await page.keyboard.press('+');
  await page.keyboard.press('ArrowRight');
  check((await read('scale')) > 1.2 * whole, 'plus zooms in');
  check((await read('azimuth')) > turned, 'an arrow turns it');
  await page.keyboard.press('0');
  check((await read('scale')) === whole && (await read('azimuth')) === turned, '0 shows everything again');
  const box = await view(page).boundingBox();
  await page.mouse.move(box.x + 200, box.y + 150);
  await page.mouse.down();
  await page.mouse.move(box.x + 260, box.y + 150, { steps: 4 });
  await page.mouse.up();
  check((await read('azimuth')) < turned - 0.2, 'a finger turns it');
  await page.mouse.wheel(0, -300);
  await drawn(page);
  check((await read('scale')) > 1.2 * whole, 'the wheel zooms');
  await page.locator('[data-sight=corner]').click();
}

// An order of the cell's file by its name; its goal is looked at, and nothing is started.
async function namesOrders(page) {
  await page.getByRole('button', { name: 'New goal' }).click();
  await waitFor(page, 'the form has the orders of the cell', () => document.querySelectorAll('[data-testid=goal-order] option').length > 2);
  check((await page.getByTestId('goal-order').inputValue()) === 'P1', 'that of the run is chosen');
  await page.getByTestId('goal-order').selectOption('P2');
  check((await page.getByTestId('goal-preview').innerText()) === '(and\n  (in can1 tray-for-2)\n  (in can2 tray-for-2))', 'another one stands there with its conditions');
  await isAccessible(page, 'the form of a goal');
  await shot(page, 'order');
  await page.keyboard.press('Escape');
  await dialogIsGone(page, 'and is left without a start');
}

const isAllDone = () =>
  document.querySelector('[data-testid=phase]')?.innerText === 'done' &&
  document.querySelectorAll('[data-row=step] td').length > 0 &&
  [...document.querySelectorAll('[data-row=step] td')].every((cell) => cell.innerText === 'all done');

async function tellsTheEnd(page) {
  await waitFor(page, 'all is done, in words and figures', isAllDone);
  const late = await page.context().newPage();
  await late.goto(page.url());
  await waitFor(late, 'also for who comes when it is over', isAllDone);
  await late.close();
  const seen = await page.evaluate(() => {
    const { steps, held, shares, joints, waits, least, off, distances } = globalThis.seen;
    return { steps: steps.map((one) => [...one]), held: held.map((one) => [...one]), joints: joints.map((one) => one.size), waits: [...waits], falls: shares.map((list) => list.filter((share, k) => k > 0 && share < list[k - 1] && share > 0).length), least, off, distances };
  });
  check(seen.joints.every((count) => count > 20), `joints moved: ${seen.joints.join(', ')} angles`);
  check(seen.falls.every((count) => count === 0), 'progress never falls but to begin anew');
  check(seen.steps.flat().some((step) => step.startsWith('grips, ')), `steps: ${seen.steps.flat().join('; ')}`);
  check(seen.distances > 50 && seen.off < ROUNDED_M, `the line between the arms is as long as the controller says (${seen.distances} looks, ${(1e3 * seen.off).toFixed(2)} mm off at most)`);
  check(seen.least > 0.01 && seen.least < 2, `they came to ${(1e3 * seen.least).toFixed(0)} mm of each other`);
  console.log(`     a drawing took ${await view(page).getAttribute('data-frame-ms')} ms in the middle, ${await frames(page)} of them`);
  await shot(page, 'done');
}

await leadOverPage(given, {
  name: 'arms',
  watch: keepHistory,
  start: () => startDemo(given.server, SPEED, given.cell, BY_OPERATOR),
  steps: async (page, demo) => {
    await showsTheCellBeforeAnythingMoves(page);
    await shot(page, 'before');
    await startsTheRun(page, demo);
    await drawsItWorking(page);
    await shot(page, 'working');
    await isReadEverywhere(page);
    await isSeenFromAnySide(page);
    await tellsTheEnd(page);
    await namesOrders(page);
    const code = await demo.end();
    check(code === 0, `the demo ends with 0 when it is told to end (${code})`);
  },
});
