// A train that is told what, as a person sees it: the floor with regions and places before anything moves, then what the train has swept and
// what it will, the train itself and its task's automaton as they change, another task on the way, and the same on a telephone.

import { startDemo } from './demo_process.mjs';
import { hiddenFocus, unreadable } from './narrow.mjs';
import { leadOverPage } from './page_run.mjs';
import { asks, BY_OPERATOR, dialog, isAccessible, startsTheRun, submits } from './people.mjs';
import { check, fitsEachLook, options, pictures, waitFor } from './support.mjs';

const SPEED = 2;
// The run is held on its way to the second place, however slow the browser is; then it waits for the test.
const HELD_S = 25; // of the cell's time
const HELD_ON_THE_WAY = ['--set', `ltl.requests=[{at_s=${HELD_S}, request="hold"}]`];
const LOOKS = [['light', 1440], ['dark', 1440], ['light', 820], ['light', 360], ['dark', 360]];

const given = options();
const shot = pictures(given, 'train-', { fullPage: true });

// Every state that the task was in, every place at which the car was drawn, every stop that was reached, how many pieces lie behind,
// what of the plan was drawn while it was driven, and how long each message with pictures was.
function keepHistory() {
  const seen = { states: [], places: new Set(), pieces: [], stops: new Set(), links: 0, monitor: [], messages: [], drawn: {} };
  globalThis.WebSocket = class extends globalThis.WebSocket {
    constructor(...given) {
      super(...given);
      this.addEventListener('message', ({ data }) => {
        if (data.endsWith('"type":"pictures"}')) seen.messages.push(data.length);
      });
    }
  };
  const note = (list, value) => {
    if (value !== list.at(-1)) list.push(value);
  };
  const count = (what) => document.querySelectorAll(what).length;
  const parts = {
    swept: () => Number(document.querySelector('[data-swept=ahead]')?.dataset.pieces) > 20,
    way: () => count('[data-way=ahead]') > 0 && count('[data-stop]') >= 3 && count('[data-testid=stops] [data-state=next]') === 1,
    train: () => count('[data-link]') === 4,
    automaton: () =>
      count('[data-testid=automaton] [data-now=true]') === 1 &&
      count('[data-testid=automaton] .edge.planned') >= 2 &&
      count('[data-testid=leads-on] tr.planned') === 1,
  };
  const look = () => {
    for (const [name, isDrawn] of Object.entries(parts)) seen.drawn[name] ||= isDrawn();
    const state = document.querySelector('[data-testid=automaton] [data-now=true]');
    if (state) note(seen.states, state.dataset.state);
    const car = document.querySelector('[data-link="0"]');
    if (car) seen.places.add(`${car.dataset.x} ${car.dataset.y}`);
    seen.links = Math.max(seen.links, document.querySelectorAll('[data-link]').length);
    const driven = document.querySelector('[data-swept=driven]');
    if (driven) note(seen.pieces, Number(driven.dataset.pieces));
    // The formula of the cell's monitor in words, its verdict, and how far it is from being satisfied.
    const monitor = document.querySelector('[data-monitor=clean_train]');
    if (monitor?.dataset.verdict) note(seen.monitor, [...monitor.children].slice(1, 4).map((cell) => cell.innerText.trim()).join(', '));
    for (const row of document.querySelectorAll('[data-testid=stops] [data-state=done]')) seen.stops.add(row.dataset.place);
  };
  globalThis.seen = seen;
  new MutationObserver(look).observe(document, { subtree: true, childList: true, attributes: true });
}

async function showsTheFloorBeforeAnythingMoves(page) {
  await waitFor(page, 'five places and the regions are drawn', () =>
    document.querySelectorAll('[data-testid=plan-floor] [data-place]').length === 5 &&
    Number(document.querySelector('[data-regions]').dataset.regions) > 20);
  await waitFor(page, 'no way is planned, and the page says so', () =>
    document.querySelector('[data-panel=plan-floor]').innerText.includes('no way is planned') &&
    document.querySelectorAll('[data-way]').length === 0 &&
    document.querySelectorAll('[data-testid=stops] [data-state=open]').length === 5);
  check((await page.getByTestId('task').innerText()).startsWith('visit press then visit rack_a'), 'the task stands beside its automaton');
}

async function drawsThePlan(page) {
  await waitFor(page, 'what the plan will sweep is drawn', () => globalThis.seen.drawn.swept);
  await waitFor(page, 'so are the way, and the places on it in their order', () => globalThis.seen.drawn.way);
  await waitFor(page, 'the train stands on it with three trailers', () => globalThis.seen.drawn.train);
  await waitFor(page, 'the automaton shows its state, the plan through it and what leads on', () => globalThis.seen.drawn.automaton);
}

const covered = (page) => page.getByTestId('way-covered').getAttribute('aria-valuenow').then(Number);

async function drawsItMoving(page) {
  await waitFor(page, 'the task moves on to another state', () => globalThis.seen.states.length >= 2);
  await waitFor(page, 'a place is visited, in the table and on the floor', () =>
    globalThis.seen.stops.size >= 1 && document.querySelectorAll('[data-stop][data-state=done]').length >= 1);
  const { places, pieces, links } = await page.evaluate(() => ({ places: globalThis.seen.places.size, pieces: globalThis.seen.pieces, links: globalThis.seen.links }));
  check(places > 20, `the car was drawn at ${places} places`);
  check(links === 4, `${links} links were drawn`);
  check(pieces.length > 5 && pieces.every((count, index) => index === 0 || count >= pieces[index - 1]), `more and more lies behind it: ${pieces.join(' ')}`);
  const monitor = await page.evaluate(() => globalThis.seen.monitor);
  for (const line of ['unload before wash, watching, 1', 'unload before wash, satisfied, '])
    check(monitor.includes(line), `the monitor was "${line}" (${monitor.join('; ')})`);
  check((await covered(page)) > 3, 'the page says how much of the way is covered');
  check((await page.getByTestId('task-state').innerText()).includes('from the end'), 'and how far the task has come, in words');
}

async function isReadEverywhere(page) {
  await fitsEachLook(page, LOOKS, async (look) => {
    // Wide pages cut off what is long in their head and in figures.
    const cut = look.endsWith('360') ? await page.evaluate(unreadable) : [];
    check(cut.length === 0, `${look} can be read ${cut.join('; ')}`);
    await shot(page, look);
    for (const panel of ['plan-floor', 'automaton', 'monitors']) await shot(page.locator(`[data-panel=${panel}]`), `${panel}-${look}`);
  });
  await page.emulateMedia({ colorScheme: 'light' });
  await isAccessible(page, 'the page at 360 px');
  await page.setViewportSize({ width: 1440, height: 900 });
  await isAccessible(page, 'the page');
}

async function obeysTheKeyboard(page) {
  const floor = page.getByTestId('plan-floor');
  const scale = () => floor.getAttribute('data-scale').then(Number);
  const whole = await scale();
  await page.locator('[data-help=plan-floor]').focus();
  await page.keyboard.press('Tab');
  check((await page.evaluate(() => document.activeElement.dataset.testid)) === 'plan-floor', 'Tab leads to the floor');
  const hidden = await page.evaluate(hiddenFocus);
  check(hidden === '', `which shows that it has the focus ${hidden}`);
  await page.keyboard.press('+');
  await page.keyboard.press('ArrowLeft');
  check((await scale()) > 1.2 * whole, `plus zooms in (${whole} to ${await scale()} pixels a metre)`);
  await page.keyboard.press('0');
  check((await scale()) === whole, '0 shows everything again');
}

const deed = async (page, path, body, what) => check((await asks(page, 'POST', path, body)).status === 200, what);

// Another program runs meanwhile, which knows nothing of the way.
async function holdsStill(page) {
  await waitFor(page, 'the train rests where it is held', () => document.querySelector('[data-testid=phase]').innerText === 'held');
  check((await covered(page)) > 3, 'the page still knows how far it has come');
}

// A station is out of service, and in service again: a place of the floor by its name.
async function blocksAPlaceAndFreesIt(page) {
  await page.getByRole('button', { name: 'Block a place' }).click();
  await page.getByLabel('What is blocked').selectOption('another area');
  check((await dialog(page).getByLabel('Lowest x (m)').count()) === 1, 'any area may be blocked by its sides');
  await page.getByLabel('What is blocked').selectOption('rack_b');
  check((await dialog(page).getByLabel('Lowest x (m)').count()) === 0, 'a place of the floor as a whole');
  await isAccessible(page, 'blocking a place');
  await shot(page, 'block');
  await submits(page, 'Block the place', 'the supervisor has accepted the place');
  await waitFor(page, 'it is told to everybody, and drawn', () =>
    document.querySelector('[data-testid=blocked]').innerText.includes('rack_b is blocked') && document.querySelector('[data-blocked=rack_b]') !== null);
  await shot(page.locator('[data-panel=plan-floor]'), 'blocked');
  await page.getByRole('button', { name: 'Free rack_b' }).click();
  await submits(page, 'Free the place', 'the supervisor has accepted that it is free');
  await waitFor(page, 'and it is', () => document.querySelector('[data-testid=blocked]').innerText.trim() === '');
}

async function drawsAnotherPlan(page) {
  const task = 'visit unload then visit wash';
  await deed(page, '/api/plan/goal', { goal: task }, 'another task is asked for');
  await waitFor(page, 'its automaton is there, and that nothing watches it yet', (wanted) =>
    document.querySelector('[data-testid=task]')?.innerText === wanted &&
    document.querySelector('[data-testid=task-state]').innerText === 'No program watches the task now.', task);
  await deed(page, '/api/plan/resume', {}, 'the run goes on');
  await waitFor(page, 'the new plan is drawn, its places in their order, and what was swept before stays', () => {
    const numbered = [...document.querySelectorAll('[data-testid=stops] tr[data-place]')].filter((row) => row.querySelector('.order').innerText !== '');
    return (
      document.querySelectorAll('[data-stop]').length === 2 &&
      numbered.map(({ dataset }) => dataset.place).join() === 'unload,wash' &&
      document.querySelector('[data-swept=earlier]').getAttribute('d').length > 50
    );
  });
  await waitFor(page, 'and the automaton has its state', () => document.querySelectorAll('[data-testid=automaton] [data-now=true]').length === 1);
  await shot(page.locator('[data-panel=plan-floor]'), 'replanned');
}

async function tellsTheEnd(page) {
  await waitFor(page, 'the task is done, in words and in the picture', () =>
    document.querySelector('[data-testid=task-state]')?.innerText === 'The task is done.' &&
    document.querySelector('[data-testid=automaton] .state.done.now') !== null &&
    document.querySelector('[data-testid=phase]').innerText === 'done');
  const length = await page.getByTestId('way-covered').getAttribute('aria-valuemax').then(Number);
  check(length - (await covered(page)) < 0.6, `all of the way is covered (${await covered(page)} m of ${length} m)`);
  check((await page.locator('[data-testid=stops] [data-state=next], [data-testid=stops] [data-state=ahead]').count()) === 0, 'no place is to come');
  const messages = await page.evaluate(() => globalThis.seen.messages);
  check(messages.length >= 4 && messages.length <= 12 && messages.every((length) => length < 800_000),
    `pictures came with plans and what people wanted only: messages of ${messages.join(' ')} bytes`);
  await shot(page, 'done');
}

await leadOverPage(given, {
  name: 'train',
  watch: keepHistory,
  start: () => startDemo(given.server, SPEED, 'tugger', [...BY_OPERATOR, ...HELD_ON_THE_WAY]),
  steps: async (page, demo) => {
    await showsTheFloorBeforeAnythingMoves(page);
    await shot(page, 'before');
    await startsTheRun(page, demo);
    await drawsThePlan(page);
    await drawsItMoving(page);
    await page.evaluate(() => scrollTo(0, 0));
    await shot(page, 'overview', { fullPage: false, clip: { x: 0, y: 0, width: 1440, height: 548 } }); // hmi_web/doc/train.png
    await holdsStill(page);
    await blocksAPlaceAndFreesIt(page);
    await isReadEverywhere(page);
    await obeysTheKeyboard(page);
    await drawsAnotherPlan(page);
    await tellsTheEnd(page);
    const code = await demo.end();
    check(code === 0, `the demo ends with 0 when it is told to end (${code})`);
  },
});
