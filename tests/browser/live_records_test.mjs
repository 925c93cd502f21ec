// History and alarms of a cell of real processes: its values are drawn, zoomed into and exported, its alarm is shelved for a time.

import { join } from 'node:path';

import { leadOverPage } from './page_run.mjs';
import { claims, dialogIsGone, fill } from './people.mjs';
import { KEEPS_RECORDS, LEVEL_ALARM, startMixer } from './recipe_cell.mjs';
import { options, until, waitFor } from './support.mjs';

const given = options();
const shot = (page, name) => page.screenshot({ path: join(given.out, `live-records-${name}.png`), fullPage: true, animations: 'disabled' });

const span = (page) => page.getByTestId('history').evaluate((one) => [Number(one.dataset.from), Number(one.dataset.to)]);

async function drawsZoomsAndExports(page, cell) {
  await page.getByRole('button', { name: 'History' }).click();
  await page.getByLabel('Tag to add').fill('Main.level');
  await page.getByRole('button', { name: 'Add' }).click();
  const valueIs = (value, what) =>
    waitFor(page, what, (wanted) => new RegExp(`Main\\.level[\\s\\S]*\\b${wanted}\\b`).test(document.querySelector('[data-testid=history-values] tbody')?.innerText ?? ''), value);
  await valueIs('12.5', 'the level is in the history');
  cell.force('Main.level', '60.0');
  await valueIs('60', 'and so is what it is forced to');
  await page.getByTestId('history').focus();
  const [from, to] = await span(page);
  await page.keyboard.press('+');
  await until('plus zooms in by half', async () => {
    const [a, b] = await span(page);
    return Math.abs(b - a - (to - from) / 2) < 1;
  });
  await shot(page, 'zoomed');
  await page.keyboard.press('0');
  await until('both levels are in the table to keep', async () => {
    const href = await page.getByTestId('history-csv').getAttribute('href');
    const csv = await page.evaluate(async (path) => (await fetch(path)).text(), href);
    return /Main\.level,\d{4}-\d\d-\d\dT[\d:.]+Z,12\.5,good/.test(csv) && /Main\.level,\d{4}-\d\d-\d\dT[\d:.]+Z,60(\.0)?,good/.test(csv);
  });
}

async function shelvesAnAlarm(page, cell) {
  const stateIs = (state, what) => waitFor(page, what, (wanted) => document.querySelector('[data-alarm="level.high"]')?.dataset.state === wanted, state);
  await page.getByRole('button', { name: 'Alarms' }).click();
  await stateIs('unacknowledged', 'a level that is too high is an alarm');
  await page.locator('[data-alarm="level.high"] button').click();
  const actions = page.getByRole('group', { name: 'act on level.high' });
  await actions.getByRole('button', { name: 'Shelve …' }).click();
  await fill(page, { Minutes: '60', Reason: 'it is known' });
  await page.keyboard.press('Enter');
  await dialogIsGone(page, 'its shelf is taken');
  await page.getByRole('button', { name: 'All', exact: true }).first().click();
  await stateIs('shelved', 'it is shelved for a time');
  await shot(page, 'shelved');
  cell.force('Main.level', '10.0');
  const row = page.locator('[data-alarm="level.high"] button').first();
  if ((await row.getAttribute('aria-expanded')) === 'false') await row.click();
  await actions.getByRole('button', { name: 'Unshelve' }).click();
  await stateIs('normal', 'whose condition has gone meanwhile');
}

await leadOverPage(given, {
  name: 'live-records',
  start: () => startMixer(given.server, { 'alarms.toml': LEVEL_ALARM }, KEEPS_RECORDS),
  steps: async (page, cell) => {
    await claims(page, await cell.setupToken());
    await drawsZoomsAndExports(page, cell);
    await shelvesAnAlarm(page, cell);
  },
});
