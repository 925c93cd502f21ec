// How runtimes are, as a person looks at it: a page over two cells as real processes, with Modbus devices of which one is
// there and one is not, and a third runtime that nobody has started.

import { startField } from './field.mjs';
import { startDevice } from './modbus_device.mjs';
import { leadOverPage } from './page_run.mjs';
import { isAccessible } from './people.mjs';
import { check, drawn, options, pictures, waitFor } from './support.mjs';

const US_PER = { 'µs': 1, ms: 1_000, s: 1_000_000 }; // a machine that rests for seconds is seen in them

const given = options();

const shot = pictures(given, 'scan-', { fullPage: true });
const row = (runtime) => `[data-runtime="${runtime}"]`;

async function opensByKeyboard(page) {
  const button = page.getByRole('button', { name: 'Tasks, I/O and links' });
  const fetched = () => page.evaluate(() => performance.getEntriesByType('resource').some((one) => /ScanDetails/.test(one.name)));
  await button.waitFor();
  check(!(await fetched()), 'the panel is not fetched at the start');
  await button.focus();
  await page.keyboard.press('Enter');
  await waitFor(page, 'it opens and has the focus', () => document.activeElement?.id === 'scan-details');
  check(await fetched(), 'and is fetched then');
}

async function showsTheTasks(page) {
  for (const task of ['Fast', 'Slow']) {
    await waitFor(page, `${task} has a histogram of its execution`, (name) =>
      Number(document.querySelector(`[data-task=${name}] [data-testid=histogram]`)?.dataset.bars) > 0, task);
  }
  const fast = page.locator('[data-task=Fast]');
  check((await fast.innerText()).includes('every 10.00 ms · priority 0'), 'with its interval and priority');
  check((await fast.locator('[data-figure=watchdog]').innerText()) === '2.00 s × 3, quiet', 'and its watchdog');
  for (const measure of ['Latency', 'Jitter']) {
    await fast.getByRole('button', { name: measure }).click();
    await waitFor(page, `its ${measure} is drawn when asked for`, (word) =>
      document.querySelector('[data-task=Fast] [data-testid=histogram]')?.ariaLabel.startsWith(`${word.toLowerCase()} of Fast: `), measure);
  }
  const figures = await fast.locator('[data-measure]').evaluateAll((rows) => rows.map((one) => [...one.cells].map((cell) => cell.innerText)));
  for (const [measure, ...values] of figures) {
    const us = values.map((value) => parseFloat(value) * US_PER[value.split(' ')[1]]);
    // A histogram's percentiles are upper edges, never above the maximum.
    check(us.length === 4 && us.every((value, i) => value >= (us[i - 1] ?? 0)), `${measure} grows from p50 to the maximum: ${values.join(', ')}`);
  }
  const cycles = async () => Number(/([\d,]+) cycles/.exec(await fast.innerText())[1].replaceAll(',', ''));
  const before = await cycles();
  await waitFor(page, 'cycles are counted while one looks', (least) =>
    Number(/([\d,]+) cycles/.exec(document.querySelector('[data-task=Fast]').innerText)[1].replaceAll(',', '')) > least, before);
}

async function showsDevicesAndTopics(page) {
  await waitFor(page, 'the device that answers is online, with the age of its newest value', () =>
    /online[\s\S]* ago/.test(document.querySelector('[data-device=levels]')?.innerText ?? ''));
  await waitFor(page, 'the one that nobody has started is lost, and why', () => {
    const text = document.querySelector('[data-device=pumps]')?.innerText ?? '';
    return /\blost\b/.test(text) && text.includes('never') && text.includes('newest: ');
  });
  const received = () => page.locator('[data-topic="stepwright/status/3"] [data-figure=received]').innerText();
  const before = Number((await received()).replaceAll(',', ''));
  await waitFor(page, 'samples are counted', (least) =>
    Number(document.querySelector('[data-topic="stepwright/status/3"] [data-figure=received]').innerText.replaceAll(',', '')) > least, before);
  check(Number(await page.getByTestId('followers').innerText()) >= 1, 'the link knows that it is followed');
}

async function showsTheOthers(page, names) {
  await waitFor(page, 'every runtime has a row', () => document.querySelectorAll('[data-testid=runtimes] tbody tr').length === 3);
  check((await page.locator(row('ghost')).innerText()).includes('never heard of'), 'one that nobody has started was never heard of');
  await waitFor(page, 'the other cell runs', (press) => document.querySelector(press)?.innerText.includes('running'), row(names.press));
  await page.getByRole('button', { name: names.press }).press('Enter');
  await waitFor(page, 'it is shown when it is chosen', (press) => document.querySelector('[data-testid=shown-runtime]').dataset.shown === press, names.press);
  check((await page.getByTestId('io-kind').innerText()).startsWith('Nothing: outputs go nowhere'), 'with the plant that it has not');
  await page.locator('[data-task=Fast]').getByRole('button', { name: 'Latency' }).click();
  await waitFor(page, 'what simulated time does not have is not drawn', () =>
    document.querySelector('[data-task=Fast]').innerText.includes('Nothing measured'));
  await shot(page, 'other');
  await page.getByRole('button', { name: names.line }).click();
}

async function fitsEveryWidth(page) {
  await page.locator('[data-help=scan-details]').press('Enter');
  await waitFor(page, 'the figures are explained', () => document.querySelector('[data-testid=dialog]')?.innerText.includes('p99.9'));
  await shot(page, 'help');
  await page.keyboard.press('Escape');
  await waitFor(page, 'Escape closes the help and leaves the panel', () =>
    document.querySelector('[data-testid=dialog]') === null && document.querySelector('#scan-details') !== null);
  for (const scheme of ['light', 'dark']) {
    await page.emulateMedia({ colorScheme: scheme });
    for (const width of [1440, 768, 360]) {
      await page.setViewportSize({ width, height: 900 });
      await drawn(page);
      const wide = await page.evaluate(() => document.documentElement.scrollWidth);
      check(wide <= width, `nothing sticks out at ${width} px (${wide})`);
      await shot(page, `${scheme}-${width}`);
    }
    await isAccessible(page, `the panel in ${scheme}`);
  }
  await page.emulateMedia({ colorScheme: 'light' });
  await page.setViewportSize({ width: 1440, height: 900 });
}

async function tellsWhatIsLost(page, field, device) {
  device.stop();
  await waitFor(page, 'a device that goes is lost', () => /\blost\b/.test(document.querySelector('[data-device=levels]')?.innerText ?? ''));
  await field.kill(field.names.line, 'modbus-client');
  await waitFor(page, 'so is the client of all of them', () =>
    document.querySelector('#scan-details').innerText.includes('no Modbus client answers'));
  await field.kill(field.names.press, 'runtime');
  await waitFor(page, 'a runtime that is killed does not answer', (press) =>
    document.querySelector(press).innerText.includes('does not answer'), row(field.names.press));
  check((await page.locator(row(field.names.line)).getAttribute('data-alive')) === 'true', 'the other one does');
  await shot(page, 'lost');
  field.start(field.names.press, 'runtime');
  await waitFor(page, 'until it is started again', (press) => document.querySelector(press).dataset.alive === 'true', row(field.names.press));
  await field.kill(field.names.line, 'hmi');
  await waitFor(page, 'without a server the panel says that it is old', () =>
    document.querySelector('[data-testid=scan-details-trouble]')?.innerText.includes('what is shown is old'));
  field.start(field.names.line, 'hmi');
  await waitFor(page, 'and goes on with the next one', () =>
    document.querySelector('#scan-details') !== null && document.querySelector('[data-testid=scan-details-trouble]') === null);
}

async function closes(page) {
  await page.locator('#scan-details').focus();
  await page.keyboard.press('Escape');
  await waitFor(page, 'Escape closes it and gives the focus back', () =>
    document.querySelector('#scan-details') === null && document.activeElement?.id === 'scan-more');
}

const device = await startDevice();
try {
  await leadOverPage(given, {
    name: 'scan',
    start: () => startField(given.server, device),
    steps: async (page, field) => {
      await opensByKeyboard(page);
      await showsTheTasks(page);
      await showsDevicesAndTopics(page);
      await showsTheOthers(page, field.names);
      await fitsEveryWidth(page);
      await tellsWhatIsLost(page, field, device);
      await closes(page);
    },
  });
} finally {
  device.stop();
}
