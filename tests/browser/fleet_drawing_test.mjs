// A floor that somebody has drawn: vehicles and pallets where their poses are, switches as they are; and
// the floor plan beside it.

import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

import { startDemo } from './demo_process.mjs';
import { hiddenFocus, unreadable } from './narrow.mjs';
import { leadOverPage } from './page_run.mjs';
import { isAccessible } from './people.mjs';
import { check, fitsEachLook, options, pictures, until, waitFor } from './support.mjs';

const SPEED = 2; // the job takes 106 s
const SCALE = 20; // of the drawing
const HEIGHT = 840;
const PALLET = { x: 7, y: 35 }; // where nobody drives
const DRAWN_PALLET = `<rect id="pallet1" x="-12" y="-8" width="24" height="16" fill="var(--liquid)" stroke="var(--line-strong)" data-show="pallet p1.state"
  data-pose-x="pallet p1.x" data-pose-y="pallet p1.y" data-pose-heading="pallet p1.angle"><title>pallet 1</title></rect>`;

const given = options();
const shot = pictures(given, 'fleet-drawing-');
const part = (id) => `#drawing-${id}`;

// Where an element of the drawing is, in m and degrees of the floor; null while it is where it was drawn.
const poseOf = (page, id) =>
  page.evaluate(([selector, scale, height]) => {
    const [, x, y, turn] = /^translate\((\S+) (\S+)\) rotate\((\S+)\)/.exec(document.querySelector(selector)?.getAttribute('transform') ?? '') ?? [];
    return x === undefined ? null : { x: Number(x) / scale, y: (height - Number(y)) / scale, heading: -Number(turn) };
  }, [part(id), SCALE, HEIGHT]);

async function drawsVehiclesWhereTheyAre(page) {
  await waitFor(page, 'the drawing is there', () => document.querySelector('[data-testid=drawing][data-bound=true] svg') !== null);
  await until('all six trucks have a pose', async () => (await Promise.all([1, 2, 3, 4, 5, 6].map((v) => poseOf(page, `v${v}`)))).every((pose) => pose !== null));
  const first = await poseOf(page, 'v1');
  check(first.x > 0 && first.x < 62 && first.y > 0 && first.y < 42, `truck 1 is on the floor (${JSON.stringify(first)})`);
  const bounds = await page.evaluate(([truck, plan]) => {
    const box = document.querySelector(truck).getBoundingClientRect();
    const floor = document.querySelector(plan).getBoundingClientRect();
    return { inside: box.left >= floor.left && box.right <= floor.right && box.top >= floor.top && box.bottom <= floor.bottom, wide: box.width / floor.width };
  }, [part('v1'), '[data-testid=drawing] svg']);
  check(bounds.inside && bounds.wide > 0.01 && bounds.wide < 0.1, `and in the picture, as large as it is (${bounds.wide.toFixed(3)})`);
  check((await page.getByTestId('unbound').count()) === 0, 'everything is bound to something');
  check((await page.locator(part('v1')).getAttribute('aria-label')).startsWith('truck 1: '), 'who cannot see it is told where it is');
}

async function drawsThemMoving(page) {
  const before = await Promise.all([1, 2, 3, 4, 5, 6].map((v) => poseOf(page, `v${v}`)));
  let moved = 0;
  await until('a truck drives and turns', async () => {
    const now = await Promise.all([1, 2, 3, 4, 5, 6].map((v) => poseOf(page, `v${v}`)));
    moved = now.filter((pose, i) => Math.hypot(pose.x - before[i].x, pose.y - before[i].y) > 3 && Math.abs(pose.heading - before[i].heading) > 10).length;
    return moved > 0;
  });
  await waitFor(page, 'one that drives is lit', () => {
    const lit = document.querySelector('[data-testid=drawing] [data-on$=".enable"].on');
    const rack = document.querySelector('[data-testid=drawing] svg > rect[fill="var(--equipment)"]');
    return lit !== null && getComputedStyle(lit).fill !== getComputedStyle(rack).fill;
  });
  // However late the page comes: never do all six carry something at once.
  await waitFor(page, 'and who carries nothing is drawn so', () => document.querySelector('[data-testid=drawing] [data-show$=".loaded"].hidden') !== null);
}

async function drawsPallets(page) {
  const pallet = await poseOf(page, 'pallet1');
  check(Math.hypot(pallet.x - PALLET.x, pallet.y - PALLET.y) < 0.2, `the pallet is where it stands (${JSON.stringify(pallet)})`);
  check(!(await page.locator(part('pallet1')).getAttribute('class'))?.includes('hidden'), 'and can be seen');
}

// A truck of the floor plan and of the drawing are at the same place.
async function agreesWithTheFloorPlan(page) {
  await page.getByRole('button', { name: 'As drawn' }).press('Enter');
  await waitFor(page, 'the floor plan can be looked at instead', () => document.querySelectorAll('[data-testid=floor] [data-vehicle]').length === 6);
  await page.getByRole('button', { name: 'As drawn' }).press('Enter');
  await waitFor(page, 'and the drawing again', () => document.querySelector('[data-testid=drawing][data-bound=true] svg') !== null);
}

// All of a fleet's page, at the width that it has, by keyboard.
async function isReadOnAPhone(page, what) {
  const cut = await page.evaluate(unreadable);
  check(cut.length === 0, `${what} nothing is cut off ${cut.join('; ')}`);
  await page.evaluate(() => {
    document.activeElement?.blur();
    document.querySelector('[data-testid=preferences]').focus();
  });
  const panels = new Set();
  for (let turn = 0; turn < 250; ++turn) {
    await page.keyboard.press('Tab');
    const fault = await page.evaluate(hiddenFocus);
    if (fault !== '') throw new Error(`not so: ${what} the focus can be seen: ${fault}`);
    const panel = await page.evaluate(() => document.activeElement?.closest('[data-panel]')?.dataset.panel ?? '');
    if (panel !== '') panels.add(panel);
    if (panel === 'tags') break;
  }
  for (const panel of ['floor', 'vehicles', 'mission', 'gantt', 'goals', 'sfc', 'scan', 'tags']) {
    check(panels.has(panel), `${what} Tab comes through the panel ${panel}`);
  }
}

await leadOverPage(given, {
  name: 'fleet-drawing',
  start: () => {
    const drawing = join(given.out, 'fleet-drawing.svg'); // that of the cell, and a pallet
    writeFileSync(drawing, readFileSync(join(given.cell, '..', 'drawing.svg'), 'utf8').replace('</svg>', `${DRAWN_PALLET}</svg>`));
    return startDemo(given.server, SPEED, given.cell, [
      '--set', `hmi.drawing="${drawing}"`,
      '--set', `plant.pallets=[{x_m=${PALLET.x}.0, y_m=${PALLET.y}.0, heading_deg=0.0}]`,
    ]);
  },
  steps: async (page) => {
    await drawsVehiclesWhereTheyAre(page);
    await drawsPallets(page);
    await shot(page, 'begin');
    await drawsThemMoving(page);
    await fitsEachLook(page, [['light', 1440], ['dark', 1440], ['light', 360]], (look) => shot(page, look));
    await isAccessible(page, 'the page of a floor that is drawn');
    await isReadOnAPhone(page, 'with the drawing');
    await agreesWithTheFloorPlan(page);
    await page.getByRole('button', { name: 'As drawn' }).press('Enter');
    await isReadOnAPhone(page, 'with the floor plan');
  },
});
