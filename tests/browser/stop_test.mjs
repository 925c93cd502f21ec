// The sorting line, started by an operator while its emergency stop is pressed: the page says so, nothing moves, not even when it is released
// again without a reset; after the reset the run goes on to its goal.

import { startDemo } from './demo_process.mjs';
import { leadOverPage } from './page_run.mjs';
import { BY_OPERATOR, isAccessible, startsTheRun } from './people.mjs';
import { check, options, pictures, waitFor } from './support.mjs';

const SPEED = 2;
const RELEASED_S = 22; // of the cell's time
const RESET_S = 42;

const given = options();
const shot = pictures(given, 'stop-');
const clockIs = (page, what, seconds) =>
  waitFor(page, what, (wanted) => {
    const [minutes, rest] = document.querySelector('[data-testid=clock]').innerText.split(' ')[0].split(':').map(Number);
    return minutes * 60 + rest >= wanted;
  }, seconds);

// Everything that moves or is told to, when the first of it does, and what is said of the emergency stop: a slow browser is asked
// for it later.
function keepHistory() {
  const seen = { belts: new Set(), paddles: new Set(), first: '', pressed: '' };
  const look = () => {
    // A chute has no drive: it is drawn as one that always runs.
    for (const belt of document.querySelectorAll('.belt.on')) if (!belt.dataset.belt.startsWith('chute')) seen.belts.add(belt.dataset.belt);
    for (const paddle of document.querySelectorAll('[data-pusher].on')) seen.paddles.add(paddle.dataset.pusher);
    if (seen.first === '' && seen.belts.size + seen.paddles.size > 0) seen.first = document.querySelector('[data-testid=clock]').innerText;
    seen.pressed ||= document.querySelector('[data-testid=emergency-stop]')?.innerText ?? '';
  };
  globalThis.seen = seen;
  new MutationObserver(look).observe(document, { subtree: true, childList: true, attributes: true });
}
const firstMoved = (page) =>
  page.evaluate(() => {
    const [minutes, seconds] = globalThis.seen.first.split(' ')[0].split(':').map(Number);
    return minutes * 60 + seconds;
  });

await leadOverPage(given, {
  name: 'stop',
  watch: keepHistory,
  start: () =>
    startDemo(given.server, SPEED, 'conveyor', [
      ...BY_OPERATOR,
      '--fault', 'press_estop=1@0', '--fault', `press_estop=0@${RELEASED_S}`,
      '--fault', `press_reset=1@${RESET_S}`, '--fault', `press_reset=0@${RESET_S + 1}`,
    ]),
  steps: async (page, demo) => {
    await startsTheRun(page, demo);
    await waitFor(page, 'the page says that the emergency stop is pressed', () => globalThis.seen.pressed.startsWith('The emergency stop is pressed.'));
    await waitFor(page, 'the plan begins with waiting for a reset', () => document.querySelector('[data-state=active]')?.innerText.includes('await_reset'));
    await waitFor(page, 'and the page says why', () => document.querySelector('[data-panel=incidents]')?.innerText.includes('contactor closed'));
    await shot(page, 'pressed');
    await page.setViewportSize({ width: 360, height: 740 });
    await page.evaluate(() => scrollTo(0, 0));
    await shot(page, 'pressed-360');
    await page.setViewportSize({ width: 1440, height: 900 });
    await isAccessible(page, 'the page of a line that is stopped');
    await clockIs(page, 'it is released', RELEASED_S + 1);
    await waitFor(page, 'the page sees that, too', () => document.querySelector('[data-testid=emergency-stop]') === null);
    await shot(page, 'released');
    await clockIs(page, 'somebody resets the line', RESET_S + 1);
    await waitFor(page, 'and it goes on', () => globalThis.seen.belts.size > 0);
    const first = await firstMoved(page);
    check(first >= RESET_S, `nothing has moved before (${first} s)`);
    await waitFor(page, 'to its goal', () => document.querySelector('[data-testid=phase]')?.innerText === 'done');
  },
});
