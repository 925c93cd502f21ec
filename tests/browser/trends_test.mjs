// Trends that people keep: groups that are saved for everybody, axes, the day before, what a reload leaves; all alarms in sight
// acknowledged at once, the tone and who has muted it, searches of journal and trail, and a display on the wall.

import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { asks, axeFile, dialog, isAccessible, logsIn } from './people.mjs';
import { check, endInTime, failurePicture, fitsEveryWidth, launchBrowser, openPage, options, pictures, startServer, until, waitFor } from './support.mjs';

const given = options();
const folder = mkdtempSync(join(tmpdir(), 'hmi-trends-'));
const shot = pictures(given, 'trends-', { fullPage: true });

// Tones are counted: nobody hears a test.
function listensToTones() {
  globalThis.tones = 0;
  globalThis.AudioContext = class {
    state = 'running';
    currentTime = 0;
    destination = {};
    createGain() {
      return { gain: { setValueAtTime() {}, exponentialRampToValueAtTime() {} }, connect: (to) => to };
    }
    createOscillator() {
      return { frequency: {}, connect: (to) => to, start: () => (globalThis.tones += 1), stop() {} };
    }
  };
}

const tagsShown = (page) => page.locator('[data-testid=history-values] tbody tr').evaluateAll((rows) => rows.map((row) => row.dataset.tag));

async function savesAGroup(page) {
  await page.getByRole('button', { name: 'History' }).click();
  await waitFor(page, 'the history is there', () => document.querySelectorAll('[data-testid=history-values] tbody tr').length === 3);
  check((await page.getByRole('button', { name: 'Save as group …' }).count()) === 0, 'whoever only looks saves nothing');
  await logsIn(page, 'operator');
  await page.getByLabel('Tag to add').fill('B1');
  await page.getByRole('button', { name: 'Add', exact: true }).click();
  await waitFor(page, 'a truth value joins in', () => document.querySelector('[data-tag=B1]') !== null);
  await page.getByLabel(/^axis of .*a1\.level/).selectOption('range');
  await page.getByLabel(/^lower end .*a1\.level/).fill('-10');
  await page.getByLabel(/^upper end .*a1\.level/).fill('110');
  await page.getByLabel(/^upper end .*a1\.level/).press('Tab');
  await page.getByLabel(/^axis of .*a2\.level/).selectOption('own');
  await page.getByRole('button', { name: '1 h', exact: true }).click();
  await page.getByRole('button', { name: 'Save as group …' }).click();
  await page.getByLabel('name of the group').fill('filling & more');
  await page.getByRole('button', { name: 'Save', exact: true }).click();
  await waitFor(page, 'who saved it is told', () => document.querySelector('[data-testid=trend-saved]')?.innerText.includes('operator'));
  const [group] = (await asks(page, 'GET', '/api/trends')).json.groups;
  check(group.name === 'filling & more' && group.tags.includes('B1') && group.span_s === 3600, 'the server has the group');
  check(group.axes['points/a1.level'] === '-10..110' && group.axes['points/a2.level'] === 'own', `with its axes (${JSON.stringify(group.axes)})`);
  await shot(page, 'saved');
  await isAccessible(page, 'a history with groups and axes');
}

async function survivesAReload(page) {
  const before = await tagsShown(page);
  await page.reload();
  await page.getByRole('button', { name: 'History' }).click();
  await waitFor(page, 'what was chosen is there after a reload', (count) => document.querySelectorAll('[data-testid=history-values] tbody tr').length === count, before.length);
  check((await tagsShown(page)).join() === before.join(), `the same tags (${before})`);
  check((await page.getByLabel(/^upper end .*a1\.level/).inputValue()) === '110', 'and axes');
  check((await page.getByRole('button', { name: '1 h', exact: true }).getAttribute('aria-pressed')) === 'true', 'and span');
  await page.getByRole('button', { name: 'remove B1' }).click();
  await waitFor(page, 'one goes', () => document.querySelector('[data-tag=B1]') === null);
  await waitFor(page, 'what is seen is not the group any more', () => document.querySelector('[data-testid=trend-groups]').selectedOptions[0]?.text === 'filling & more, changed');
  await page.getByTestId('trend-groups').selectOption('');
  await page.getByTestId('trend-groups').selectOption('filling & more');
  await waitFor(page, 'and the group brings it back', () => document.querySelector('[data-tag=B1]') !== null);
}

async function comparesWithTheDayBefore(page) {
  const asked = page.waitForRequest((request) => {
    const from = Number(new URL(request.url()).searchParams.get('from_ms'));
    return request.url().includes('/api/history/trend') && from > 0 && Date.now() - from > 80_000_000;
  });
  await page.getByTestId('compare').check();
  await asked;
  await waitFor(page, 'a day before has a column of its own', () => document.querySelector('[data-testid=history-values] thead').innerText.includes('Day before'));
  await fitsEveryWidth(page, [1440, 768, 360], shot);
  await page.getByTestId('compare').uncheck();
}

// More scales than axes: the others are told in words. More lines than colours: the others are dashed.
async function tellsWhatHasNoAxis(page) {
  const before = await tagsShown(page);
  const free = (await asks(page, 'GET', '/api/history/tags')).json.tags.filter((tag) => !before.includes(tag));
  check((await page.getByTestId('no-axis').count()) === 0, 'with few scales each has its axis');
  for (const tag of free.slice(0, 7 - before.length)) {
    await page.getByLabel('Tag to add').fill(tag);
    await page.getByRole('button', { name: 'Add', exact: true }).click();
    await waitFor(page, `${tag} joins in`, (wanted) => [...document.querySelectorAll('[data-testid=history-values] tbody tr')].some(({ dataset }) => dataset.tag === wanted), tag);
  }
  for (const axis of await page.getByLabel(/^axis of /).all()) await axis.selectOption('own');
  const last = (await tagsShown(page)).at(-1);
  await waitFor(page, 'what has no axis is named with its range', (tag) => new RegExp(`${tag} \\(.+ to .+\\)`).test(document.querySelector('[data-testid=no-axis]')?.innerText ?? ''), last);
  check((await page.locator('[data-testid=history-values] i.dashed').count()) === 1, 'the seventh line is dashed, in the legend, too');
  await shot(page, 'many-axes');
  await page.getByTestId('trend-groups').selectOption('');
  await page.getByTestId('trend-groups').selectOption('filling & more');
  await until('the group is shown again', async () => (await tagsShown(page)).join() === before.join());
}

const savedGroup = async (page, wanted) => (await asks(page, 'GET', '/api/trends')).json.groups.find(({ name }) => name === wanted);

// A group keeps and names what there is no history of.
async function namesWhatIsMissing(page) {
  const saved = await asks(page, 'PUT', '/api/trends/partly%20dead', { tags: ['B1', 'Main.sinee'], axes: {}, span_s: 60 });
  check(saved.status === 200, `a group with a tag that is not there is saved (${saved.status})`);
  const savedMs = (await savedGroup(page, 'partly dead')).saved_ms;
  await page.getByTestId('trend-groups').focus();
  await waitFor(page, 'it is listed', () => [...document.querySelectorAll('[data-testid=trend-groups] option')].some(({ value }) => value === 'partly dead'));
  await page.getByTestId('trend-groups').selectOption('partly dead');
  await waitFor(page, 'the tag that is not there is named', () => document.querySelector('[data-missing="Main.sinee"]')?.innerText.includes('There is no history of “Main.sinee”.'));
  check((await tagsShown(page)).includes('B1'), 'the others are drawn');
  await page.reload();
  await page.getByRole('button', { name: 'History' }).click();
  await waitFor(page, 'after a reload, too', () => document.querySelector('[data-missing="Main.sinee"]') !== null);
  for (const name of ['.', '..', ' ']) {
    await page.getByRole('button', { name: 'Save as group …' }).click();
    await page.getByLabel('name of the group').fill(name);
    await page.getByRole('button', { name: 'Save', exact: true }).click();
    await waitFor(page, `'${name}' names no group`, () => document.body.innerText.includes('A group needs a name that is not only dots.'));
    await page.getByRole('button', { name: 'Cancel', exact: true }).click();
  }
  await page.getByRole('button', { name: 'Save as group …' }).click();
  await page.getByRole('button', { name: 'Save', exact: true }).click();
  await waitFor(page, 'whoever replaces a group is asked first', () => /“partly dead”, saved by operator/.test(document.querySelector('dialog')?.innerText ?? ''));
  await page.keyboard.press('Escape');
  check((await savedGroup(page, 'partly dead')).saved_ms === savedMs, 'and has replaced nothing by that');
  await page.getByRole('button', { name: 'Save', exact: true }).click();
  await dialog(page).getByRole('button', { name: 'Replace group' }).click();
  await waitFor(page, 'then it is replaced', () => document.querySelector('dialog') === null && document.querySelector('#trend-name') === null);
  await until('saved again it is whole', async () => {
    const group = await savedGroup(page, 'partly dead');
    return group.tags.join() === 'B1,Main.sinee' && group.span_s === 60;
  });
  await removes(page, 'partly dead');
  await page.getByTestId('trend-groups').selectOption('filling & more');
}

async function removes(page, name) {
  await page.getByRole('button', { name: 'Remove group' }).click();
  check((await dialog(page).innerText()).includes(`“${name}”`), 'it is asked for first');
  await dialog(page).getByRole('button', { name: 'Remove group' }).click();
  await waitFor(page, 'and done', () => document.querySelector('dialog') === null);
}

async function removesTheGroup(page) {
  await removes(page, 'filling & more');
  await waitFor(page, 'a group goes', () => document.querySelector('[data-testid=trend-saved]') === null);
  check((await asks(page, 'GET', '/api/trends')).json.groups.length === 0, 'for everybody');
  await page.getByRole('button', { name: 'History' }).click();
}

async function acknowledgesAllInSight(page, server) {
  await page.getByRole('button', { name: 'Alarms' }).click();
  server.tell('runtime off');
  await waitFor(page, 'an alarm comes', () => document.querySelector('[data-alarm="runtime.lost"]')?.dataset.state === 'unacknowledged');
  await waitFor(page, 'and is heard', () => globalThis.tones > 0);
  await page.getByTestId('sound').click();
  check((await page.getByTestId('sound').getAttribute('aria-pressed')) === 'false', 'whoever is here mutes it');
  check((await page.evaluate(() => localStorage.getItem('stepwright.sound.operator'))) === 'muted', 'for herself');
  await shot(page, 'all');
  await page.getByRole('button', { name: /^Acknowledge .* in sight$/ }).click();
  await waitFor(page, 'all in sight are acknowledged with one click', () => document.querySelector('[data-alarm="runtime.lost"]')?.dataset.state === 'acknowledged');
  // The answer to the request may come after the news of the alarm.
  await until('and counted', async () => /^\d+ acknowledged$/.test(await page.getByTestId('acknowledged').innerText()));
  server.tell('runtime on');
  await waitFor(page, 'it returns', () => document.querySelector('[data-alarm="runtime.lost"]') === null);
}

async function searchesJournalAndTrail(page) {
  await page.getByRole('button', { name: 'Journal' }).click();
  const rows = () => page.locator('[data-testid=journal] tbody tr').evaluateAll((all) => all.map(({ dataset }) => dataset.event));
  await page.getByLabel('Who', { exact: true }).fill('operator');
  await until('the journal is searched by person', async () => {
    const found = await rows();
    return found.length > 0 && found.every((event) => event === 'acknowledge');
  });
  await page.getByLabel('Text', { exact: true }).fill('runtime.lost');
  await until('and by text', async () => (await rows()).join() === 'acknowledge');
  await page.getByLabel('Text', { exact: true }).fill('');
  await page.getByLabel('Alarm', { exact: true }).fill('TIME.lo');
  await until('and by a part of the alarm, in any case', async () => (await rows()).join() === 'acknowledge');
  await page.getByLabel('To', { exact: true }).fill('2020-01-01T00:00');
  await until('and by time', async () => (await rows()).length === 0);
  await isAccessible(page, 'the searched journal');
  await page.getByRole('button', { name: 'Notifications' }).click();
  await waitFor(page, 'a cell that notifies nobody says so', () => document.querySelector('[data-panel=alarms]').innerText.includes('Nobody is notified'));
  await page.getByRole('button', { name: 'Standing' }).click();

  await logsIn(page, 'engineer');
  await page.getByRole('button', { name: 'Audit' }).click();
  const entries = () => dialog(page).locator('tbody tr').evaluateAll((all) => all.map(({ dataset }) => dataset.action));
  await dialog(page).getByLabel('Text', { exact: true }).fill('trend.save');
  await until('the trail is searched by text', async () => (await entries()).length > 1 && (await entries()).every((action) => action === 'trend.save'));
  await dialog(page).getByLabel('Text', { exact: true }).fill('');
  await dialog(page).getByLabel('Target', { exact: true }).fill('RUNTIME.lost');
  await until('and by what it was done to', async () => (await entries()).join() === 'alarm.acknowledge');
  await shot(page, 'trail');
  await isAccessible(page, 'the searched trail');
  await page.keyboard.press('Escape');
}

async function hangsOnTheWall(context, url) {
  const { page, problems } = await openPage(context, `${url}#wall`);
  await waitFor(page, 'a display on the wall shows the chosen panels', () =>
    [...document.querySelectorAll('[data-testid=wall] [data-panel]')].map(({ dataset }) => dataset.panel).join() === 'alarms,synoptic,trend');
  check((await page.getByTestId('log-in').count()) + (await page.getByTestId('log-out').count()) === 0, 'without anybody to log in');
  check((await page.getByRole('button', { name: /Acknowledge|Hold|Stop|Abort/ }).count()) === 0, 'and nothing that acts, although somebody has logged in with this browser');
  await isAccessible(page, 'a display on the wall');
  await shot(page, 'wall');
  check(problems.length === 0, `and nothing goes wrong ${problems.join('; ')}`);
  await page.close();
}

endInTime();
const server = await startServer(given.server, 0, 4, 24, folder);
server.tell('run');
const browser = await launchBrowser(given);
let opened;
try {
  await browser.context.addInitScript({ path: axeFile(given.modules) });
  await browser.context.addInitScript(listensToTones);
  opened = await openPage(browser.context, server.url);
  const { page, problems } = opened;
  await savesAGroup(page);
  await survivesAReload(page);
  await comparesWithTheDayBefore(page);
  await tellsWhatHasNoAxis(page);
  await namesWhatIsMissing(page);
  await removesTheGroup(page);
  await acknowledgesAllInSight(page, server);
  await searchesJournalAndTrail(page);
  await hangsOnTheWall(browser.context, server.url);
  check(problems.length === 0, `no errors, no foreign requests, no policy violations ${problems.join('; ')}`);
} catch (error) {
  if (opened) await failurePicture(given, 'trends', opened.page);
  throw error;
} finally {
  await browser.close();
  await server.stop();
  rmSync(folder, { recursive: true, force: true });
}
