// A fleet and an operator at its page: holds it, blocks and frees a place, orders, takes back a vehicle that died, lets
// it go on. The fleet is held soon after that vehicle is lost, which it can be only while it drives; then it waits for the test.

import { startDemo } from './demo_process.mjs';
import { leadOverPage } from './page_run.mjs';
import { asks, asksApi, claims, dialog, fill, isAccessible, setupToken, submits } from './people.mjs';
import { check, options, pictures, until, waitFor } from './support.mjs';

// Slower than real time: where vehicles come to rest is not to depend on how fast the browser is.
const SPEED = 0.15;
const LOST = 'truck 2';
const DIES_S = 2; // of the cell's time
const LIVES_AGAIN_S = 4.5;

const given = options();

const shot = pictures(given, 'fleet-access-');
const phaseIs = (page, what, phase) =>
  waitFor(page, what, (wanted) => document.querySelector('[data-testid=phase]')?.innerText === wanted, phase);

async function looksThenClaims(page, token) {
  await waitFor(page, 'whoever looks sees the vehicles', () => document.querySelectorAll('[data-vehicle]').length === 3);
  check((await page.getByRole('button', { name: 'Block a place' }).count()) === 0, 'but has no buttons that act');
  await claims(page, token);
}

// The cell's own time.
async function time(page) {
  const scan = await asks(page, 'GET', '/api/scan');
  return scan.json.runtimes[0].scan.time_s;
}

// The server is asked itself: the page of a busy machine draws a loss long after the vehicles have driven on.
async function losesOneAndHolds(page) {
  await until('the fleet is held when one has been dead for some time', async () =>
    (await time(page)) >= LIVES_AGAIN_S && (await asksApi(page, '/api/plan/hold', {})) === '200');
  await waitFor(page, `${LOST} is told to be lost`, (name) => document.querySelector(`[data-row="${name}"]`)?.dataset.state === 'lost', LOST);
  await phaseIs(page, 'and all come to rest', 'held');
  check((await asksApi(page, '/api/plan/start', {})) === '409 X0008', 'a fleet that is under way is not started');
  check((await asksApi(page, '/api/plan/what-if', { goal: '(a)', id: '1' })) === '400 X0003', 'and has no what-if');
}

async function blocksAndFrees(page) {
  await page.getByRole('button', { name: 'Block a place' }).click();
  await fill(page, { 'Name of the place': 'spill', 'Lowest x (m)': '24', 'Highest x (m)': '25.5', 'Lowest y (m)': '15', 'Highest y (m)': '16.5' });
  await isAccessible(page, 'blocking a place');
  await shot(page, 'block');
  await submits(page, 'Block the place', 'the supervisor has accepted the place');
  await waitFor(page, 'it is told to everybody', () => document.querySelector('[data-testid=blocked]').innerText.includes('spill is blocked'));
  await shot(page, 'blocked');
  await isAccessible(page, 'the page of a fleet with a blocked place');
  await page.getByRole('button', { name: 'Free spill' }).click();
  check((await dialog(page).getByTestId('subject').innerText()) === 'spill', 'the dialog names the place');
  await submits(page, 'Free the place', 'the supervisor has accepted that it is free');
  await waitFor(page, 'and it is', () => document.querySelector('[data-testid=blocked]').innerText.trim() === '');
}

async function orders(page) {
  const nowhere = await asksApi(page, '/api/fleet/order', { name: 'box', from: 'the moon', to: 'shelf 2', amount: 1 });
  check(/^4\d\d [A-Z]\d{4}$/.test(nowhere), `an order from nowhere is refused by the supervisor (${nowhere})`);
  await page.getByRole('button', { name: 'New order' }).click();
  const place = (label) => dialog(page).getByLabel(label, { exact: true });
  await until('places are chosen from a list', async () => (await place('From').locator('option').allInnerTexts()).includes('dock B'));
  await fill(page, { 'Name of the order': '  ' });
  await place('From').selectOption('dock B');
  check(await place('To').locator('option', { hasText: 'dock B' }).isDisabled(), 'an order does not end where it begins');
  await place('To').selectOption('shelf 2');
  await isAccessible(page, 'a new order');
  await shot(page, 'order');
  await fill(page, { 'Name of the order': 'box' });
  await submits(page, 'Hand over', 'another one is accepted');
  await waitFor(page, 'and stands among the goals', () =>
    [...document.querySelectorAll('[data-panel=goals] tbody tr')].some((row) => row.innerText.includes('box')));
}

async function takesBack(page) {
  await until('it would answer again', async () => (await time(page)) > LIVES_AGAIN_S + 0.5);
  await shot(page, 'lost');
  await page.getByRole('button', { name: `Take back ${LOST}` }).click();
  check((await dialog(page).getByTestId('subject').innerText()) === LOST, 'the dialog names the vehicle');
  await isAccessible(page, 'taking a vehicle back');
  await shot(page, 'return');
  await submits(page, 'Take it back', 'the supervisor has accepted it');
}

async function resumes(page) {
  await page.getByRole('button', { name: 'Resume' }).click();
  await submits(page, 'Resume the run', 'the supervisor has accepted to go on');
  await phaseIs(page, 'a plan for all of it is driven', 'executing');
  await waitFor(page, `${LOST} takes part again`, (name) =>
    !['lost', 'stopped', ''].includes(document.querySelector(`[data-row="${name}"]`)?.dataset.state ?? ''), LOST);
  await shot(page, 'resumed');
}

// The bumper of a vehicle, held at what it is: picture and table say whose.
async function marksWhatIsForced(page) {
  await page.getByLabel('Search tags by name or address').fill('bumper');
  const set = page.locator('[data-panel=tags] tbody tr').filter({ hasText: '%IX' }).first().getByRole('button', { name: /^Set / });
  const tag = (await set.getAttribute('aria-label')).replace('Set ', '');
  check((await asks(page, 'POST', '/api/tags/force', { name: tag, value: 'FALSE', reason: 'to look at it' })).status === 200, `${tag} is forced`);
  await waitFor(page, 'the picture marks its vehicle and says so', () => {
    const marked = [...document.querySelectorAll('[data-testid=floor] [data-vehicle]')].filter((one) => one.querySelector('[data-forced]') !== null);
    return marked.length === 1 && marked[0].ariaLabel.includes('something of it is forced');
  });
  check((await page.locator('[data-testid=vehicles] [data-forced]').count()) === 1, 'so does its row in the table');
  await page.locator('[data-testid=vehicles] tr:has([data-forced]) button').click();
  await waitFor(page, 'and its bumper where its values are', () => document.querySelectorAll('[data-testid=mission] dd [data-forced]').length === 1);
  await isAccessible(page, 'the page of a fleet with something forced');
  await shot(page, 'forced');
  await asks(page, 'POST', '/api/tags/unforce', { name: tag, reason: 'looked at' });
}

async function readsTheTrail(page) {
  await page.getByRole('button', { name: 'Audit' }).click();
  await waitFor(page, 'the chain holds', () => document.querySelector('[data-testid=audit-state]')?.innerText.includes('the chain holds'));
  const rows = await page.locator('[data-action]').filter({ has: page.locator('td') }).allInnerTexts();
  const has = (...words) => rows.some((row) => words.every((word) => row.includes(word)));
  for (const [action, word] of [['plan.hold', ''], ['fleet.block', 'spill'], ['fleet.unblock', 'spill'], ['fleet.order', 'box'], ['fleet.return', LOST], ['plan.resume', '']])
    check(has('root', action, word, 'done'), `the trail has ${action}`);
  check(has('root', 'fleet.order', 'refused: '), 'and what was refused, with the reason of the supervisor');
  await page.keyboard.press('Escape');
}

await leadOverPage(given, {
  name: 'fleet-access',
  expected: [400, 401, 409],
  start: () => startDemo(given.server, SPEED, given.cell, ['--fault', `dead_v2=1@${DIES_S}`, '--fault', `dead_v2=0@${LIVES_AGAIN_S}`]),
  steps: async (page, demo) => {
    await looksThenClaims(page, await setupToken(demo));
    await losesOneAndHolds(page);
    await blocksAndFrees(page);
    await orders(page);
    await takesBack(page);
    await resumes(page);
    await marksWhatIsForced(page);
    await readsTheTrail(page);
  },
});
