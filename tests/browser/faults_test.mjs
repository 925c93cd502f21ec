// Faults of a simulated plant as an engineer sets them from the page while the cell runs: list, set, end, who may, what the trail
// has, what `stepwright fault` has set, and a cell without a plant, which has no such button.

import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

import { cellInFolder, cellWithFiles, configurationOf } from './cell_folder.mjs';
import { hiddenFocus, unreadable } from './narrow.mjs';
import { leadOverPage } from './page_run.mjs';
import { addsUsers, asksApi, claims, dialog, dialogIsGone, fill, isAccessible, logsIn } from './people.mjs';
import { check, options, pictures, until, waitFor } from './support.mjs';

const given = options();
const shot = pictures(given, 'faults-', { fullPage: true });

const PLANT = `
[components.source]
type = "source"
pressure = "1 bar"
[components.inlet]
type = "on_off_valve"
kv = "1 m3/h"
in = "source"
out = "tank"
command = "VALVE"
[components.tank]
type = "tank"
volume = "100 l"
start = "50 percent"
[terminals]
VALVE = "%QX0.0"
`;
const PROGRAM = `
PROGRAM Main
  VAR
    valve AT %QX0.0 : BOOL;
  END_VAR
  valve := FALSE;
END_PROGRAM
`;
const SIMULATED = { clock: 'mode = "simulated"\nspeed = 1.0', plant: 'kind = "model"\nfile = "plant.toml"' };

function startTank(program) {
  return cellInFolder(program, 'faults', (folder, port) => {
    writeFileSync(join(folder, 'cell.toml'), configurationOf('faults', 87, port, SIMULATED));
    writeFileSync(join(folder, 'plant.toml'), PLANT);
    writeFileSync(join(folder, 'main.st'), PROGRAM);
    return ['--config', join(folder, 'cell.toml')];
  }).then((cell) =>
    cell.begins(async () => {
      await cell.startRuntime();
      cell.run('compile', cell.file('main.st'), '-o', cell.file('main.swb'));
      cell.run('download', '--config', cell.file('cell.toml'), cell.file('main.swb'), '--replace');
      cell.run('start', '--config', cell.file('cell.toml'));
      cell.start('link');
      await cell.serve();
    }),
  );
}

const rowOf = (page, name) => page.locator(`[data-fault="${name}"]`);
const nowIs = (page, what, name, text) =>
  waitFor(page, what, ([fault, wanted]) => document.querySelector(`[data-fault="${fault}"] [data-now]`)?.innerText.includes(wanted), [name, text]);

async function opensThePanel(page) {
  await waitFor(page, 'a simulated plant has a button for its faults', () => document.querySelector('#faults-open') !== null);
  await page.locator('#faults-open').focus();
  await page.keyboard.press('Enter');
  await waitFor(page, 'the panel lists them with their ranges', () =>
    document.querySelector('[data-fault="tank.leak"]')?.innerText.includes('percent/s'));
  check((await rowOf(page, 'inlet.stuck').count()) === 1, 'those of every component');
  check((await page.locator('#faults button', { hasText: 'Set' }).count()) === 0, 'who only looks can set none');
  await isAccessible(page, 'the panel of faults', '#faults');
}

async function setsAndEnds(page, cell) {
  await rowOf(page, 'tank.leak').getByRole('button', { name: 'Set the fault tank.leak' }).click();
  await fill(page, { Value: 'much', 'Reason, for the audit trail': 'test of the tank' });
  await page.keyboard.press('Enter');
  await waitFor(page, 'what is no number is not set', () => document.querySelector('[data-testid=problem]').innerText.includes('no number'));
  await fill(page, { Value: '999999999' });
  await page.keyboard.press('Enter');
  await waitFor(page, 'nor what the plant cannot have', () => document.querySelector('[data-testid=problem]').innerText.includes('cannot have the value'));
  await isAccessible(page, 'setting a fault', '[data-testid=dialog]');
  await shot(page, 'dialog');
  await fill(page, { Value: '0.5' });
  await page.keyboard.press('Enter');
  await dialogIsGone(page, 'what is right is set, with the keyboard');
  await nowIs(page, 'the plant has it', 'tank.leak', '0.5');
  check((await page.locator('[data-fault]').first().getAttribute('data-fault')) === 'tank.leak', 'what holds stands first');
  await shot(page, 'holding');
  cell.run('fault', '--config', cell.file('cell.toml'), 'inlet.stuck', '1');
  await nowIs(page, 'what the command line sets is seen as well', 'inlet.stuck', '1');
  await rowOf(page, 'tank.leak').getByRole('button', { name: 'End the fault tank.leak' }).click();
  await fill(page, { 'Reason, for the audit trail': 'the test is over' });
  await dialog(page).getByRole('button', { name: 'End', exact: true }).click();
  await dialogIsGone(page, 'it is ended');
  await nowIs(page, 'and does not hold any more', 'tank.leak', 'does not hold');
}

async function isInTheTrail(cell) {
  const trail = () => readFileSync(cell.file('state/access/audit.jsonl'), 'utf8').trim().split('\n').map((line) => JSON.parse(line));
  await until('the trail has both deeds', () => trail().some(({ action }) => action === 'fault.clear'));
  const set = trail().find(({ action, result }) => action === 'fault.set' && result === 'done');
  check(set?.user === 'emil' && set.target === 'tank.leak' && set.after === '0.5' && set.reason === 'test of the tank', 'with who, what and why');
  check(trail().some(({ action, result }) => action === 'fault.set' && result.startsWith('refused')), 'and what was refused');
}

async function fitsAPhone(page) {
  await page.setViewportSize({ width: 360, height: 780 });
  const cut = (await page.evaluate(unreadable)).join('; ');
  check(cut === '', `everything can be read in 360 px ${cut}`);
  await page.locator('#fault-search').focus();
  const hidden = await page.evaluate(hiddenFocus);
  check(hidden === '', `the focus is seen ${hidden}`);
  await page.keyboard.type('leak');
  await waitFor(page, 'names are searched', () => [...document.querySelectorAll('[data-fault]')].every((row) => row.dataset.fault.includes('leak')));
  await shot(page, '360');
  await page.setViewportSize({ width: 1440, height: 900 });
  await page.keyboard.press('Escape');
  await waitFor(page, 'Escape closes the panel, and the focus goes back', () =>
    document.querySelector('#faults') === null && document.activeElement?.id === 'faults-open');
}

await leadOverPage(given, {
  name: 'faults',
  expected: [400, 401, 403, 409, 422],
  start: () => startTank(given.server),
  steps: async (page, cell) => {
    await opensThePanel(page);
    await claims(page, await cell.setupToken());
    await addsUsers(page);
    await logsIn(page, 'olga');
    const status = await asksApi(page, '/api/faults/set', { name: 'tank.leak', value: 1, reason: 'by hand' });
    check(status.startsWith('403'), `an operator may not set one (${status})`);
    await logsIn(page, 'emil');
    await setsAndEnds(page, cell);
    await isInTheTrail(cell);
    await fitsAPhone(page);
  },
});

await leadOverPage(given, {
  name: 'faults-none',
  start: async () => {
    const cell = await cellWithFiles(given.server, 'no-plant', { domain: 88, files: { 'main.st': PROGRAM } });
    return cell.runs(() => {
      cell.run('compile', cell.file('main.st'), '-o', cell.file('main.swb'));
      cell.download('main.swb');
    });
  },
  steps: async (page, cell) => {
    await waitFor(page, 'the page of a cell without a simulated plant is there', () => document.querySelector('[data-scan=state]') !== null);
    await until('its list of faults is empty', async () => (await (await fetch(`${cell.url}api/faults`)).json()).faults?.length === 0);
    check((await page.locator('#faults-open').count()) === 0, 'and it has no button for them');
  },
});
