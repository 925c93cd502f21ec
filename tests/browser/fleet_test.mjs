// A floor with vehicles as a person sees it: seven forklifts that a program drives through a mine at twenty times
// real time, drawn with their plan; by mouse, by keyboard alone, and on a telephone.

import { startFleet } from './fleet_chain.mjs';
import { leadOverPage } from './page_run.mjs';
import { check, fitsWidth, options, pictures, waitFor } from './support.mjs';

const VEHICLES = 7;
const SPEED = 20;

const given = options();
const shot = pictures(given, 'fleet-', { fullPage: true });
if (!given.supervisor) throw new Error('--supervisor is missing');

// Notes every place at which the page draws a vehicle, how many polygons each has left and may be in, who waits.
function keepHistory() {
  const seen = { places: {}, left: {}, drawn: {}, held: {}, waits: new Set() };
  const note = (list, value) => {
    if (value !== list.at(-1)) list.push(value);
  };
  const look = () => {
    for (const vehicle of document.querySelectorAll('[data-vehicle]')) {
      note((seen.places[vehicle.dataset.vehicle] ??= []), `${vehicle.dataset.x} ${vehicle.dataset.y}`);
    }
    for (const envelope of document.querySelectorAll('[data-envelope]')) {
      const { envelope: name, left, held, ahead } = envelope.dataset;
      note((seen.left[name] ??= []), Number(left));
      note((seen.drawn[name] ??= []), Number(held) + Number(ahead));
      note((seen.held[name] ??= []), Number(held));
    }
    for (const link of document.querySelectorAll('[data-waits]')) seen.waits.add(link.dataset.waits);
  };
  globalThis.seen = seen;
  new MutationObserver(look).observe(document, { subtree: true, childList: true, characterData: true, attributes: true });
}

async function drawsThePlan(page) {
  await waitFor(page, 'every vehicle is drawn', (count) => document.querySelectorAll('[data-vehicle]').length === count, VEHICLES);
  await waitFor(page, 'every vehicle has a way and polygons to come', (count) =>
    document.querySelectorAll('[data-way]').length === count &&
    [...document.querySelectorAll('[data-envelope]')].every(({ dataset }) => Number(dataset.ahead) > 0), VEHICLES);
  await waitFor(page, 'critical sections are marked', () => document.querySelectorAll('[data-section]').length > 0);
  await waitFor(page, 'missions are drawn over time', (count) =>
    document.querySelectorAll('[data-mission-row] rect.mission').length === count, VEHICLES);
  for (const panel of ['trend', 'state', 'plan']) {
    check((await page.locator(`[data-panel=${panel}]`).count()) === 0, `there is no panel ${panel}`);
  }
}

const numberOf = (page, selector, name) => page.locator(selector).first().getAttribute(name).then(Number);

async function obeysTheKeyboard(page) {
  const floor = page.locator('[data-testid=floor]');
  const whole = await numberOf(page, '[data-testid=floor]', 'data-scale');
  await floor.focus();
  await page.keyboard.press('+');
  await page.keyboard.press('ArrowLeft');
  const near = await numberOf(page, '[data-testid=floor]', 'data-scale');
  check(near > 1.2 * whole, `plus zooms in (${whole} to ${near} pixels a metre)`);
  await page.keyboard.press('0');
  check((await numberOf(page, '[data-testid=floor]', 'data-scale')) === whole, '0 shows everything again');
  await page.keyboard.press('Tab');
  const name = await page.evaluate(() => document.activeElement?.dataset.vehicle);
  check(name !== undefined, `Tab leads from the floor to a vehicle (${name})`);
  await page.keyboard.press('Enter');
  await waitFor(page, 'Enter selects it and shows its mission', (wanted) =>
    document.querySelector('[data-testid=mission]')?.dataset.mission === wanted, name);
  await waitFor(page, 'the chart is that of the vehicle', (wanted) =>
    document.querySelector('[data-panel=sfc] select')?.value.toLowerCase().endsWith(`mission_${wanted}`) &&
    document.querySelectorAll('[data-panel=sfc] .step.active').length === 1, name);
  await page.keyboard.press('Escape');
  await waitFor(page, 'Escape lets it go', () => document.querySelector('[data-testid=mission]') === null);
  return name;
}

async function obeysTheMouse(page) {
  const box = await page.locator('[data-testid=floor]').boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + 3);
  const before = await numberOf(page, '[data-testid=floor]', 'data-scale');
  await page.mouse.wheel(0, -200);
  await waitFor(page, 'the wheel zooms', (scale) => Number(document.querySelector('[data-testid=floor]').dataset.scale) > scale, before);
  await page.getByRole('button', { name: 'All', exact: true }).first().click();
  await page.locator('[data-row=v2] button').click();
  await waitFor(page, 'a row of the table selects its vehicle', () =>
    document.querySelector('[data-vehicle=v2]')?.ariaPressed === 'true');
}

async function tellsWhoIsLost(page, fleet) {
  fleet.tell('lost v3 it has not answered for 2 s');
  await waitFor(page, 'a lost vehicle is told with its reason', () =>
    document.querySelector('[data-alarm=v3]')?.textContent.includes('it has not answered for 2 s') &&
    document.querySelector('[data-vehicle=v3]')?.classList.contains('abnormal'));
}

async function takePictures(page, moment, schemes) {
  for (const [width, scheme] of [[360, schemes[0]], [1440, schemes[1]]]) {
    await page.emulateMedia({ colorScheme: scheme });
    await fitsWidth(page, width);
    await shot(page, `${moment}-${width}-${scheme}`);
  }
}

async function seesThemDrive(page) {
  await waitFor(page, 'every vehicle drives', (count) => {
    const moved = Object.values(globalThis.seen.places).filter((places) => places.length > 5);
    return moved.length === count;
  }, VEHICLES);
  await waitFor(page, 'every vehicle leaves polygons, and has had some of its own', (count) => {
    const { left, held } = globalThis.seen;
    return Object.keys(left).filter((name) => left[name].at(-1) >= 2 && Math.max(...held[name]) > 0).length === count;
  }, VEHICLES);
  await waitFor(page, 'one waits for another', () => globalThis.seen.waits.size > 0);
  await waitFor(page, 'one arrives', () =>
    document.querySelector('[data-row][data-state=resting]') && document.querySelector('[data-goal][data-state=delivered]'));
  const { left, drawn } = await page.evaluate(() => globalThis.seen);
  for (const name of Object.keys(left)) {
    // A busy machine may lose the connection, and the page begins anew with none.
    check(left[name].every((count, at) => at === 0 || count === 0 || count > left[name][at - 1]), `polygons that ${name} has left stay gone: ${left[name]}`);
    check(drawn[name].at(-1) < Math.max(...drawn[name]), `fewer polygons of ${name} are drawn than at the start`);
  }
}

await leadOverPage(given, {
  name: 'fleet',
  watch: keepHistory,
  start: () => startFleet(given, VEHICLES, SPEED),
  steps: async (page, fleet) => {
    await drawsThePlan(page);
    fleet.tell('drive'); // not before: a slow browser would miss most of it
    await obeysTheKeyboard(page);
    await obeysTheMouse(page);
    await takePictures(page, 'during', ['dark', 'light']);
    await seesThemDrive(page);
    await tellsWhoIsLost(page, fleet);
    await takePictures(page, 'after', ['light', 'dark']);
  },
});
