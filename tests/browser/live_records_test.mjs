// History and alarms of a cell of real processes: its values are drawn, zoomed into, panned and exported, its alarm is
// shelved for a time, suppressed and taken out of service.

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
  const [before] = await span(page);
  await page.keyboard.press('ArrowLeft');
  await until('an arrow pans', async () => (await span(page))[0] < before);
  await shot(page, 'zoomed');
  await page.keyboard.press('0');
  await until('both levels are in the table to keep', async () => {
    const href = await page.getByTestId('history-csv').getAttribute('href');
    const csv = await page.evaluate(async (path) => (await fetch(path)).text(), href);
    return /Main\.level,\d{4}-\d\d-\d\dT[\d:.]+Z,12\.5,good/.test(csv) && /Main\.level,\d{4}-\d\d-\d\dT[\d:.]+Z,60(\.0)?,good/.test(csv);
  });
}

async function hidesAnAlarm(page, cell) {
  const stateIs = (state, what) => waitFor(page, what, (wanted) => document.querySelector('[data-alarm="level.high"]')?.dataset.state === wanted, state);
  await page.getByRole('button', { name: 'Alarms' }).click();
  await stateIs('unacknowledged', 'a level that is too high is an alarm');
  await page.locator('[data-alarm="level.high"] button').click();
  const actions = page.getByRole('group', { name: 'act on level.high' });
  const gives = async (reason, more = {}) => {
    await fill(page, { ...more, Reason: reason });
    await page.keyboard.press('Enter');
    await dialogIsGone(page, `"${reason}" is taken`);
  };
  await actions.getByRole('button', { name: 'Shelve …' }).click();
  await gives('it is known', { Minutes: '60' });
  await page.getByRole('button', { name: 'All', exact: true }).first().click();
  await stateIs('shelved', 'it is shelved for a time');
  await shot(page, 'shelved');
  cell.force('Main.level', '10.0');
  const row = page.locator('[data-alarm="level.high"] button').first();
  if ((await row.getAttribute('aria-expanded')) === 'false') await row.click();
  await actions.getByRole('button', { name: 'Unshelve' }).click();
  await stateIs('normal', 'whose condition has gone meanwhile');
  await actions.getByRole('button', { name: 'Suppress …' }).click();
  await gives('the mixer is cleaned');
  await stateIs('suppressed by design', 'it is suppressed by hand, as its design allows');
  await actions.getByRole('button', { name: 'End suppression' }).click();
  await stateIs('normal', 'until somebody ends that');
  await actions.getByRole('button', { name: 'Out of service …' }).click();
  await gives('the sensor is changed');
  await stateIs('out of service', 'it is taken out of service');
  await shot(page, 'out-of-service');
  cell.force('Main.level', '70.0');
  await actions.getByRole('button', { name: 'Return to service' }).click();
  await stateIs('unacknowledged', 'and returned tells what is so by now');
}

await leadOverPage(given, {
  name: 'live-records',
  start: () => startMixer(given.server, { 'alarms.toml': `${LEVEL_ALARM}suppress_by_hand = true\n` }, KEEPS_RECORDS),
  steps: async (page, cell) => {
    await claims(page, await cell.setupToken());
    await drawsZoomsAndExports(page, cell);
    await hidesAnAlarm(page, cell);
  },
});
