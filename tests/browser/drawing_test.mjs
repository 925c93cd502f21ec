// A plant that somebody has drawn, as it lives on the page of a running cell.

import { leadOverPage } from './page_run.mjs';
import { asks, claims, isAccessible } from './people.mjs';
import { startMixer } from './recipe_cell.mjs';
import { editor, says } from './screen_editor.mjs';
import { check, fitsEachLook, options, pictures, waitFor } from './support.mjs';

const DRAWING = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 400 200">
  <title>Mixer hall</title>
  <rect id="mixer" x="50" y="20" width="100" height="150" fill="#8fa0ad" data-fill="main.LEVEL" data-from="0" data-to="100"><title>Mixer</title></rect>
  <text x="100" y="100" data-text="Main.level" data-digits="1" data-unit="%">-</text>
  <circle id="stirrer" cx="250" cy="80" r="20" fill="#d3d8db" data-on="Main.stir"><title>Stirrer</title></circle>
  <rect id="still" x="300" y="60" width="40" height="40" fill="#d3d8db" data-alarm="!Main.stir"/>
  <text x="250" y="150" data-text="Main.nothing">-</text>
</svg>`;

const given = options();
const shot = pictures(given, 'drawing-');
const part = (id) => `#drawing-${id}`;

async function livesByValues(page) {
  await waitFor(page, 'the drawing is there', () => document.querySelector('[data-testid=drawing][data-bound=true] svg') !== null);
  await waitFor(page, 'the tank is full by an eighth', (tank) => document.querySelector(tank).getAttribute('transform')?.includes('scale(1 0.125)'), part('mixer'));
  await waitFor(page, 'the number is written with its unit', () => [...document.querySelectorAll('[data-testid=drawing] text')].some((one) => one.textContent === '12.5 %'));
  check((await page.locator(part('mixer')).getAttribute('aria-label')) === 'Mixer: 12.5', 'who cannot see it is told its value');
  check((await page.locator('[data-testid=drawing] svg').getAttribute('aria-label')) === 'Mixer hall', 'and what is drawn');
  await page.locator(part('mixer')).focus();
  check((await page.evaluate(() => document.activeElement?.id)) === 'drawing-mixer', 'parts with a title are reached by keyboard');
  await waitFor(page, 'what is bound to nothing is named', () => document.querySelector('[data-testid=unbound]')?.textContent.includes('Main.nothing'));
}

async function followsSwitches(page, mixer) {
  check(!(await page.locator(part('stirrer')).getAttribute('class'))?.includes('on'), 'the stirrer stands');
  await waitFor(page, 'which is an alarm where it is drawn so', (still) => document.querySelector(still).classList.contains('alarm'), part('still'));
  const painted = () => page.locator(part('stirrer')).evaluate((one) => getComputedStyle(one).fill);
  const before = await painted();
  mixer.force('Main.stir', 'TRUE');
  await waitFor(page, 'forced, it runs', (stirrer) => document.querySelector(stirrer).classList.contains('on'), part('stirrer'));
  check((await painted()) !== before, 'in another colour');
  await waitFor(page, 'and the alarm is over', (still) => !document.querySelector(still).classList.contains('alarm'), part('still'));
}

async function fits(page) {
  await fitsEachLook(page, [['light', 1440], ['dark', 1440], ['light', 360]], (look) => shot(page, look));
  await isAccessible(page, 'the page with a drawing');
}

// As the beginning of a screen.
async function becomesAScreen(page, cell) {
  await claims(page, await cell.setupToken());
  await page.getByTestId('no-screens').getByRole('button', { name: 'Draw a screen' }).click();
  await editor(page).getByLabel('Name', { exact: true }).fill('Hall');
  await editor(page).getByRole('button', { name: "Plant's drawing" }).click();
  await says(page, 'The drawing of the plant is here');
  check((await page.locator('[data-testid=canvas] [data-item]').count()) === 5, 'each of its elements can be moved');
  await editor(page).getByRole('button', { name: 'Save' }).click();
  await says(page, 'Saved as version 1');
  await editor(page).getByRole('button', { name: 'Close' }).click();
  await waitFor(page, 'and lives as a screen, too', () =>
    [...document.querySelectorAll('[data-testid=screen] text')].some((one) => one.textContent === '12.5 %'));
  await shot(page, 'screen');
}

// Drawn far from its corner, and looked at on a phone.
async function beginsWhereItIsDrawn(page) {
  const svg = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1200 400"><rect x="700" y="40" width="200" height="100" data-on="Main.stir"/></svg>';
  check((await asks(page, 'PUT', '/api/screens/Wide', { svg, version: 0, comment: 'for a phone' })).status === 200, 'another screen is saved');
  await page.setViewportSize({ width: 360, height: 800 });
  await page.getByRole('navigation').getByRole('button', { name: 'Wide' }).click();
  await waitFor(page, 'which begins where something is drawn', () => {
    const box = document.querySelector('[data-screen=Wide] rect')?.getBoundingClientRect();
    return box !== undefined && box.left >= 0 && box.left < 60;
  });
  await shot(page, 'wide-360');
}

await leadOverPage(given, {
  name: 'drawing',
  start: () => startMixer(given.server, { 'hall.svg': DRAWING }, 'drawing = "hall.svg"\n'),
  steps: async (page, cell) => {
    await livesByValues(page);
    await followsSwitches(page, cell);
    await fits(page);
    await becomesAScreen(page, cell);
    await beginsWhereItIsDrawn(page);
  },
});
