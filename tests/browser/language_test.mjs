// The page in its languages and themes, chosen by keyboard: what is chosen is kept, nothing sticks out on a phone, every theme can be
// read; and the help of a panel. Against the real server over a scripted bench.

import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { axeFile, isAccessible } from './people.mjs';
import { check, drawn, endInTime, failurePicture, launchBrowser, openPage, options, pictures, startServer, waitFor } from './support.mjs';

const given = options();
const folder = mkdtempSync(join(tmpdir(), 'hmi-language-'));
const shot = pictures(given, 'language-', { fullPage: true });

// What the panels are called: one of the first load, one that is fetched when it is opened.
const WORDS = {
  de: { letter: 'D', plant: 'Anlage', alarms: 'Alarme', point: ',' },
  fr: { letter: 'F', plant: 'Installation', alarms: 'Alarmes', point: ',' },
  es: { letter: 'E', plant: 'Planta', alarms: 'Alarmas', point: ',' },
  en: { letter: 'E', plant: 'Plant', alarms: 'Alarms', point: '.' },
};
const titleIs = (page, what, area, title) =>
  waitFor(page, what, ([panel, words]) => document.querySelector(`[data-panel=${panel}] h2`)?.innerText === words, [area, title]);

// Only keys: Tab, backwards, to the button in the header, Enter, Tab to what is chosen.
async function opensTheMenu(page) {
  for (let turn = 0; turn < 60; ++turn) {
    if (await page.evaluate(() => document.activeElement?.dataset?.testid === 'preferences')) break;
    await page.keyboard.press('Shift+Tab');
  }
  check(await page.evaluate(() => document.activeElement?.dataset?.testid === 'preferences'), 'Tab reaches the menu');
  await page.keyboard.press('Enter');
  await waitFor(page, 'Enter opens it', () => document.querySelector('[data-testid=preferences]').ariaExpanded === 'true');
}

async function closesTheMenu(page) {
  await page.keyboard.press('Escape');
  await waitFor(page, 'Escape closes it and gives the focus back', () =>
    document.querySelector('[data-testid=preferences]').ariaExpanded === 'false' && document.activeElement?.dataset?.testid === 'preferences');
}

// A select that has the focus takes the next entry that begins with the letter.
async function chooses(page, code) {
  await opensTheMenu(page);
  await page.keyboard.press('Tab');
  await page.keyboard.press(WORDS[code].letter);
  await waitFor(page, `the document is in ${code}`, (wanted) => document.documentElement.lang === wanted, code);
  await closesTheMenu(page);
}

async function speaks(page, code) {
  const { plant, alarms, point } = WORDS[code];
  await titleIs(page, `the plant is called ${plant}`, 'synoptic', plant);
  await titleIs(page, `the alarms are called ${alarms}`, 'alarms', alarms);
  await waitFor(page, `numbers have a "${point}"`, (mark) => document.querySelector('[data-tank=v1] .value')?.textContent.includes(mark), point);
}

async function fitsAPhone(page, code) {
  await page.setViewportSize({ width: 360, height: 900 });
  await drawn(page);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  await shot(page, `${code}-360`);
  check(wide <= 360, `in ${code} nothing sticks out at 360 px (${wide})`);
  await opensTheMenu(page);
  const { left, right } = await page.evaluate(() => document.querySelector('[data-testid=preferences] + .menu').getBoundingClientRect().toJSON());
  check(left >= 0 && right <= 360, `nor does the menu (${left} to ${right})`);
  await shot(page, `${code}-menu`, { fullPage: false });
  await closesTheMenu(page);
  await page.setViewportSize({ width: 1440, height: 900 });
}

async function keepsTheChoice(page) {
  await chooses(page, 'de');
  await page.reload();
  await titleIs(page, 'a page that is loaded anew is in the language that was chosen', 'synoptic', WORDS.de.plant);
  await page.locator('[data-testid=alarm-bar] .buttons [aria-expanded]').first().press('Enter');
  await titleIs(page, 'a panel that is fetched comes in it, too', 'alarms', WORDS.de.alarms);
  await shot(page, 'de-1440');
}

async function helps(page) {
  await page.locator('[data-help=plan]').press('Enter');
  await waitFor(page, 'the help of a panel opens', () => document.querySelector('[data-testid=dialog] h2')?.innerText === 'Hilfe: Plan');
  await shot(page, 'help');
  await page.keyboard.press('Escape');
  await waitFor(page, 'Escape closes it and gives the focus back', () =>
    document.querySelector('[data-testid=dialog]') === null && document.activeElement?.dataset?.help === 'plan');
}

async function canBeReadInEveryTheme(page) {
  await page.locator('[data-testid=alarm-bar] .buttons [aria-expanded]').nth(1).press('Enter');
  await waitFor(page, 'the history is there', () => document.querySelector('[data-panel=history]') !== null);
  await opensTheMenu(page);
  const select = (number) => page.locator('[data-testid=preferences] + .menu select').nth(number);
  for (const theme of ['light', 'dark']) {
    for (const colours of ['standard', 'distinct']) {
      await select(1).selectOption(theme);
      await select(2).selectOption(colours);
      await waitFor(page, `the page is ${theme}, in ${colours} colours`, (wanted) => {
        const { theme: bright, colours: hue } = document.documentElement.dataset;
        return `${bright} ${hue}` === wanted;
      }, `${theme} ${colours}`);
      await isAccessible(page, `the page, ${theme}, in ${colours} colours,`);
      await shot(page, `${theme}-${colours}`);
    }
  }
  await page.reload();
  await waitFor(page, 'the theme is kept', () => document.documentElement.dataset.theme === 'dark' && document.documentElement.dataset.colours === 'distinct');
  await opensTheMenu(page);
  await select(1).selectOption('system');
  for (const scheme of ['light', 'dark']) {
    await page.emulateMedia({ colorScheme: scheme });
    await waitFor(page, `as the system, ${scheme}`, (wanted) => document.documentElement.dataset.theme === wanted, scheme);
  }
  await closesTheMenu(page);
}

endInTime();

const server = await startServer(given.server, 0, 4, 24, folder);
server.tell('run');
const browser = await launchBrowser(given);
let opened;
try {
  await browser.context.addInitScript({ path: axeFile(given.modules) });
  opened = await openPage(browser.context, server.url);
  const { page, problems } = opened;
  await titleIs(page, 'a browser that asks for English gets it', 'synoptic', WORDS.en.plant);
  check((await page.evaluate(() => document.documentElement.lang)) === 'en', 'and the document says so');
  check(!(await page.evaluate(() => performance.getEntriesByType('resource').some(({ name }) => /texts[.-](de|fr|es)/.test(name)))), 'no other language was fetched');
  await page.getByRole('button', { name: 'Alarms' }).click();
  await speaks(page, 'en');
  for (const code of ['de', 'fr', 'es']) {
    await chooses(page, code);
    await speaks(page, code);
    await fitsAPhone(page, code);
  }
  await keepsTheChoice(page);
  await helps(page);
  await canBeReadInEveryTheme(page);
  const unexpected = problems.filter((problem) => !/status of (401|403)/.test(problem));
  check(unexpected.length === 0, `no errors, no foreign requests, no policy violations ${unexpected.join('; ')}`);
} catch (error) {
  if (opened) await failurePicture(given, 'language', opened.page);
  throw error;
} finally {
  await browser.close();
  await server.stop();
  rmSync(folder, { recursive: true, force: true });
}
