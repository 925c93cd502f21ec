// History and alarms as a person would use them, against the real server over a scripted bench: zoom, pan, marks, CSV, an
// alarm that comes and goes, its journal, and a server that is killed and started again.

import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { axeFile, dialog, fill, isAccessible, PASSWORD } from './people.mjs';
import { check, drawn, failurePicture, fitsEveryWidth, launchBrowser, openPage, options, pictures, startServer, until, waitFor } from './support.mjs';

const given = options();
const folder = mkdtempSync(join(tmpdir(), 'hmi-records-'));
const shot = pictures(given, 'records-', { fullPage: true });
const span = (page) => page.getByTestId('history').evaluate((node) => [Number(node.dataset.from), Number(node.dataset.to)]);

async function opensOnlyWhenAsked(page) {
  const fetched = [];
  page.on('request', (request) => fetched.push(request.url()));
  await waitFor(page, 'the bar says how it stands', () => document.querySelector('[data-testid=alarm-summary]') !== null);
  check(!(await page.evaluate(() => performance.getEntriesByType('resource').some((one) => /AlarmPanel|HistoryPanel/.test(one.name)))), 'neither panel was fetched at the start');
  await page.getByRole('button', { name: 'History' }).click();
  await waitFor(page, 'the history has a table of values', () => document.querySelectorAll('[data-testid=history-values] tbody tr').length === 3);
  check(fetched.some((url) => url.includes('HistoryPanel')), 'it is fetched when it is opened');
}

async function drawsTheHistory(page) {
  await waitFor(page, 'the chart has ink', () => {
    const canvas = document.querySelector('[data-testid=history] canvas');
    if (!canvas) return false;
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    const colours = new Set();
    for (let i = 0; i < data.length; i += 4) if (data[i + 3] === 255) colours.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
    return colours.size > 5;
  });
  await waitFor(page, 'values are known', () =>
    /\d/.test(document.querySelector('[data-testid=history-values] tbody tr td:nth-child(4)').innerText));
}

async function zoomsAndPans(page) {
  const chart = page.getByTestId('history');
  await chart.focus();
  const [from, to] = await span(page);
  await page.keyboard.press('+');
  await until('plus zooms in by half', async () => {
    const [a, b] = await span(page);
    return Math.abs(b - a - (to - from) / 2) < 1;
  });
  const [a] = await span(page);
  await page.keyboard.press('ArrowLeft');
  await until('an arrow pans', async () => (await span(page))[0] < a);
  const box = await chart.locator('.u-over').boundingBox();
  const before = await span(page);
  await page.mouse.move(box.x + box.width * 0.25, box.y + 40);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.75, box.y + 60, { steps: 4 });
  await page.mouse.up();
  await until('dragging zooms to what was marked', async () => {
    const [x, y] = await span(page);
    return Math.abs((y - x) / (before[1] - before[0]) - 0.5) < 0.02;
  });
  await page.keyboard.press('0');
  await page.getByRole('button', { name: '10 min', exact: true }).click();
  await until('0 follows the newest', async () => {
    const [x, y] = await span(page);
    await new Promise((resolve) => setTimeout(resolve, 100));
    return y - x > 599_000 && (await span(page))[1] >= y;
  });
}

async function measuresAndExports(page) {
  const box = await page.getByTestId('history').locator('.u-over').boundingBox();
  await page.mouse.click(box.x + box.width - 4, box.y + 50);
  await waitFor(page, 'a click leaves a mark to measure from', () =>
    document.querySelector('[data-testid=history-values] thead').innerText.includes('since'));
  await page.getByRole('button', { name: 'remove the mark' }).click();
  await page.getByLabel('Tag to add').fill('B17');
  await page.getByRole('button', { name: 'Add' }).click();
  check((await page.getByTestId('history-refusal').innerText()) === 'There is no history of “B17”.', 'a name that is none is told');
  await page.getByLabel('Tag to add').fill('b1');
  await page.getByRole('button', { name: 'Add' }).click();
  await waitFor(page, 'a variable of the program joins in', () => document.querySelector('[data-tag=B1]') !== null);
  const href = await page.getByTestId('history-csv').getAttribute('href');
  const csv = await page.evaluate(async (path) => {
    const answer = await fetch(path);
    return { type: answer.headers.get('content-type'), kept: answer.headers.get('content-disposition'), text: await answer.text() };
  }, href);
  check(csv.type.startsWith('text/csv') && csv.kept.includes('history.csv'), 'the CSV is a table to keep');
  const lines = csv.text.trim().split('\r\n');
  check(lines[0] === 'tag,time,value,quality' && lines.length > 10, `with a line for each sample (${lines.length})`);
  check(lines.some((line) => /^points\/a1\.level,\d{4}-\d\d-\d\dT[\d:.]+Z,[\d.]+,good$/.test(line)), 'of the levels');
}

async function showsAnAlarm(page, server) {
  await page.getByRole('button', { name: 'Alarms' }).click();
  server.tell('runtime off');
  await waitFor(page, 'a lost runtime is an alarm of the highest priority', () =>
    document.querySelector('[data-alarm="runtime.lost"]')?.dataset.state === 'unacknowledged');
  check((await page.getByTestId('alarm-summary').innerText()).includes('The runtime does not answer'), 'the bar tells it');
  await page.locator('[data-alarm="runtime.lost"] button').press('Enter');
  check((await page.getByTestId('alarm-list').innerText()).includes('see whether the runtime and its link are running'), 'with what to do');
  await shot(page, 'alarm');
  server.tell('runtime on');
  await waitFor(page, 'it returns, and waits to be acknowledged', () =>
    document.querySelector('[data-alarm="runtime.lost"]')?.dataset.state === 'returned, unacknowledged');
  const bar = await page.getByTestId('alarm-summary').innerText();
  check(/The runtime does not answer\s*over\s*0 active, 1 unacknowledged/.test(bar), `and the bar does not take it for one that stands (${bar.replaceAll('\n', ' ')})`);
  await shot(page, 'returned');
  await page.getByRole('button', { name: 'Journal' }).click();
  await waitFor(page, 'the journal has both', () =>
    document.querySelectorAll('[data-testid=journal] [data-event=raise]').length >= 1 &&
    document.querySelectorAll('[data-testid=journal] [data-event=return]').length >= 1);
  await page.getByLabel('Alarm', { exact: true }).fill('none');
  await waitFor(page, 'a filter that fits nothing leaves nothing', () => document.querySelectorAll('[data-testid=journal] tbody tr').length === 0);
  await page.getByLabel('Alarm', { exact: true }).fill('');
  await page.getByRole('button', { name: 'All', exact: true }).first().click();
  await waitFor(page, 'all alarms are listed when asked for', () => document.querySelectorAll('[data-alarm]').length > 5);
}

const stateOf = (page, alarm, state, what) =>
  waitFor(page, what, ([name, wanted]) => document.querySelector(`[data-alarm="${name}"]`)?.dataset.state === wanted, [alarm, state]);

async function logsIn(page, name) {
  if ((await page.getByTestId('log-out').count()) > 0) await page.getByTestId('log-out').click();
  await page.keyboard.press('Shift'); // it lies where the other one was: the second click of a double click would not be meant for it
  await page.getByTestId('log-in').click();
  await fill(page, { Name: name, Password: PASSWORD });
  await page.keyboard.press('Enter');
  await waitFor(page, `${name} logs in`, () => document.querySelector('[data-testid=dialog]') === null);
  await waitFor(page, 'and sees the cell and its alarms', () =>
    document.querySelector('[data-testid=link]').innerText === 'live' && document.querySelector('[data-testid=alarm-list]') !== null);
}

// From all alarms, the row of one opened, which may be open already.
async function opens(page, alarm) {
  const row = page.locator(`[data-alarm="${alarm}"] button`);
  if ((await row.getAttribute('aria-expanded')) === 'false') await row.click();
  const actions = page.getByRole('group', { name: `act on ${alarm}` });
  await until(`what may be done to ${alarm} is there`, async () => (await actions.count()) === 1);
  return actions;
}

async function gives(page, reason, more = {}) {
  await fill(page, { ...more, Reason: reason });
  await page.keyboard.press('Enter');
  await waitFor(page, `"${reason}" is taken`, () => document.querySelector('[data-testid=dialog]') === null);
}

async function actsOnAlarms(page) {
  await page.locator('[data-alarm="runtime.lost"] button').click();
  check((await page.getByRole('button', { name: 'Acknowledge' }).count()) === 0, 'whoever only looks has no buttons that act');
  const refused = await page.evaluate(async () => {
    const asked = { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: '{"name": "runtime.lost"}' };
    return (await fetch('/api/alarms/acknowledge', asked)).status;
  });
  check(refused === 401, `and the server would refuse them (${refused})`);

  await logsIn(page, 'operator');
  const lost = await opens(page, 'runtime.lost');
  check((await lost.getByRole('button', { name: 'Out of service …' }).count()) === 0, 'an operator takes nothing out of service');
  check((await lost.getByRole('button', { name: 'Suppress …' }).count()) === 0, 'nor suppresses what the design does not leave to people');
  await shot(page, 'actions');
  await isAccessible(page, 'what may be done to an alarm, beside the history,');
  await lost.getByRole('button', { name: 'Acknowledge' }).click();
  await stateOf(page, 'runtime.lost', 'normal', 'what has returned is normal once it is acknowledged');
  await until('and whoever goes by keys stays where that was', () =>
    page.evaluate(() => document.activeElement.closest('[role=group]')?.getAttribute('aria-label') === 'act on runtime.lost'));

  const tank = await opens(page, 'a1.low');
  await tank.getByRole('button', { name: 'Shelve …' }).click();
  await fill(page, { Minutes: '481', Reason: 'works at the tank' });
  await dialog(page).getByRole('button', { name: 'Shelve' }).click();
  check((await dialog(page).count()) === 1, 'a shelf longer than the alarm allows is not even asked for');
  await shot(page, 'shelve', { fullPage: false });
  await isAccessible(page, 'shelving');
  await gives(page, 'works at the tank', { Minutes: '60' });
  await stateOf(page, 'a1.low', 'shelved', 'an alarm is shelved for a time');
  check(/until \S+/.test(await page.locator('[data-alarm="a1.low"]').innerText()), 'and its end is told');
  await tank.getByRole('button', { name: 'Suppress …' }).click();
  await gives(page, 'the tank is cleaned');
  await stateOf(page, 'a1.low', 'suppressed by design', 'what the design leaves to people is suppressed by hand');
  await tank.getByRole('button', { name: 'End suppression' }).click();
  await stateOf(page, 'a1.low', 'shelved', 'until they end it');
  await tank.getByRole('button', { name: 'Unshelve' }).click();
  await stateOf(page, 'a1.low', 'normal', 'and so is the shelf');

  await logsIn(page, 'engineer');
  const again = await opens(page, 'a1.low');
  await again.getByRole('button', { name: 'Out of service …' }).click();
  await gives(page, 'the sensor is changed');
  await stateOf(page, 'a1.low', 'out of service', 'an engineer takes an alarm out of service');
  await shot(page, 'out-of-service');
  await again.getByRole('button', { name: 'Return to service' }).click();
  await stateOf(page, 'a1.low', 'normal', 'and returns it');
}

async function journalAndTrailTellWhoAndWhy(page) {
  await page.getByRole('button', { name: 'Journal' }).click();
  await waitFor(page, 'the journal says who did what and why', () =>
    ['operator: works at the tank', 'operator: the tank is cleaned', 'engineer: the sensor is changed'].every((told) =>
      document.querySelector('[data-testid=journal]').innerText.includes(told)));
  await isAccessible(page, 'the journal');
  const trail = await page.evaluate(async () => (await (await fetch('/api/audit')).json()).entries);
  const entry = (action, result) => trail.find((one) => one.action === action && one.result === result);
  check(entry('alarm.acknowledge', 'done').before === 'returned, unacknowledged' && entry('alarm.acknowledge', 'done').after === 'normal', 'the audit trail has the states before and after');
  check(entry('alarm.shelve', 'done').after === 'shelved for 60 min' && entry('alarm.shelve', 'done').reason === 'works at the tank', 'and for how long something was hidden, and why');
  const stale = await page.evaluate(async () => {
    const { csrf } = await (await fetch('/api/session')).json();
    const headers = { 'Content-Type': 'application/json', 'X-CSRF-Token': csrf };
    const answer = await fetch('/api/alarms/unshelve', { method: 'POST', headers, body: '{"name": "a1.low"}' });
    const forged = await fetch('/api/alarms/unshelve', { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: '{"name": "a1.low"}' });
    return [answer.status, (await answer.json()).problems[0].code, forged.status];
  });
  check(stale.join() === '409,C0606,403', `what the state does not allow is refused with its reason, and so is a request without its token (${stale})`);
  await page.getByRole('button', { name: 'All', exact: true }).first().click();
  await waitFor(page, 'the list is back', () => document.querySelectorAll('[data-alarm]').length > 5);
}

// An hour passes without a request: whoever was logged in only looks from then on, and is told so.
async function losesItsSession(page, server) {
  await page.evaluate(() => {
    globalThis.told = [];
    const listen = () => globalThis.told.push(document.querySelector('[data-testid=banner]')?.innerText ?? '');
    new MutationObserver(listen).observe(document.body, { subtree: true, childList: true, characterData: true });
  });
  server.tell('later 60');
  await waitFor(page, 'a session without a request ends, and the page says so', () =>
    document.querySelector('[data-testid=banner]')?.innerText.startsWith('Your session has ended.') && document.querySelector('[data-testid=log-in]') !== null);
  await waitFor(page, 'and goes on looking', () => document.querySelector('[data-testid=link]').innerText === 'live');
  const told = await page.evaluate(() => [...new Set(globalThis.told)].filter((text) => text !== ''));
  check(!told.some((text) => text.includes('No connection')), `nobody is told that the server is lost (${told.join(' | ')})`);
  await isAccessible(page, 'the page without its session');
  await shot(page, 'session-ended');
}

// Something that stands, for what follows.
async function comesAgain(page, server) {
  server.tell('runtime off');
  await stateOf(page, 'runtime.lost', 'unacknowledged', 'an alarm that comes again is unacknowledged again');
  server.tell('runtime on');
  await stateOf(page, 'runtime.lost', 'returned, unacknowledged', 'and waits again when it has returned');
}

async function isReadOnAPhone(page) {
  await page.setViewportSize({ width: 360, height: 1400 });
  await drawn(page);
  await shot(page, 'phone', { fullPage: false });
  await page.getByRole('button', { name: 'Journal' }).click();
  await waitFor(page, 'the journal is read on a phone, too', () => document.querySelectorAll('[data-testid=journal] tbody tr').length > 0);
  check((await page.evaluate(() => document.documentElement.scrollWidth)) <= 360, 'and does not stick out');
  await shot(page, 'phone-journal', { fullPage: false });
  await page.getByRole('button', { name: 'All', exact: true }).first().click();
  await fitsEveryWidth(page, [1440, 768, 360], shot);
}

// kill -9: what was in the journal is there, the alarm is in its state, the history has what was before.
async function goesOnAfterAKill(page, server) {
  const first = await page.evaluate(async () => (await (await fetch('/api/alarms/journal?most=500')).json()).entries);
  await server.kill();
  const again = await startServer(given.server, server.port, 4, 60, folder);
  await waitFor(page, 'the page comes back with the alarm as it was', () =>
    document.querySelector('[data-testid=link]').innerText === 'live' &&
    document.querySelector('[data-alarm="runtime.lost"]')?.dataset.state === 'returned, unacknowledged');
  const second = await page.evaluate(async () => (await (await fetch('/api/alarms/journal?most=500')).json()).entries);
  const numbers = new Map(second.map((entry) => [entry.number, JSON.stringify(entry)]));
  check(first.every((entry) => numbers.get(entry.number) === JSON.stringify(entry)), `no entry of the journal is lost (${first.length})`);
  const levels = await page.evaluate(async () => {
    const { now_ms } = await (await fetch('/api/history/tags')).json();
    const answer = await (await fetch(`/api/history/trend?tags=points/a1.level&from_ms=${now_ms - 600_000}&to_ms=${now_ms}&columns=600`)).json();
    return answer.series[0].last.filter((value) => value !== null).length;
  });
  check(levels > 20, `the history has what was before (${levels} columns)`);
  return again;
}

// What is written beside the vertical axis of a chart, with its place: a canvas has no text to ask for.
function listensToCharts() {
  const { fillText, clearRect } = CanvasRenderingContext2D.prototype;
  CanvasRenderingContext2D.prototype.clearRect = function (...box) {
    this.canvas.written = [];
    return clearRect.apply(this, box);
  };
  CanvasRenderingContext2D.prototype.fillText = function (text, x, y, ...more) {
    if (this.textAlign === 'right') this.canvas.written?.push({ text, left: x - this.measureText(text).width, y });
    return fillText.call(this, text, x, y, ...more);
  };
}

// A level that no tank can have: the marks of both charts are numbers that can be told apart, and are not cut off.
async function readsHugeValues(page, server) {
  await page.setViewportSize({ width: 1440, height: 900 });
  server.tell('huge');
  server.tell('run');
  for (const chart of ['trend', 'history']) {
    const marksOf = () => page.evaluate((name) => document.querySelector(`[data-testid=${name}] canvas`)?.written ?? [], chart);
    await until(`the ${chart} has marks for 1E37`, async () => {
      const marks = await marksOf();
      return marks.length >= 3 && marks.filter(({ text }) => /^[\d.]+E3[678]$/.test(text)).length >= marks.length - 1;
    });
    const marks = await marksOf();
    const told = marks.map(({ text }) => text).join(' ');
    check(new Set(marks.map(({ text }) => text)).size === marks.length, `each is another (${told})`);
    check(marks.every(({ left }) => left >= 0), 'and none is cut off');
    const heights = marks.map(({ y }) => y).sort((a, b) => a - b);
    check(heights.every((y, i) => i === 0 || y - heights[i - 1] >= 11), 'nor written over another');
  }
  await shot(page, 'huge');
}

let server = await startServer(given.server, 0, 4, 24, folder);
server.tell('run');
const browser = await launchBrowser(given);
let opened;
try {
  await browser.context.addInitScript({ path: axeFile(given.modules) });
  await browser.context.addInitScript(listensToCharts);
  opened = await openPage(browser.context, server.url);
  const { page, problems } = opened;
  await opensOnlyWhenAsked(page);
  await drawsTheHistory(page);
  await zoomsAndPans(page);
  await measuresAndExports(page);
  await showsAnAlarm(page, server);
  await actsOnAlarms(page);
  await journalAndTrailTellWhoAndWhy(page);
  await losesItsSession(page, server);
  await comesAgain(page, server);
  await isReadOnAPhone(page);
  server = await goesOnAfterAKill(page, server);
  await readsHugeValues(page, server);
  // What the server refuses on purpose the browser reports by itself.
  const unexpected = problems.filter((problem) => !/status of (401|403|409)/.test(problem));
  check(unexpected.length === 0, `no errors, no foreign requests, no policy violations ${unexpected.join('; ')}`);
} catch (error) {
  if (opened) await failurePicture(given, 'records', opened.page);
  throw error;
} finally {
  await browser.close();
  await server.stop();
  rmSync(folder, { recursive: true, force: true });
}
