// The whole chain as a person sees it: planner, executive, runtime, link and HMI of the bench, at ten times real
// time, watched from a page. In the middle the HMI is killed, which must not matter to the run.

import { startDemo } from './demo_process.mjs';
import { leadOverPage } from './page_run.mjs';
import { BY_OPERATOR, startsTheRun } from './people.mjs';
import { check, fitsWidth, options, pictures, until, waitFor } from './support.mjs';

const SPEED = 10;
const KILL_AFTER_ACTIONS = 3;

const given = options();
const shot = pictures(given, 'chain-', { fullPage: true });

// Notes every value that the page shows, so that nothing is missed between two looks of the test.
function keepHistory() {
  const seen = { levels: {}, positions: [], steps: [], progress: [], links: [] };
  const note = (list, value) => {
    if (value !== undefined && value !== null && value !== list.at(-1)) list.push(value);
  };
  const look = () => {
    for (const tank of document.querySelectorAll('[data-tank]')) {
      note((seen.levels[tank.dataset.tank] ??= []), tank.dataset.level);
    }
    note(seen.positions, document.querySelector('[data-vehicle=v1]')?.dataset.x);
    note(seen.steps, document.querySelector('[data-testid=active-steps]')?.textContent);
    note(seen.progress, document.querySelector('[data-testid=plan-progress]')?.ariaValueNow);
    note(seen.links, document.querySelector('[data-testid=link]')?.textContent.trim());
  };
  globalThis.seen = seen;
  new MutationObserver(look).observe(document, { subtree: true, childList: true, characterData: true, attributes: true });
}

async function takePictures(page, moment) {
  for (const width of [360, 1440]) {
    await fitsWidth(page, width);
    await waitFor(page, `the newest active step is in view at ${width} px`, () => {
      const frame = document.querySelector('[aria-label="program chart"]').getBoundingClientRect();
      const lit = [...document.querySelectorAll('.step.active')].map((step) => step.getBoundingClientRect());
      const inside = (box) =>
        box.left >= frame.left && box.right <= frame.right && box.top >= frame.top && box.bottom <= frame.bottom;
      return lit.length > 0 && inside(lit.reduce((lowest, box) => (box.bottom > lowest.bottom ? box : lowest)));
    });
    await shot(page, `${moment}-${width}`);
  }
}

async function showsTheRun(page, demo) {
  await waitFor(page, 'the synoptic shows every tank', () => document.querySelectorAll('[data-tank]').length === 4);
  await waitFor(page, 'the plan has 17 actions', () => document.querySelectorAll('[data-action]').length === 17);
  await startsTheRun(page, demo);
  await page.getByTestId('log-out').click();
  await waitFor(page, 'a step of the chart is lit', () => document.querySelector('.step.active') !== null);
  await waitFor(page, 'the first actions are done', (few) =>
    Number(document.querySelector('[data-testid=plan-progress]')?.ariaValueNow ?? 0) >= few, KILL_AFTER_ACTIONS);
}

async function outlivesTheServer(page, demo) {
  const killed = demo.pidOf('hmi');
  check(killed > 0, 'the HMI is a process of its own');
  process.kill(killed, 'SIGKILL');
  await waitFor(page, 'the page notices that the server is gone', () => globalThis.seen.links.includes('offline'));
  await waitFor(page, 'the page comes back by itself', () =>
    globalThis.seen.links.at(-1) === 'live' && document.querySelector('[data-testid=banner]') === null);
  const again = demo.pidOf('hmi');
  check(again > 0 && again !== killed, 'another HMI process serves it');
}

async function reachesTheGoal(page) {
  await waitFor(page, 'the plan progress reaches 17 of 17', () => {
    const progress = document.querySelector('[data-testid=plan-progress]');
    return progress?.ariaValueNow === '17' && progress.ariaValueMax === '17';
  });
  await waitFor(page, 'the page says that the goal is reached', () =>
    document.querySelector('[data-testid=phase]')?.textContent.trim() === 'done' &&
    document.querySelector('[data-testid=message]').textContent.includes('the goal is reached'));
}

async function showsTheResult(page) {
  const levels = await page.evaluate(() =>
    [...document.querySelectorAll('[data-testid=final-levels] tbody tr')].map((row) =>
      [...row.cells].map((cell) => cell.innerText)));
  for (const tank of ['a1', 'a2']) {
    const [, goal, measured] = levels.find(([fluent]) => fluent === `level ${tank}`) ?? [];
    check(goal === '5.00' && Math.abs(Number(measured) - 5) <= 0.5, `${tank} ends at ${measured}, wanted ${goal}`);
  }
  for (const makespan of ['actual', 'planned']) {
    const text = await page.locator(`[data-testid=makespan-${makespan}]`).innerText();
    check(/^\d+:\d\d\.\d$/.test(text), `the makespan is shown, ${makespan} ${text}`);
  }
}

async function sawEverythingMove(page) {
  const seen = await page.evaluate(() => globalThis.seen);
  for (const tank of ['v1', 'a1', 'a2', 'f1']) {
    check(seen.levels[tank]?.length > 3, `the level of ${tank} moved (${seen.levels[tank]?.length} values)`);
  }
  check(seen.positions.length > 3, `the vehicle moved (${seen.positions.length} positions)`);
  check(seen.steps.length > 5, `the active steps changed (${seen.steps.length} times)`);
  check(seen.progress.length > 3, `the progress went ${seen.progress.join(' ')}`);
}

await leadOverPage(given, {
  name: 'chain',
  watch: keepHistory,
  start: () => startDemo(given.server, SPEED, 'bench', BY_OPERATOR),
  steps: async (page, demo) => {
    await showsTheRun(page, demo);
    await outlivesTheServer(page, demo);
    await takePictures(page, 'during');
    await reachesTheGoal(page);
    await showsTheResult(page);
    await sawEverythingMove(page);
    await takePictures(page, 'after');
    check(demo.processes().length === 5, 'demo, runtime, link, supervisor and HMI are there');
    const code = await demo.end();
    check(code === 0, `the demo ends with 0 when it is told to end (${code})`);
    await until('no process of the demo is left', () => demo.processes().length === 0);
  },
});
