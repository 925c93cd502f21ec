// History and alarms of a cell of real processes: its values are drawn, zoomed into, panned and exported, its alarm is
// shelved for a time, suppressed and taken out of service.

import { leadOverPage } from './page_run.mjs';
import { claims, dialogIsGone, fill } from './people.mjs';
import { KEEPS_RECORDS, LEVEL_ALARM, startMixer } from './recipe_cell.mjs';
import { options, pictures, until, waitFor } from './support.mjs';

const given = options();
const shot = pictures(given, 'live-records-', { fullPage: true });

const span = (page) => page.getByTestId('history').evaluate((one) => [Number(one.dataset.from), Number(one.dataset.to)]);

const DESCRIBED = `
[tags."main.LEVEL"]
unit = "%"
description = "how full the mixer is"
group = "mixer"
decimals = 1
range = [0, 50]
`;

// By what the tags are described with, not by their names.
async function describesTags(page, cell) {
  const search = page.getByLabel('Search tags by name or address');
  const shows = (what, words) =>
    waitFor(page, what, (wanted) => {
      const text = document.querySelector('[role=region][aria-label="tag values"]')?.innerText ?? '';
      return wanted.every((word) => text.includes(word));
    }, words);
  await search.fill('full the mixer');
  await shows('a tag has its unit and is described', ['Main.level', 'mixer · how full the mixer is', '12.5 %']);
  cell.force('Main.level', '60.04');
  await shows('its decimals are those that the cell says', ['60.0 %']);
  await waitFor(page, 'a value beyond what is normal is marked', () => document.querySelector('td.abnormal')?.title === 'normal is 0 to 50');
  await shot(page, 'described');
  await search.fill('batches in a row');
  await shows('the comment of a declaration describes a tag, too', ['Main.batches', 'batches in a row']);
  await search.fill('Main.phase');
  await shows('a value of an enumeration has its name', ['Main.phase', 'Waiting']);
  cell.force('Main.stir', 'TRUE');
  await shows('and the name of the next one', ['Mixing']);
  cell.force('Main.level', '12.5'); // nobody else writes it
  cell.run('unforce', '--config', cell.config, 'Main.stir');
  cell.run('unforce', '--config', cell.config, 'Main.level');
  await search.fill('');
}

async function drawsZoomsAndExports(page, cell) {
  await page.getByRole('button', { name: 'History' }).click();
  await page.getByLabel('Tag to add').fill('Main.level');
  await page.getByRole('button', { name: 'Add' }).click();
  const valueIs = (value, what) =>
    waitFor(page, what, (wanted) => new RegExp(`Main\\.level[\\s\\S]*\\b${wanted}\\b`).test(document.querySelector('[data-testid=history-values] tbody')?.innerText ?? ''), value);
  await valueIs('12.5', 'the level is in the history');
  await waitFor(page, 'with its unit', () => document.querySelector("[data-testid=history-values] tbody").innerText.includes("12.5 %"));
  await waitFor(page, 'and what it is', () => document.querySelector('[data-testid=history-values] tbody').innerText.includes('how full the mixer is (Main.level)'));
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
  start: () => startMixer(given.server, { 'alarms.toml': `${LEVEL_ALARM}suppress_by_hand = true\n` }, KEEPS_RECORDS + DESCRIBED),
  steps: async (page, cell) => {
    await claims(page, await cell.setupToken());
    await describesTags(page, cell);
    await drawsZoomsAndExports(page, cell);
    await hidesAnAlarm(page, cell);
  },
});
