// The running program is changed from the page, against a real runtime, link and server: what would be different is shown
// first, values go on, what traps is rolled back, earlier programs come back, and only an engineer may do it.

import { readdirSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

import { startBottles } from './change_cell.mjs';
import { leadOverPage } from './page_run.mjs';
import { addsUsers, asks, claims, codeOf, dialog, dialogIsGone, fill, isAccessible, logsIn } from './people.mjs';
import { DRAWN, TEXT } from './program_sources.mjs';
import { check, drawn, fitsEachLook, options, pictures, until, waitFor } from './support.mjs';

const given = options();
const shot = pictures(given, 'change-', { fullPage: true });

async function operatorMayNot(page) {
  await logsIn(page, 'olga');
  await page.locator('#program-more').waitFor();
  check((await page.locator('#change-more').count()) === 0, 'an operator has no way to the panel');
  const digest = '0'.repeat(64);
  for (const [method, path, body] of [
    ['GET', '/api/change'],
    ['GET', `/api/change/diff?program=${digest}`],
    ['GET', `/api/change/sources?program=${digest}`],
    ['POST', '/api/change/check', { files: { 'a.st': 'x' } }],
    ['POST', '/api/change/apply', { program: digest, base: digest, charts: 'keep', reason: 'because' }],
  ])
    check(codeOf(await asks(page, method, path, body)) === '403 H0042', `and would be refused at ${method} ${path.split('?')[0]}`);
}

async function opensByKeyboard(page) {
  await logsIn(page, 'emil');
  const fetched = () => page.evaluate(() => performance.getEntriesByType('resource').some((one) => /ChangePanel/.test(one.name)));
  await page.locator('#change-more').waitFor();
  check(!(await fetched()), 'the panel is not fetched at the start');
  await page.locator('#change-more').focus();
  await page.keyboard.press('Enter');
  await waitFor(page, 'it opens and has the focus', () => document.activeElement?.id === 'change-details');
  await waitFor(page, 'and says that there is no earlier program', () => document.querySelector('[data-testid=no-versions]') !== null);
  await isAccessible(page, 'the panel with nothing chosen');
  await shot(page, 'empty');
}

// Longer than what a force holds: whole between two scans, or not at all.
async function writesText(page) {
  const search = page.getByLabel('Search tags by name or address');
  await search.fill('Main.label');
  await page.getByRole('button', { name: 'Set Main.label' }).click();
  check((await dialog(page).getByRole('radio').count()) === 0, 'a text is not offered to be forced');
  await fill(page, { Value: 'line 2: fill and close', Reason: 'test of texts' });
  await page.keyboard.press('Enter');
  await waitFor(page, 'one that is too long is refused with both lengths', () => /22 characters.* 20/.test(document.querySelector('[data-testid=problem]').innerText));
  await isAccessible(page, 'writing a text');
  await shot(page, 'text');
  await fill(page, { Value: 'line 2: fill, close' });
  await page.keyboard.press('Enter');
  await dialogIsGone(page, 'one that fits is written');
  await waitFor(page, 'and stands in the program', () =>
    [...document.querySelectorAll('[data-panel=tags] tbody tr')].some((row) => row.innerText.startsWith('Main.label') && row.innerText.includes('line 2: fill, close')));
  await page.getByRole('button', { name: 'Set Main.label' }).click();
  await fill(page, { Value: '', Reason: 'test of texts' });
  await page.keyboard.press('Enter');
  await dialogIsGone(page, 'nothing is a text, too');
  await waitFor(page, 'and stands there', () =>
    [...document.querySelectorAll('[data-panel=tags] tbody tr')].some((row) => row.innerText.startsWith('Main.label') && !row.innerText.includes('line')));
  await search.fill('');
}

const chooses = (page, ...files) => page.getByTestId('program-file').setInputFiles(files);
const isCompared = (page, what) => waitFor(page, what, () => (document.querySelector('[data-testid=comparison]')?.dataset.program ?? '').length === 64);
const listed = (page, list) => page.locator(`[data-list="${list}"] tbody tr`).evaluateAll((rows) => rows.map((row) => row.innerText.replace(/\s+/g, ' ').trim()));
const countNow = async (page) => Number((await page.evaluate(() => [...document.querySelectorAll('[data-panel=tags] tbody tr')].find((row) => /^Count\b/.test(row.innerText))?.innerText ?? '')).match(/(\d[\d,]*)\s*\D*$/)?.[1].replaceAll(',', '') ?? NaN);

async function wrongFilesSayWhere(page, cell) {
  await chooses(page, cell.file('wrong.st'));
  await waitFor(page, 'sources that do not compile say where', () => document.querySelectorAll('[data-testid=places] li').length >= 2);
  const places = await page.locator('[data-testid=places] li').evaluateAll((list) => list.map((one) => one.innerText));
  check(places.some((text) => /wrong\.st:\d+:\d+/.test(text) && text.includes('speeed') && text.includes('did you mean')), `each has file, line, column and hint: ${places.join(' | ')}`);
  check(places.some((text) => text.includes('ready := speeed > 0;')), 'and the line as it was written');
  await isAccessible(page, 'what the compiler says');
  await shot(page, 'wrong');
  writeFileSync(cell.file('torn.swb'), readFileSync(cell.file('first.swb')).subarray(0, 700));
  await chooses(page, cell.file('torn.swb'));
  await waitFor(page, 'a truncated container is told', () => document.querySelector('[data-testid=places]')?.innerText.includes('B000'));
  writeFileSync(cell.file('noise.swb'), 'this is no program');
  await chooses(page, cell.file('noise.swb'));
  await waitFor(page, 'garbage, too', () => document.querySelector('[data-testid=places] [data-code=B0001]') !== null);
  const large = await asks(page, 'POST', '/api/change/apply', { program: 'x'.repeat(20_000), base: '', charts: 'keep', reason: 'large' });
  check(large.status === 413, 'no other route takes a large body');
}

// Ladder and function blocks as PLCopen files, beside the text that belongs to them.
async function takesDrawnPrograms(page, cell) {
  writeFileSync(cell.file('text.st'), TEXT);
  writeFileSync(cell.file('drawn.xml'), DRAWN);
  writeFileSync(cell.file('torn.xml'), DRAWN.slice(0, DRAWN.length / 2));
  await chooses(page, cell.file('text.st'), cell.file('torn.xml'));
  await waitFor(page, 'a drawn program that is torn says where', () => /torn\.xml:\d+/.test(document.querySelector('[data-testid=places]')?.innerText ?? ''));
  await chooses(page, cell.file('text.st'), cell.file('drawn.xml'));
  await isCompared(page, 'text and a drawn program are compiled together');
  check((await listed(page, 'added')).some((row) => row.includes('smooth_level')), 'and compared with what runs');
  check((await page.locator('[data-sheet-diff=Ladder]').count()) === 1, 'ladders, too');
  await isAccessible(page, 'a comparison with drawn programs');
  await shot(page, 'drawn');
}

async function showsWhatIsDifferent(page, cell) {
  await chooses(page, cell.file('second.st'));
  await isCompared(page, 'sources are compiled and compared');
  check((await listed(page, 'added')).join() === 'Main.rejected UINT', `what is new: ${await listed(page, 'added')}`);
  check((await listed(page, 'removed')).join().startsWith('Main.label'), `what goes: ${await listed(page, 'removed')}`);
  check(/Main.speed INT.*DINT/.test((await listed(page, 'retyped')).join()), `what has another type: ${await listed(page, 'retyped')}`);
  await waitFor(page, 'the step that is new', () => document.querySelector('[data-steps=added]')?.innerText.includes('Station.Draining'));
  const lines = (kind) => page.locator(`[data-sheet-diff=Bottles] [data-line=${kind}]`).evaluateAll((rows) => rows.map((row) => row.querySelector('.text').textContent.trim()));
  check((await lines('added')).includes('Lamp := Count MOD 3 = 0;') && (await lines('removed')).includes('Lamp := Count MOD 2 = 0;'), 'sources are compared line by line');
  check((await page.locator('[data-sheet-diff=Filler]').count()) === 1, 'charts, too');
  await isAccessible(page, 'the differences');
  await shot(page, 'compared');
  await fitsEachLook(page, [['light', 1440], ['dark', 1440], ['light', 360], ['dark', 360]], async (look) => {
    await isAccessible(page, `the differences, ${look}`);
    await shot(page.locator('#change-details'), `compared-${look}`);
  });
  await page.emulateMedia({ colorScheme: 'light' });
  await page.setViewportSize({ width: 1440, height: 900 });
  const look = (theme, colours) => page.evaluate(([one, other]) => Object.assign(document.documentElement.dataset, { theme: one, colours: other }), [theme, colours]);
  for (const theme of ['light', 'dark']) {
    await look(theme, 'distinct');
    await isAccessible(page, `the differences in colours that everybody tells apart, ${theme}`);
    await shot(page.locator('#change-details'), `distinct-${theme}`);
  }
  await page.evaluate(() => {
    document.documentElement.dataset.theme = 'light';
    delete document.documentElement.dataset.colours;
  });
}

async function acts(page, reason) {
  await page.locator('[data-testid=change-form]').getByLabel('Reason').fill(reason);
  await page.keyboard.press('Enter');
}

const digestNow = async (page) => (await asks(page, 'GET', '/api/change')).json.running;

async function changesAndKeeps(page, cell) {
  const before = await digestNow(page);
  await until('the counter counts', async () => (await countNow(page)) > 100);
  const count = await countNow(page);
  await acts(page, 'every third bottle');
  await waitFor(page, 'the new program is kept', () => document.querySelector('[data-testid=outcome]')?.dataset.outcome === 'kept');
  const after = await countNow(page);
  check(after >= count, `the counter has gone on (${count}, then ${after})`);
  const figures = await page.locator('[data-testid=outcome] [data-figure]').evaluateAll((list) => Object.fromEntries(list.map((one) => [one.dataset.figure, one.querySelector('dd').innerText])));
  check(Number(figures.carried) >= 4 && figures.retyped === '1' && Number(figures.dropped) >= 1 && /µs/.test(figures.pause), `what was carried is told: ${JSON.stringify(figures)}`);
  await waitFor(page, 'both programs can be brought back', () => document.querySelectorAll('[data-version]').length === 2);
  check((await page.locator(`[data-version="${before}"]`).getAttribute('data-outcome')) === 'found', 'the one that ran before was found');
  for (const file of readdirSync(cell.versions)) check((statSync(join(cell.versions, file)).mode & 0o777) === 0o600, `${file.slice(0, 8)} is for the server only`);
  const again = await asks(page, 'POST', '/api/change/apply', { program: before, base: before, charts: 'keep', reason: 'from an old page' });
  check(codeOf(again) === '409 H0092', `a difference to another program is no ground to change: ${codeOf(again)}`);
  await shot(page, 'kept');
  return before;
}

// A trial of ten slow scans, and what may not happen meanwhile.
async function followsTheTrial(page, cell) {
  await chooses(page, cell.file('slow.st'));
  await isCompared(page, 'a program with another task is compared');
  check((await listed(page, 'tasks')).join() === 'Cycle 10 ms, priority 1 → becomes 300 ms, priority 1', `the task has another interval: ${await listed(page, 'tasks')}`);
  const base = await digestNow(page);
  await acts(page, 'as slow as the belt');
  await waitFor(page, 'its trial is followed scan by scan', () => /scan [1-9] of 10/.test(document.querySelector('[data-testid=outcome]')?.innerText ?? ''));
  const other = await asks(page, 'POST', '/api/change/apply', { program: base, base: await digestNow(page), charts: 'keep', reason: 'too early' });
  check(codeOf(other) === '409 H0098', `one trial at a time: ${codeOf(other)}`);
  await shot(page, 'trial');
  await waitFor(page, 'and kept at its end', () =>
    document.querySelector('[data-testid=outcome]')?.dataset.outcome === 'kept' && document.querySelector('[data-testid=outcome]').innerText.includes('slow.st'));
}

async function rollsBack(page, cell) {
  cell.compile('trapping');
  const before = await digestNow(page);
  await chooses(page, cell.file('trapping.swb'));
  await isCompared(page, 'a container is compared');
  const count = await countNow(page);
  await acts(page, 'a new limit');
  await waitFor(page, 'what traps is rolled back by the runtime', () => document.querySelector('[data-testid=outcome]')?.dataset.outcome === 'rolled_back');
  const why = await page.getByTestId('why').innerText();
  check(/trapping\.st:\d+/.test(why) && /division by zero/.test(why), `and the page says why and where: ${why}`);
  check((await digestNow(page)) === before, 'the program before runs again');
  await until('and counts on', async () => (await countNow(page)) > count);
  await waitFor(page, 'the list says so', () => document.querySelector('[data-outcome=rolled_back][data-version]') !== null);
  await isAccessible(page, 'a change that was rolled back');
  await shot(page, 'rolled-back');
}

async function saysWhatWouldBeRefused(page, cell) {
  cell.force('Station.go', 'TRUE');
  await waitFor(page, 'a step is active', () => document.querySelector('[data-testid=active-steps]')?.textContent.includes('Filling'));
  await chooses(page, cell.file('stepless.st'));
  await isCompared(page, 'a program without this step is compared');
  await waitFor(page, 'what would be refused is told before', () => document.querySelector('[data-testid=refusals] [data-code=R0033]')?.textContent.includes('Filling'));
  await waitFor(page, 'the step is marked as active', () => document.querySelector('[data-steps=removed] .active') !== null);
  await acts(page, 'all the same');
  await waitFor(page, 'the runtime refuses it, too', () => document.querySelector('[data-testid=change-form] [data-testid=problem]')?.innerText.includes('Filling'));
  await shot(page, 'refused');
  await page.getByRole('radio', { name: /Restart the charts/ }).check();
  await waitFor(page, 'charts that begin anew lose no step', () => document.querySelector('[data-testid=refusals]') === null);
  await chooses(page, cell.file('moved.st'));
  await isCompared(page, 'an output that moves is compared');
  await waitFor(page, 'and would be refused in any case', () => document.querySelector('[data-testid=refusals] [data-code=R0034]') !== null);
  check(/%QX0.0.*%QX0.3/.test((await listed(page, 'moved')).join()), `with both addresses: ${await listed(page, 'moved')}`);
  cell.force('Station.go', 'FALSE');
}

async function noticesAnotherProgram(page, cell) {
  cell.compile('second');
  await chooses(page, cell.file('first.swb'));
  await isCompared(page, 'a program is compared once more');
  await waitFor(page, 'while the station waits', () => document.querySelector('[data-testid=active-steps]')?.textContent.includes('Waiting'));
  writeFileSync(cell.file('fourth.st'), readFileSync(cell.file('second.st'), 'utf8').replace('MOD 3', 'MOD 4'));
  cell.compile('fourth', '--bare');
  cell.change('fourth');
  await waitFor(page, 'a program that somebody else brings is noticed', () => document.querySelector('[data-testid=compared-anew]') !== null);
  await waitFor(page, 'and that it has no sources', () => document.querySelector('[data-testid=without-sources]')?.innerText.includes('running program carries no sources'));
  await shot(page, 'anew');
}

async function bringsBack(page, cell, first) {
  await cell.stop('hmi');
  const [one] = readdirSync(cell.versions).filter((file) => !file.startsWith(first));
  writeFileSync(join(cell.versions, one), readFileSync(join(cell.versions, one)).subarray(0, 900));
  await cell.serve();
  await page.reload();
  await logsIn(page, 'emil');
  await page.getByRole('button', { name: 'All', exact: true }).click();
  await page.locator('#change-more').click();
  await waitFor(page, 'after a restart the list is there, and a damaged file is told', () =>
    document.querySelectorAll('[data-version]').length === 3 && document.querySelector('[data-testid=damaged]')?.innerText.includes('is damaged'));
  await page.locator(`[data-version="${first}"]`).focus();
  await page.keyboard.press('Enter');
  await isCompared(page, 'an earlier program is compared, by the keyboard');
  const count = await countNow(page);
  await acts(page, 'the new one is too slow');
  await waitFor(page, 'it is back', () => document.querySelector('[data-testid=outcome]')?.dataset.outcome === 'kept');
  check((await digestNow(page)) === first, 'and it is the first one');
  check((await countNow(page)) >= count, 'the counter has gone on');
  await waitFor(page, 'the list says that it runs', (digest) => document.querySelector(`[data-version="${digest}"]`)?.innerText.includes('runs'), first);
  await shot(page, 'back');
}

function trailTells(cell) {
  const entries = readFileSync(cell.trail, 'utf8').trim().split('\n').map((line) => JSON.parse(line));
  const told = (action, result) => entries.find((one) => one.action === action && one.result.startsWith(result) && one.user === 'emil');
  const rolled = told('change.outcome', 'rolled back by the runtime: ');
  check(rolled?.reason === 'a new limit' && rolled.before.length === 64 && /division by zero/.test(rolled.result), `the trail has what was rolled back: ${JSON.stringify(rolled)}`);
  const kept = told('change.outcome', 'kept');
  check(kept?.reason === 'every third bottle' && kept.before !== kept.after, 'and what was kept, with both digests');
  check(told('change.apply', 'begun') && told('change.apply', 'refused: R0033') && told('change.check', 'done'), 'and every attempt');
}

async function speaksOtherLanguages(page) {
  await page.setViewportSize({ width: 360, height: 900 });
  for (const [code, title] of [['de', 'Programm ändern'], ['fr', 'Modifier le programme'], ['es', 'Cambiar el programa']]) {
    await page.evaluate((language) => localStorage.setItem('stepwright.language', language), code);
    await page.reload();
    await page.locator('#change-more').click();
    await page.locator('[data-version]:not([disabled])').first().click();
    await isCompared(page, `${code}: an earlier program is compared`);
    check((await page.locator('#title-change-details').innerText()) === title, `the panel is in ${code}`);
    await drawn(page);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    check(wide <= 360, `and fits in 360 px (${wide})`);
    await shot(page.locator('#change-details'), `${code}-360`);
  }
  await page.evaluate(() => localStorage.setItem('stepwright.language', 'en'));
  await page.setViewportSize({ width: 1440, height: 900 });
  await page.reload();
  await page.locator('#change-more').click();
  await waitFor(page, 'and in English again', () => document.querySelector('#title-change-details')?.innerText === 'Change the program');
}

async function closes(page) {
  await page.locator('#change-details').focus();
  await page.keyboard.press('Escape');
  await waitFor(page, 'Escape closes the panel and gives the focus back', () =>
    document.querySelector('#change-details') === null && document.activeElement?.id === 'change-more');
}

await leadOverPage(given, {
  name: 'change',
  // 401: the open page asks the server that was restarted, which knows its session no more.
  expected: [400, 401, 403, 409, 413],
  start: () => startBottles(given.server),
  steps: async (page, cell) => {
    await claims(page, await cell.setupToken());
    await addsUsers(page);
    await operatorMayNot(page);
    await opensByKeyboard(page);
    await writesText(page);
    await page.getByRole('button', { name: 'All', exact: true }).click();
    await wrongFilesSayWhere(page, cell);
    await takesDrawnPrograms(page, cell);
    await showsWhatIsDifferent(page, cell);
    const first = await changesAndKeeps(page, cell);
    await followsTheTrial(page, cell);
    await rollsBack(page, cell);
    await saysWhatWouldBeRefused(page, cell);
    await noticesAnotherProgram(page, cell);
    await bringsBack(page, cell, first);
    trailTells(cell);
    await speaksOtherLanguages(page);
    await closes(page);
  },
});
