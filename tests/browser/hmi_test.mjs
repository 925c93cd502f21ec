// Drives the page as a person would see it, against the real server over a scripted bench, and keeps pictures.

import { check, fitsEveryWidth, launchBrowser, openPage, options, pictures, startServer, waitFor } from './support.mjs';

const given = options();
const shot = pictures(given, '', { fullPage: true });

async function picksUpTheCell(page) {
  await waitFor(page, 'the synoptic shows every tank', () => document.querySelectorAll('[data-tank]').length === 4);
  await waitFor(page, 'a step of the chart is lit', () => document.querySelector('.step.active') !== null);
  await waitFor(page, 'an action of the plan is active', () => document.querySelector('[data-state=active]') !== null);
  await waitFor(page, 'the page is live', () => document.querySelector('[data-testid=link]').innerText === 'live');
  check((await page.title()) === 'bench · Stepwright', 'the title names the cell');
  check((await page.locator('[data-testid=banner]').count()) === 0, 'nothing is stale');
}

async function followsTheCell(page, server) {
  const before = await page.evaluate(() => ({
    steps: document.querySelector('[data-testid=active-steps]').innerText,
    done: document.querySelector('[data-testid=plan-progress]').ariaValueNow,
    level: document.querySelector('[data-tank=v1]').dataset.level,
    x: document.querySelector('[data-vehicle=v1]').dataset.x,
    scan: document.querySelector('[data-scan=scan]').innerText,
  }));
  server.tell('run 30'); // a move has ended there, a load and an order go on
  await waitFor(page, 'the active steps change', (old) => {
    const now = document.querySelector('[data-testid=active-steps]').innerText;
    return now !== old.steps && document.querySelector('.step.active') !== null;
  }, before);
  await waitFor(page, 'the plan makes progress', (old) => {
    const now = document.querySelector('[data-testid=plan-progress]').ariaValueNow;
    return Number(now) > Number(old.done);
  }, before);
  await waitFor(page, 'levels and scans go on', (old) => {
    const level = document.querySelector('[data-tank=v1]').dataset.level;
    return level !== old.level && document.querySelector('[data-scan=scan]').innerText !== old.scan;
  }, before);
  await waitFor(page, 'a pump runs', () => document.querySelector('[data-pump].running') !== null);
  await waitFor(page, 'the vehicle moves', (old) => document.querySelector('[data-vehicle=v1]').dataset.x !== old.x, before);
  await waitFor(page, 'a level that an action changes is not compared', () => {
    const row = document.querySelector('[data-fluent="(lev v1)"]');
    return row?.cells[3].innerText === 'moving' && row.cells[1].innerText.includes('→');
  });
  check(await page.evaluate(() => document.querySelectorAll('[data-fluent]:not(.moving)').length > 0), 'the others are');
  await waitFor(page, 'a microswitch closes', () => document.querySelector('[data-closed=true]') !== null);
}

async function drawsTheTrend(page) {
  await waitFor(page, 'the trend has ink', () => {
    const canvas = document.querySelector('[data-testid=trend] canvas');
    if (!canvas) return false;
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    const colours = new Set();
    for (let i = 0; i < data.length; i += 4) if (data[i + 3] === 255) colours.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
    return colours.size > 5;
  });
}

// From when the history is, in seconds of the cell.
async function trendBegin(page) {
  await waitFor(page, 'the trend says from when it is', () =>
    document.querySelector('[data-panel=trend] .note')?.innerText.startsWith('recorded since '));
  const [, minutes, seconds] = /(\d+):(\d\d\.\d)$/.exec(await page.locator('[data-panel=trend] .note').innerText()) ?? [];
  return Number(minutes) * 60 + Number(seconds);
}

// S03 is followed by two steps that only wait: a tick behind them says that the run has left them.
async function ticksWhatIsPassed(page) {
  await waitFor(page, 'a wait step that was passed is ticked', () =>
    document.querySelector('[data-step=W3_5].done .tick') !== null);
  const wrong = await page.evaluate(() => {
    const has = (name, word) => document.querySelector(`[data-step=${name}]`).classList.contains(word);
    if (!has('START', 'done')) return 'START';
    if (has('W15_16', 'done') && !has('S16_UNLOAD', 'done') && !has('S16_UNLOAD', 'active')) return 'W15_16';
    return document.querySelector('.step.done.active')?.dataset.step ?? '';
  });
  check(wrong === '', `and no step that is to come or active ${wrong}`);
}

async function drawsTheChartReadably(page) {
  const clash = await page.evaluate(() => {
    const boxes = [...document.querySelectorAll('.step')].map((step) => [step.dataset.step, step.getBoundingClientRect()]);
    for (const [name, a] of boxes) {
      for (const [other, b] of boxes) {
        if (name < other && a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom) return `${name} ${other}`;
      }
    }
    return boxes.length > 17 ? '' : 'too few steps';
  });
  check(clash === '', `no two steps of the chart overlap ${clash}`);
}

async function showsExitsWhenAsked(page) {
  const exit = page.locator('[data-step=FAILED_S03_UNLOAD]');
  check((await exit.count()) === 0, 'the ways out of the chart are left out');
  await page.getByRole('button', { name: 'Exits' }).click();
  await waitFor(page, 'they are drawn when asked for', () => document.querySelector('[data-step=FAILED_S03_UNLOAD]') !== null);
  await drawsTheChartReadably(page);
  await page.getByRole('button', { name: 'Exits' }).click();
}

async function showsWhatWentWrong(page, server) {
  server.tell('run 48');
  await waitFor(page, 'an incident is shown once it has happened', () =>
    document.querySelectorAll('[data-panel=incidents] [data-incident]').length === 1);
  const text = await page.locator('[data-incident=level]').innerText();
  for (const [what, words] of [
    ['its time', '0:36.2'],
    ['its class', 'Level not as expected'],
    ['the action', 'complete_order a1 c1 level7'],
    ['the evidence', 'level of a1 is 2.7, expected 3.0'],
    ['the alarm of the program', 'level of a1 within 0.2 of 3 (2.70), scan 3621'],
    ['the decision', 'new plan'],
    ['how long it took and what it kept', 'decided in 4.20 ms; 7 of 9 actions kept'],
  ]) {
    check(text.includes(words), `with ${what}: ${words}`);
  }
}

async function findsTags(page) {
  await page.getByLabel('Search tags by name or address').fill('%QX0.1');
  const rows = page.locator('[data-panel=tags] tbody tr');
  await waitFor(page, 'the search leaves one tag', () => document.querySelectorAll('[data-panel=tags] tbody tr').length === 1);
  check((await rows.first().innerText()).startsWith('B2'), 'a tag is found by its address');
  await page.getByLabel('Search tags by name or address').fill('');
}

async function saysWhenTheRuntimeIsGone(page, server) {
  server.tell('runtime off');
  await waitFor(page, 'a banner says that the runtime is gone', () =>
    document.querySelector('[data-testid=banner]')?.innerText.includes('runtime does not answer'),
  );
  server.tell('runtime on');
  await waitFor(page, 'the banner goes when it is back', () => document.querySelector('[data-testid=banner]') === null);
}

async function outlivesTheServer(page, server) {
  await server.kill();
  await waitFor(page, 'a banner says that the server is gone', () =>
    document.querySelector('[data-testid=banner]')?.innerText.includes('No connection'),
  );
  await shot(page, 'stale-1440', { fullPage: false });
  const again = await startServer(given.server, server.port, 4, 55);
  again.tell('run');
  await waitFor(page, 'the page comes back by itself', () =>
    document.querySelector('[data-testid=banner]') === null &&
    document.querySelector('[data-testid=link]').innerText === 'live' &&
    document.querySelector('.step.active') !== null,
  );
  return again;
}

let server = await startServer(given.server, 0, 2, 24);
const browser = await launchBrowser(given);
try {
  const { page, problems } = await openPage(browser.context, server.url);
  await picksUpTheCell(page);
  await followsTheCell(page, server);
  await drawsTheTrend(page);
  const first = await trendBegin(page);
  check(first >= 24 && first < 55, `it begins with the server (${first})`);
  await showsWhatWentWrong(page, server);
  await ticksWhatIsPassed(page);
  await drawsTheChartReadably(page);
  await showsExitsWhenAsked(page);
  await findsTags(page);
  await fitsEveryWidth(page, [1440, 1000, 768, 360], shot);
  await saysWhenTheRuntimeIsGone(page, server);
  server = await outlivesTheServer(page, server);
  await drawsTheTrend(page);
  const again = await trendBegin(page);
  check(again >= 55, `the history begins with the new server and says so (${again})`);
  check(problems.length === 0, `no errors, no foreign requests, no policy violations ${problems.join('; ')}`);
} finally {
  await browser.close();
  await server.stop();
}
