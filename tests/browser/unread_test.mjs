// What a device does not say is no value: a page over a cell with two real Modbus devices, of which one was never there and one
// goes away and comes back.

import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { startField } from './field.mjs';
import { startDevice } from './modbus_device.mjs';
import { unreadable } from './narrow.mjs';
import { leadOverPage } from './page_run.mjs';
import { isAccessible } from './people.mjs';
import { check, drawn, options, pictures, until, waitFor } from './support.mjs';

const LEVEL = 1234;
const SCREEN = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 640 360">
<text id="number" x="20" y="40" data-text="quick.level">-</text>
<rect id="bar" x="20" y="60" width="40" height="200" fill="#888" data-fill="quick.level" data-from="0" data-to="2000"/>
<circle id="lamp" cx="110" cy="90" r="20" fill="#ccc" data-on="quick.level"/>
<text id="never" x="90" y="40" data-text="quick.pump">-</text>
<g data-part="setpoint" data-key="p1" data-label="Level" data-write="quick.level" data-from="0" data-to="2000"><rect x="160" y="60" width="180" height="50" fill="none"/></g>
<g data-part="tags" data-label="Tags" data-tags="quick.level; quick.pump; quick.sum"><rect x="160" y="150" width="220" height="120" fill="none"/></g>
<g data-part="trend" data-label="Trend" data-tags="quick.level"><rect x="400" y="60" width="220" height="200" fill="none"/></g>
</svg>`;

const given = options();
const shot = pictures(given, 'unread-');
const isUnknown = (id) => document.querySelector(`[data-testid=screen] #drawing-${id}`)?.classList.contains('unknown');
// Of the table on the screen, by the name of the tag.
const row = (tag) => document.querySelector(`[data-testid=screen] th[title="${tag}"]`)?.closest('tr')?.innerText.replace(/\s+/g, ' ') ?? '';

async function showsWhatIsRead(page) {
  await waitFor(page, 'a value that is read is shown', (value) => document.querySelector('[data-testid=screen] #drawing-number')?.textContent.replace(/\D/g, '') === String(value), LEVEL);
  check(!(await page.evaluate(isUnknown, 'bar')) && !(await page.evaluate(isUnknown, 'lamp')), 'with its bar and its lamp');
  await waitFor(page, 'a device that was never there has no value', () => document.querySelector('[data-testid=screen] #drawing-never')?.textContent === '–');
  const never = await page.evaluate(row, 'quick.pump');
  check(never.includes('no value') && never.includes('pumps has not answered yet'), `a table says so, and why: ${never}`);
  check((await page.getByTestId('drawn-unread').innerText()).includes('pumps has not answered yet'), 'and so does the screen');
  check(!(await page.locator('[data-part-key=p1]').innerText()).includes('not known'), 'a set point on a value that is read is believed');
}

async function showsWhatIsLost(page) {
  // A busy machine may not know for a moment how a device is; what is lost is lost for good here.
  await waitFor(page, 'a device that went away is lost', (tag) => document.querySelector(`[data-testid=screen] th[title="${tag}"] + td [data-unread=lost]`) !== null, 'quick.level');
  await waitFor(page, 'a number of a device that went away is no value', () => document.querySelector('[data-testid=screen] #drawing-number')?.textContent === '–');
  for (const id of ['bar', 'lamp']) await waitFor(page, `nor is its ${id}`, isUnknown, id);
  check(await page.evaluate(() => document.querySelector('#drawing-bar').classList.contains('no-level')), 'the bar is neither full nor empty');
  const lost = await page.evaluate(row, 'quick.level');
  check(/1,?234 no value ?: levels does not answer any more/.test(lost), `a table has the old one struck through, and why: ${lost}`);
  check(await page.evaluate(() => document.querySelector('[data-testid=screen] th[title="quick.level"]').closest('tr').querySelector('s') !== null), 'struck through');
  check(/^quick.sum \d+$/.test(await page.evaluate(row, 'quick.sum')), 'what the program computes is one');
  check((await page.locator('[data-part-key=p1]').innerText()).includes('The value is not known: levels does not answer any more.'), 'a set point on it says why it cannot be trusted');
  await waitFor(page, 'the table of tags says the same', () => document.querySelector('[data-panel=tags] [data-unread=lost]')?.innerText.includes('no value'));
}

// Of the newest minutes that the server has kept: [value or null].
const kept = async (page, tag) => {
  const answer = await page.request.get(`${new URL(page.url()).origin}/api/history/trend?tags=${tag}&span_ms=600000&columns=1200`);
  return (await answer.json()).series[0]?.last ?? [];
};

async function hasAGap(page) {
  await until('the record has a gap between what was read before and after', async () => {
    const values = await kept(page, 'quick.level');
    const first = values.indexOf(LEVEL);
    const last = values.lastIndexOf(LEVEL);
    return first >= 0 && values.slice(first, last).includes(null);
  });
  const values = await kept(page, 'quick.pump');
  check(values.every((value) => value === null), 'and nothing at all of what was never read');
}

async function fitsAPhone(page) {
  for (const scheme of ['light', 'dark']) {
    await page.emulateMedia({ colorScheme: scheme });
    for (const width of [1440, 820, 360]) {
      await page.setViewportSize({ width, height: 800 });
      await drawn(page);
      await shot(page, `lost-${scheme}-${width}`);
      const cut = await page.evaluate(unreadable);
      check(cut.length === 0, `all can be read at ${width} px in ${scheme} ${cut.join('; ')}`);
    }
    await isAccessible(page, `a screen without values in ${scheme}`);
  }
  await page.emulateMedia({ colorScheme: 'light' });
  await page.setViewportSize({ width: 1440, height: 900 });
}

let device = await startDevice(() => LEVEL);
const { port } = device;
const screens = mkdtempSync(join(tmpdir(), 'stepwright-unread-'));
writeFileSync(join(screens, 'Levels.svg'), SCREEN);
try {
  await leadOverPage(given, {
    name: 'unread',
    start: () => startField(given.server, device, { page: `screens_dir = "${screens}"\n`, more: '[history]\nfolder = "history"\n' }),
    steps: async (page) => {
      await showsWhatIsRead(page);
      await shot(page, 'read');
      device.stop();
      await showsWhatIsLost(page);
      await fitsAPhone(page);
      device = await startDevice(() => LEVEL, port);
      await waitFor(page, 'a device that comes back has its value again', (value) => document.querySelector('[data-testid=screen] #drawing-number')?.textContent.replace(/\D/g, '') === String(value), LEVEL);
      check(!/no value/.test(await page.evaluate(row, 'quick.level')), 'in the table, too');
      await hasAGap(page);
    },
  });
} finally {
  device.stop();
  rmSync(screens, { recursive: true, force: true });
}
