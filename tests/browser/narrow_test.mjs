// Every panel of the bench at 360 px, with the keyboard alone: it is reached by Tab, opened by Enter, nothing sticks out of the page or is
// cut off, the focus can be seen, Escape closes what has opened, and the focus goes back to where it came from.

import { writeFileSync } from 'node:fs';
import { join } from 'node:path';

import { startDemo } from './demo_process.mjs';
import { hiddenFocus, unreadable } from './narrow.mjs';
import { leadOverPage } from './page_run.mjs';
import { dialog, dialogIsGone, fill, isAccessible, PASSWORD, setupToken } from './people.mjs';
import { check, drawn, options, pictures, waitFor } from './support.mjs';

const WIDTH = 360;
const SPEED = 0.25; // the run is still there when it is held, however slow the machine is
const MOST_TABS = 500;
const RECIPES = '[[tag]]\nname = "B1"\ntype = "BOOL"\ncomment = "supplier pump"\n';

const given = options();
const shot = pictures(given, 'narrow-');

// Everything that is wrong is told at once, at the end.
const faults = [];
function note(condition, what) {
  console.log(`${condition ? 'ok' : 'NOT SO'}: ${what}`);
  if (!condition) faults.push(what);
}

// `inside`: what has opened; the page behind it was looked at before.
async function canBeRead(page, what, name, inside) {
  await drawn(page); // what has opened is laid out
  await shot(page, name);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  note(wide <= WIDTH, `${what} does not make the page wider (${wide})`);
  const cut = await page.evaluate(unreadable);
  note(cut.length === 0, `${what} can be read ${cut.join('; ')}`);
  await isAccessible(page, what, inside).catch((error) => note(false, error.message));
}

const focusIs = (page, selector) => page.evaluate((wanted) => document.activeElement?.matches(wanted) ?? false, selector);

const unseen = new Set();

// Tab, until what is wanted has the focus; everything on the way can be seen to have it.
async function tabTo(page, what, selector) {
  for (let turn = 0; turn < MOST_TABS; ++turn) {
    if (await focusIs(page, selector)) return;
    await page.keyboard.press('Tab');
    let fault = await page.evaluate(hiddenFocus);
    // A run moves what is above; what stays out of sight is a fault.
    for (let look = 0; fault !== '' && look < 5; ++look) {
      await drawn(page);
      fault = await page.evaluate(hiddenFocus);
    }
    if (fault !== '' && !unseen.has(fault)) {
      unseen.add(fault);
      note(false, `the focus can be seen on the way to ${what}: ${fault}`);
    }
  }
  throw new Error(`not so: Tab reaches ${what}`);
}

// Opens by key what `opener` opens, looks at it, leaves it by Escape.
async function visits(page, { what, name, opener, inside, act }) {
  await tabTo(page, what, opener);
  await page.keyboard.press('Enter');
  await waitFor(page, `Enter opens ${what}`, (selector) => document.querySelector(selector) !== null, inside);
  await canBeRead(page, what, name, inside);
  if (act) await act();
  // A panel that stands beside its button is entered by Tab.
  if (!(await page.evaluate((selector) => document.querySelector(selector).contains(document.activeElement), inside))) {
    await tabTo(page, `the inside of ${what}`, `${inside} *`);
  }
  await page.keyboard.press('Escape');
  await waitFor(page, 'Escape closes it', (selector) => document.querySelector(selector) === null, inside);
  await waitFor(page, 'and the focus is back', (selector) => document.activeElement?.matches(selector) ?? false, opener);
}

async function claims(page, token) {
  await tabTo(page, 'the button that claims the server', '[data-testid=log-in]');
  await page.keyboard.press('Enter');
  await waitFor(page, 'the dialog is there', () => document.querySelector('[data-testid=dialog]') !== null);
  await canBeRead(page, 'claiming the server', 'claim');
  await fill(page, { 'Set-up token': token, 'Your name': 'root', Password: PASSWORD });
  await page.keyboard.press('Enter');
  await dialogIsGone(page, 'the administrator is claimed');
}

const DIALOG = '[data-testid=dialog]';
const named = async (page, label) => {
  // Buttons have no name that CSS sees.
  await page.evaluate((words) => {
    for (const node of document.querySelectorAll('button')) {
      if (node.textContent.trim() === words) node.dataset.button = words;
    }
  }, label);
  return `[data-button="${label}"]`;
};

async function visitsDialogs(page) {
  for (const [label, name] of [['Users', 'users'], ['Audit', 'audit'], ['Password', 'password'], ['Start', 'start'], ['Abort', 'abort'], ['Stop', 'stop']]) {
    if ((await page.getByRole('button', { name: label, exact: true }).count()) === 0) continue;
    await visits(page, { what: `the dialog "${label}"`, name, opener: await named(page, label), inside: DIALOG });
  }
}

async function visitsGoal(page) {
  await visits(page, {
    what: 'the dialog of goals',
    name: 'goal',
    opener: await named(page, 'New goal'),
    inside: DIALOG,
    act: async () => {
      await waitFor(page, 'its form is there', () => document.querySelectorAll('[data-condition]').length > 0);
      await canBeRead(page, 'the form of a goal', 'goal-form');
      await dialog(page).getByRole('button', { name: 'What if?', exact: true }).press('Enter');
      await waitFor(page, 'a what-if is answered', () => /steps|actions/i.test(document.querySelector('[data-testid=what-if], [data-testid=what-if-result]')?.innerText ?? ''));
      await canBeRead(page, 'a what-if', 'what-if');
    },
  });
}

async function visitsRegions(page) {
  const region = (label, area, name) => ({ what: `the panel "${label}"`, name, inside: `[data-panel=${area}]` });
  for (const [label, area] of [['Alarms', 'alarms'], ['History', 'history'], ['Recipes', 'recipes']]) {
    await visits(page, { ...region(label, area, area), opener: await named(page, label) });
  }
  await visits(page, { what: 'the scan in detail', name: 'scan', opener: '#scan-more', inside: '[data-panel=scan-details]' });
}

async function visitsHelp(page) {
  const topics = await page.evaluate(() => [...document.querySelectorAll('[data-help]')].map((node) => node.dataset.help));
  check(topics.length >= 6, `panels have their help: ${topics.join(', ')}`);
  for (const topic of topics) await visits(page, { what: `the help of ${topic}`, name: `help-${topic}`, opener: `[data-help=${topic}]`, inside: DIALOG });
}

async function visitsForce(page) {
  await page.evaluate(() => {
    const set = [...document.querySelectorAll('[data-panel=tags] tbody button')].find((node) => node.textContent.trim() === 'Set');
    if (set) set.dataset.button = 'set';
  });
  await visits(page, { what: 'forcing a variable', name: 'force', opener: '[data-button=set]', inside: DIALOG });
}

await leadOverPage(given, {
  name: 'narrow',
  start: () => {
    const recipes = join(given.out, 'narrow-recipes.toml');
    writeFileSync(recipes, RECIPES);
    return startDemo(given.server, SPEED, 'bench', ['--set', 'executive.start="operator"', '--set', `hmi.recipes="${recipes}"`]);
  },
  steps: async (page, demo) => {
    await page.setViewportSize({ width: WIDTH, height: 740 });
    await waitFor(page, 'the plan is ready', () => document.querySelector('[data-testid=phase]')?.innerText === 'ready');
    await claims(page, await setupToken(demo));
    await canBeRead(page, 'the page', 'page');
    await shot(page, 'page-whole', { fullPage: true });
    await visitsDialogs(page);
    await visitsGoal(page);
    await visitsRegions(page);
    await tabTo(page, 'Start', await named(page, 'Start'));
    await page.keyboard.press('Enter');
    await dialog(page).getByRole('button', { name: 'Start the run' }).press('Enter');
    await dialogIsGone(page, 'the run is started');
    await waitFor(page, 'the program runs', () => document.querySelectorAll('[data-panel=tags] tbody tr').length > 3 && document.querySelector('.step.active') !== null);
    // First: on a slow machine the run may have ended before all else is read.
    await visits(page, { what: 'holding the run', name: 'hold', opener: await named(page, 'Hold'), inside: DIALOG });
    await canBeRead(page, 'the page of a run', 'run');
    await shot(page, 'run-whole', { fullPage: true });
    await visits(page, { what: 'the program that runs', name: 'program', opener: '#program-more', inside: '[data-panel=program-details]' });
    await visitsForce(page);
    await visitsHelp(page);
    check(faults.length === 0, `everything can be reached, read and left ${faults.join('\n')}`);
  },
});
