// Recipes as people use them, against a real runtime, link and server: save, compare, load, what is refused and why, what
// the audit trail has, and what a restart of the server leaves.

import { writeFileSync } from 'node:fs';
import { join } from 'node:path';

import { leadOverPage } from './page_run.mjs';
import { addsUsers, asks, claims, dialog, dialogIsGone, fill, isAccessible, logsIn } from './people.mjs';
import { startMixer } from './recipe_cell.mjs';
import { check, options, pictures, until, waitFor } from './support.mjs';

const given = options();
const shot = pictures(given, 'recipes-', { fullPage: true });

async function valuesNow(page) {
  const { json } = await asks(page, 'GET', '/api/recipe-tags');
  return Object.fromEntries(json.tags.map(({ name, value }) => [name.replace('Main.', ''), value]));
}

async function opensThePanel(page) {
  check((await page.locator('[data-panel=recipes]').count()) === 0, 'the panel is closed at first');
  await page.getByRole('button', { name: 'Recipes' }).click();
  await waitFor(page, 'it says that there is no recipe yet', () => document.querySelector('[data-panel=recipes]')?.innerText.includes('There is no recipe yet'));
}

const field = (page, tag) => page.locator(`[data-recipe-field="Main.${tag}"]`);

async function saves(page) {
  await page.getByRole('button', { name: 'New recipe …' }).click();
  await until('a new recipe begins with the values of now', async () => (await field(page, 'level').locator('input').inputValue().catch(() => '')) === '12.5');
  await fill(page, { Name: 'Blue 20 l', Comment: 'for the small drum' });
  await field(page, 'level').locator('input').fill('120');
  await field(page, 'batches').locator('input').fill('many');
  await page.keyboard.press('Enter');
  await waitFor(page, 'what is out of range or no number is told at its field, all at once', () =>
    document.querySelector('[data-recipe-field="Main.level"]').innerText.includes('0 to 100 %') &&
    document.querySelector('[data-recipe-field="Main.level"]').innerText.includes('out of range') &&
    document.querySelector('[data-recipe-field="Main.batches"]').innerText.includes('no value of the type INT') &&
    document.querySelector('[data-testid=problem]').innerText.includes('Nothing was saved: 2 values'));
  await isAccessible(page, 'a recipe that is wrong');
  await shot(page, 'wrong');
  check((await asks(page, 'GET', '/api/recipes')).json.recipes.length === 0, 'nothing was saved');
  await field(page, 'level').locator('input').fill('20');
  await field(page, 'batches').locator('input').fill('4');
  await field(page, 'stir').locator('select').selectOption('TRUE');
  await field(page, 'soak').locator('input').fill('t#1.5m');
  await page.keyboard.press('Enter');
  await dialogIsGone(page, 'what is right is saved, with the keyboard');
  await waitFor(page, 'and compared with the running program', () => document.querySelector('[data-testid=recipe-summary]')?.innerText === '4 of 4 differ');
  check((await asks(page, 'GET', '/api/recipes/Blue%2020%20l')).json.values['Main.soak'] === 'T#1m30s', 'a value is spelt as the program does');
}

async function comparesTwo(page) {
  const red = { comment: '', values: { 'Main.level': '20.0', 'Main.batches': '5', 'Main.stir': '1', 'Main.soak': 'T#90s' } };
  check((await asks(page, 'PUT', '/api/recipes/Red', red)).status === 200, 'the API saves as well');
  await page.getByRole('button', { name: 'Look again' }).click();
  await waitFor(page, 'the list has both', () => document.querySelectorAll('[data-recipe]').length === 2);
  await page.getByLabel('Compare with').selectOption('Red');
  await waitFor(page, 'values that mean the same are the same', () =>
    document.querySelector('[data-testid=recipe-summary]').innerText === '1 of 4 differ' &&
    document.querySelector('[data-tag="Main.batches"]').dataset.state === 'differs');
  await isAccessible(page, 'two recipes side by side');
  await shot(page, 'compare');
  await page.getByLabel('Compare with').selectOption('');
}

async function loads(page) {
  await logsIn(page, 'olga');
  check((await page.getByRole('button', { name: /New recipe|Change …|Remove …/ }).count()) === 0, 'an operator saves and removes nothing');
  check((await asks(page, 'PUT', '/api/recipes/Red', { values: {} })).status === 403, 'and would be refused');
  check((await asks(page, 'DELETE', '/api/recipes/Red')).status === 403, 'likewise');
  await page.locator('[data-recipe="Blue 20 l"]').click();
  await page.getByRole('button', { name: 'Load …' }).click();
  await isAccessible(page, 'loading');
  await shot(page, 'load');
  await fill(page, { Reason: 'next batch' });
  await page.keyboard.press('Enter');
  await dialogIsGone(page, 'the recipe is loaded');
  await until('the running program has all values', async () =>
    JSON.stringify(await valuesNow(page)) === JSON.stringify({ level: '20.0', batches: '4', stir: 'TRUE', soak: 'T#1m30s' }));
  await waitFor(page, 'and the page says so by itself', () => document.querySelector('[data-testid=recipe-summary]').innerText === 'all values are the same');
  await waitFor(page, 'the program computes with them', () =>
    [...document.querySelectorAll('[data-panel=tags] tbody tr')].some((row) => row.innerText.includes('total') && /\b80\b/.test(row.innerText)));
}

const torn = (cell) => Number(/torn\D*(\d+)/.exec(cell.run('snapshot', '--config', cell.config, 'Main.torn'))[1]);

// The program counts the scans in which it has seen a part of a recipe.
async function loadsWithinOneScan(page, cell) {
  const green = { comment: '', values: { 'Main.level': '30.0', 'Main.batches': '6', 'Main.stir': 'FALSE', 'Main.soak': 'T#10s' } };
  check((await asks(page, 'PUT', '/api/recipes/Green', green)).status === 200, 'there is a recipe that differs in all values');
  const load = async (name) => (await asks(page, 'POST', `/api/recipes/${name}/load`, { reason: 'over and over' })).status;
  const before = torn(cell);
  let loaded = 0;
  for (let i = 0; i < 40; ++i) loaded += (await load(i % 2 === 0 ? 'Green' : 'Blue%2020%20l')) === 200 ? 1 : 0;
  check(loaded === 40, `recipes were loaded ${loaded} times in turn`);
  check(torn(cell) === before, `and no scan has seen half of one (${torn(cell) - before})`);
  check((await asks(page, 'POST', '/api/tags/write', { name: 'Main.level', value: '21', reason: 'alone' })).status === 200, 'a value that is written alone');
  await until('is what such a scan looks like', () => torn(cell) === before + 1);
  check((await load('Blue%2020%20l')) === 200, 'the recipe is as before');
  check((await asks(page, 'DELETE', '/api/recipes/Green')).status === 200, 'and the other one is gone');
}

// A file that somebody has changed by hand: nothing of it reaches the program.
async function refusesWhatDoesNotFit(page, cell) {
  const spoilt = { format: 1, name: 'Spoilt', comment: '', saved_by: 'nobody', saved_s: 0, values: { 'Main.level': '50', 'Main.batches': '21', 'Main.stir': 'TRUE' } };
  writeFileSync(join(cell.recipes, 'Spoilt.json'), JSON.stringify(spoilt));
  writeFileSync(join(cell.recipes, 'Torn.json'), '{"format": 1, "name": "To');
  await page.getByRole('button', { name: 'Look again' }).click();
  await waitFor(page, 'it is marked in the list, and so is a damaged file', () =>
    ['Spoilt', 'Torn'].every((name) => document.querySelector(`[data-recipe="${name}"]`)?.innerText.includes('does not fit')));
  await page.locator('[data-recipe=Spoilt]').click();
  await waitFor(page, 'everything that is wrong with it is told', () => {
    const told = document.querySelector('[data-testid=recipe-problems]')?.innerText ?? '';
    return told.includes('Main.batches: 21 is out of range') && told.includes('Main.soak: the recipe has no value');
  });
  check(await page.getByRole('button', { name: 'Load …' }).isDisabled(), 'it cannot be loaded on the page');
  const refused = await asks(page, 'POST', '/api/recipes/Spoilt/load', { reason: 'all the same' });
  check(refused.status === 400 && refused.json.problems.map(({ code }) => code).sort().join() === 'H0074,H0077', `nor by the API (${JSON.stringify(refused.json)})`);
  check((await valuesNow(page)).level === '20.0', 'not even its values that would fit were written');
  await isAccessible(page, 'a recipe that does not fit');
  await shot(page, 'spoilt');
}

async function refusesWhatIsForced(page, cell) {
  await logsIn(page, 'emil');
  check((await asks(page, 'POST', '/api/tags/force', { name: 'Main.batches', value: '2', reason: 'test of recipes', minutes: 5 })).status === 200, 'a tag is forced');
  await page.locator('[data-recipe=Red]').click();
  await page.getByRole('button', { name: 'Load …' }).click();
  await fill(page, { Reason: 'while it is forced' });
  await page.keyboard.press('Enter');
  await waitFor(page, 'a recipe with it is refused in words', () => document.querySelector('[data-testid=problem]').innerText.includes('Main.batches: it is forced'));
  await page.keyboard.press('Escape');
  await asks(page, 'POST', '/api/tags/unforce', { name: 'Main.batches', reason: 'test of recipes' });
  cell.run('force', '--config', cell.config, 'MAIN.STIR', 'FALSE');
  await waitFor(page, 'what somebody else forces is known, too', () => document.querySelector('[data-testid=forces]')?.innerText.includes('Main.stir'));
  const refused = await asks(page, 'POST', '/api/recipes/Red/load', { reason: 'while it is forced' });
  check(refused.status === 409 && refused.json.problems[0].code === 'H0079', `and keeps a recipe from being loaded (${JSON.stringify(refused.json)})`);
  cell.run('unforce', '--config', cell.config, '--all');
  await waitFor(page, 'until it is released', () => document.querySelector('[data-testid=forces]') === null);
}

async function removes(page) {
  await page.locator('[data-recipe=Torn]').click();
  await page.getByRole('button', { name: 'Remove …' }).click();
  await dialog(page).getByRole('button', { name: 'Remove' }).click();
  await dialogIsGone(page, 'an engineer removes what is damaged');
  await waitFor(page, 'and it is gone', () => document.querySelectorAll('[data-recipe]').length === 3);
}

async function trailTells(page, cell) {
  const { entries } = (await asks(page, 'GET', '/api/audit')).json;
  const entry = (action, target, result) => entries.find((one) => one.action === action && one.target === target && one.result.startsWith(result));
  const load = entry('recipe.load', 'Blue 20 l', 'done');
  check(load.user === 'olga' && load.reason === 'next batch', 'the trail has who loaded what, and why');
  check(load.before.includes('Main.level = 12.5') && load.after.includes('Main.level = 20.0'), 'with the values before and after');
  check(entry('recipe.save', 'Blue 20 l', 'refused: H0077'), 'what was refused');
  check(entry('recipe.load', 'Red', 'refused: H0079'), 'for what reason');
  check(entry('recipe.remove', 'Torn', 'done'), 'and what was removed');
  check(/^\d+ entries/.test(cell.run('hmi', '--verify-audit', cell.trail)), 'its chain holds');
}

async function fitsEveryWidth(page) {
  await page.locator('[data-recipe="Blue 20 l"]').click();
  for (const scheme of ['light', 'dark']) {
    await page.emulateMedia({ colorScheme: scheme });
    for (const width of [1440, 360]) {
      await page.setViewportSize({ width, height: 900 });
      await waitFor(page, `nothing sticks out at ${width} px, ${scheme}`, (most) => document.documentElement.scrollWidth <= most, width);
      await shot(page, `${scheme}-${width}`);
    }
    await isAccessible(page, `the panel, ${scheme}`);
  }
  await page.getByRole('button', { name: 'Change …' }).click();
  await until('the dialog has its fields', async () => (await page.locator('[data-recipe-field]').count()) === 4);
  const wide = await page.evaluate(() => document.querySelector('dialog').scrollWidth - document.querySelector('dialog').clientWidth);
  check(wide <= 0, `the dialog fits in 360 px (${wide})`);
  await shot(page, 'edit-360', { fullPage: false });
  await page.keyboard.press('Escape');
  await dialogIsGone(page, 'Escape closes it');
  await page.setViewportSize({ width: 1440, height: 900 });
  await page.emulateMedia({ colorScheme: 'light' });
}

async function staysAfterARestart(page, cell) {
  await cell.stop('hmi', 'SIGKILL');
  await cell.serve();
  await waitFor(page, 'the page is live again', () => document.querySelector('[data-testid=link]').innerText === 'live');
  const { json } = await asks(page, 'GET', '/api/recipes');
  check(json.recipes.map(({ name }) => name).join() === 'Blue 20 l,Red,Spoilt', 'all recipes are there after a kill');
}

await leadOverPage(given, {
  name: 'recipes',
  expected: [400, 401, 403, 409],
  start: () => startMixer(given.server),
  steps: async (page, cell) => {
    await claims(page, await cell.setupToken());
    await addsUsers(page);
    await logsIn(page, 'emil');
    await opensThePanel(page);
    await saves(page);
    await comparesTwo(page);
    await loads(page);
    await refusesWhatDoesNotFit(page, cell);
    await refusesWhatIsForced(page, cell);
    await removes(page);
    await trailTells(page, cell);
    await loadsWithinOneScan(page, cell);
    await fitsEveryWidth(page);
    await staysAfterARestart(page, cell);
  },
});
