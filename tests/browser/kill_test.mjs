// Server, runtime and supervisor of a cell are killed in turn, as a fault or a power failure would. Each time the page
// says what is lost, comes back by itself, and its journals are whole: nothing of before is missing, and what could not
// be seen is told as such.

import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';

import { startBench } from './bench_processes.mjs';
import { asksApi, axeFile, claims, isAccessible, logsIn } from './people.mjs';
import { KEEPS_RECORDS, LEVEL_ALARM, PROGRAM, startMixer } from './recipe_cell.mjs';
import { check, endInTime, eventually, failurePicture, launchBrowser, openPage, options, pictures, until, waitFor } from './support.mjs';

const CLOCK_MS = 400; // a snapshot and an answer may be so old on a busy machine
const STILL_MS = 2_500; // less than after which a page takes its connection for lost
const OVERRUN_MS = 800; // less than after which the link takes a receiver for gone
const SHIFT_MS = 150; // of the history's clock to that of the test, at most

const ALARMS = `${LEVEL_ALARM}
[[alarm]]
name = "stirs"
source = "Main.stir"
when = "on"
priority = "low"

[[alarm]]
name = "misspelt"
source = "Main.stri"
`;

// Images of 800 KB: what waits for a receiver that stands still soon fills its socket.
const HEAVY = PROGRAM.replace('torn : DINT;', 'torn : DINT;\n    ballast : ARRAY[1..200000] OF DINT;');

const given = options();

const shot = pictures(given, 'kill-');
const get = (page, path) => page.evaluate(async (where) => (await fetch(where)).json(), path);
const tells = (page, what, words) => waitFor(page, what, (text) => document.querySelector('[data-testid=banner]')?.innerText.includes(text), words);
const tellsNothing = (page, what) => waitFor(page, what, () => document.querySelector('[data-testid=banner]') === null);

// Gone with every load of the page.
async function wasNotLoadedAgain(page) {
  check(await page.evaluate(() => globalThis.sameLoad === true), 'and nobody has loaded the page anew');
}

// The newest first.
const journalOf = async (page) => (await get(page, '/api/alarms/journal?most=500')).entries;

async function happened(page, what, alarm, event, more = () => true) {
  await until(what, async () => (await journalOf(page)).some((entry) => entry.alarm === alarm && entry.event === event && more(entry)));
  return (await journalOf(page)).find((entry) => entry.alarm === alarm && entry.event === event && more(entry));
}

// Whatever was in the journal is there as it was, and before what came since.
async function keepsTheJournal(page, before) {
  const now = await journalOf(page);
  const kept = now.slice(now.length - before.length);
  check(JSON.stringify(kept) === JSON.stringify(before), `all ${before.length} entries of before are in the journal as they were`);
  return now.slice(0, now.length - before.length);
}

const auditLines = (cell) => readFileSync(cell.trail, 'utf8').split('\n').filter((line) => line !== '');

// As soon as images come.
async function keepsToRealTime(page) {
  await until(`the clock of the history is that of the machine, to ${CLOCK_MS} ms`, async () => {
    const { now_ms: now } = await get(page, '/api/history/tags');
    return Math.abs(now - Date.now()) < CLOCK_MS;
  });
}

async function actsBefore(page, cell) {
  await keepsToRealTime(page);
  check((await asksApi(page, '/api/tags/write', { name: 'Main.level', value: '60', reason: 'test of alarms' })) === '200', 'the level is raised');
  await page.getByRole('button', { name: 'Alarms' }).click();
  await page.getByRole('button', { name: 'Journal' }).click();
  const raised = await happened(page, 'its alarm is raised', 'level.high', 'raise', ({ value }) => value === 60);
  check(raised.comment === '', 'by a server that saw it happen');
  check((await asksApi(page, '/api/alarms/acknowledge', { name: 'level.high', reason: 'seen' })) === '200', 'and acknowledged');
  await page.getByRole('button', { name: 'Standing' }).click();
  await waitFor(page, 'an alarm whose variable the program does not have is not normal', () => document.querySelector('[data-alarm="misspelt"]')?.dataset.state === 'no variable');
  check((await page.getByTestId('no-variable').innerText()) === '1 alarm without its variable', 'and the bar counts it');
  await page.locator('[data-alarm="misspelt"] button').click();
  check((await page.getByTestId('alarm-list').innerText()).includes("the program has no variable 'Main.stri'"), 'the list says why');
  await shot(page, 'no-value');
  await page.getByRole('button', { name: 'Journal' }).click();
  await page.locator('#scan-more').click();
  await waitFor(page, 'no plant is spoken of where there is none', () => document.querySelector('[data-testid=io-kind]')?.innerText.startsWith('Nothing:'));
  await page.keyboard.press('Escape');
  check((await asksApi(page, '/api/tags/force', { name: 'Main.batches', value: '2', minutes: 5, reason: 'test of the banner' })) === '200', 'a variable is forced from the page');
  cell.run('force', '--config', cell.config, 'Main.soak', 'T#9s');
  await waitFor(page, 'another one at the socket of the runtime: the banner shows both', () => {
    const told = document.querySelector('[data-testid=forces]')?.innerText ?? '';
    return told.includes('2 variables are forced') && told.includes('Main.batches = 2') && /Main\.soak = T#9s.*not forced from this page/is.test(told);
  });
  await isAccessible(page, 'a banner with the force of somebody else');
  await shot(page, 'forces');
}

async function theServerIsKilled(page, cell) {
  const before = await journalOf(page);
  const trail = auditLines(cell);
  await cell.stop('hmi', 'SIGKILL');
  const killedMs = Date.now();
  await tells(page, 'the page says that the server is lost', 'No connection to the HMI server');
  await shot(page, 'server');
  // Meanwhile: one alarm's condition goes, another one's comes, and the page's own force is ended by somebody else.
  cell.run('force', '--config', cell.config, 'Main.level', '10.0');
  cell.run('force', '--config', cell.config, 'Main.stir', 'TRUE');
  cell.run('unforce', '--config', cell.config, 'Main.batches');
  await cell.serve();
  await tells(page, 'the page comes back by itself, and says who has to log in again', 'Your session has ended');
  await wasNotLoadedAgain(page);
  await keepsToRealTime(page);
  const back = await happened(page, 'what has returned meanwhile is in the journal', 'level.high', 'return');
  check(/^not seen since \d{4}-\d\d-\d\dT/.test(back.comment), `as something that nobody saw happen: ${back.comment}`);
  const sinceMs = Date.parse(back.comment.slice(15));
  check(sinceMs <= killedMs + CLOCK_MS && back.time_ms > sinceMs, `between the last look and the first one (killed at ${killedMs}: ${sinceMs} to ${back.time_ms})`);
  const came = await happened(page, 'and so is what has come', 'stirs', 'raise');
  check(came.comment.startsWith('not seen since '), `of which the same is said: ${came.comment}`);
  const fresh = await keepsTheJournal(page, before);
  const away = fresh.filter(({ alarm }) => alarm === 'server.away').reverse();
  check(away.map(({ event }) => event).join() === 'raise,return', 'the journal has the absence of the server itself');
  check(away[0].time_ms <= killedMs + CLOCK_MS && away[1].time_ms > away[0].time_ms, `from its last look to its first one (${Math.round(away[1].time_ms - away[0].time_ms)} ms)`);
  await waitFor(page, 'people read it in their words', () => document.querySelector('[data-testid=journal]')?.innerText.includes('not seen to happen; seen last at'));
  if ((await page.getByTestId('log-out').count()) === 0) await logsIn(page, 'root');
  check(trail.every((line, i) => auditLines(cell)[i] === line), `all ${trail.length} entries of the audit trail are there`);
  check(/^\d+ entries/.test(cell.run('hmi', '--verify-audit', cell.trail)), 'and its chain holds');
  await waitFor(page, 'the force that somebody has ended is no longer shown, those of others are', () => {
    const told = document.querySelector('[data-testid=forces]')?.innerText ?? '';
    return told.includes('3 variables are forced') && !told.includes('Main.batches');
  });
  await until('the trail says that it has ended by itself', () =>
    auditLines(cell).some((line) => line.includes('"tag.unforce"') && line.includes('Main.batches') && line.includes('does not force it any more')));
  await page.getByTestId('journal').scrollIntoViewIfNeeded();
  await shot(page, 'journal');
}

const imagesLost = async (page) =>
  (await get(page, '/api/scan')).runtimes[0].dds.find(({ topic }) => topic.includes('/snapshot/')).lost;

// The columns of a part of the history that have no value, in ms from its begin, or the word that its end is still to come.
async function unknownIn(page, { from, to }) {
  const { known_ms: known, series, column_ms: width } = await get(page, `/api/history/trend?tags=Main.total&from_ms=${from}&to_ms=${to}&columns=25`);
  if (known <= to) return ['its end is to come'];
  return series[0].last.flatMap((value, i) => (value === null ? [i * width] : []));
}

// Half a second of which the history has everything: on a busy machine not any one.
async function wholeHalfSecond(page) {
  let whole;
  await eventually('half a second of the history is whole', async () => {
    const to = Date.now() - SHIFT_MS;
    whole = { from: to - 500, to };
    return (await unknownIn(page, whole)).length === 0;
  });
  return whole;
}

// The end of the first part of the history behind that time that has a value: on a busy machine not any part has.
async function goesOn(page, afterMs, since) {
  let end;
  await until(`${since} the history goes on`, async () => {
    const to = Math.max(afterMs + 1_000, Date.now() - SHIFT_MS);
    const { known_ms: known, from_ms: first, column_ms: width, series } = await get(page, `/api/history/trend?tags=Main.total&from_ms=${afterMs}&to_ms=${to}&columns=25`);
    const at = series[0].last.findIndex((value) => value !== null);
    end = Math.ceil(first + (at + 1) * width);
    return known > to && at >= 0;
  });
  return end;
}

// What was sent meanwhile never comes: the history must not draw what nobody saw. For `ms`; the part of it, in ms, of which
// the history knows nothing.
async function theServerStandsStill(page, cell, ms) {
  const whole = await wholeHalfSecond(page);
  const fromMs = Date.now();
  process.kill(cell.pid('hmi'), 'SIGSTOP');
  await new Promise((resolve) => setTimeout(resolve, ms));
  const toMs = Date.now();
  process.kill(cell.pid('hmi'), 'SIGCONT');
  const window = `tags=Main.total&from_ms=${whole.from}&to_ms=${await goesOn(page, toMs, `after ${toMs - fromMs} ms`)}`;
  const table = await page.evaluate(async (where) => (await fetch(where)).text(), `/api/history/export.csv?${window}`);
  const { from_ms: first, column_ms: width, series } = await get(page, `/api/history/trend?${window}&columns=200`);
  const known = series[0].last.map((value, i) => ({ at: first + i * width, value }));
  const lost = await unknownIn(page, whole);
  check(lost.length === 0, `it has what was before ${lost.join(' ')}`);
  // What has waited in its socket is seen late, with the time of its scan.
  const still = known.filter(({ at }) => at > fromMs && at + width < toMs);
  const unknown = Math.round(still.filter(({ value }) => value === null).length * width);
  if (unknown > 0) check(/,missing\r?\n/.test(table), `the table of its values says that ${unknown} ms are missing`);
  return unknown;
}

// After a second the link takes a receiver for gone and sends it nothing.
async function imagesAreNotSent(page, cell) {
  const unknown = await theServerStandsStill(page, cell, STILL_MS);
  check(unknown > STILL_MS / 3, 'and there is nothing of what nobody saw');
}

// Before that its socket runs over, which Fast DDS counts; on a busy machine not each time.
async function imagesAreLost(page, cell) {
  const before = await imagesLost(page);
  await until('images are lost on their way, as Fast DDS counts, and there is nothing of what they had shown', async () => {
    const unknown = await theServerStandsStill(page, cell, OVERRUN_MS);
    return (await imagesLost(page)) > before && unknown > 0;
  });
  console.log(`ok: ${(await imagesLost(page)) - before} of them`);
}

async function theRuntimeIsKilled(page, cell) {
  cell.run('unforce', '--config', cell.config, '--all');
  await waitFor(page, 'nothing is forced any more', () => document.querySelector('[data-testid=forces]') === null);
  check((await asksApi(page, '/api/tags/write', { name: 'Main.level', value: '70', reason: 'test of alarms' })) === '200', 'the level is raised again');
  await happened(page, 'its alarm is raised', 'level.high', 'raise', ({ value }) => value === 70);
  check((await asksApi(page, '/api/tags/force', { name: 'Main.batches', value: '5', minutes: 5, reason: 'test of the banner' })) === '200', 'and a variable is forced');
  const before = await journalOf(page);
  await cell.stop('runtime', 'SIGKILL');
  await tells(page, 'the page says that the runtime is lost', 'The runtime does not answer');
  const lost = await happened(page, 'so does the journal', 'runtime.lost', 'raise');
  await page.locator('#program-more').click();
  await waitFor(page, 'the program in detail looks as old as its values are', () =>
    document.querySelector('#program-details .columns')?.classList.contains('stale') &&
    document.querySelector('#program-details header').innerText.includes('the last values known, of scan'));
  await shot(page, 'program');
  await page.keyboard.press('Escape');
  await isAccessible(page, 'a page without a runtime');
  await shot(page, 'runtime');
  await cell.startAgain();
  await waitFor(page, 'the page comes back by itself', () => document.querySelector('[data-testid=runtime-state]').innerText === 'running');
  await tellsNothing(page, 'and has nothing more to say');
  await wasNotLoadedAgain(page);
  const found = await happened(page, 'the journal has its return', 'runtime.lost', 'return');
  check(found.time_ms > lost.time_ms && found.comment === '', 'which was seen');
  const level = await happened(page, 'what the new run has not any more has returned', 'level.high', 'return', ({ value }) => value === 12.5);
  check(level.comment.startsWith('not seen since '), `at a time that nobody saw: ${level.comment}`);
  await keepsTheJournal(page, before);
  await waitFor(page, 'what was forced has ended with the runtime, and the banner with it', () => document.querySelector('[data-testid=forces]') === null);
}

// The runtime goes on, and nobody brings it to the page.
async function theLinkIsKilled(page, cell) {
  await cell.stop('link', 'SIGKILL');
  await tells(page, 'the page says that the runtime runs and a link is missing, and what starts one', 'A runtime runs here, but no link carries it to this page: `stepwright up`');
  await shot(page, 'link');
  cell.start('link');
  await tellsNothing(page, 'the page comes back by itself');
  await wasNotLoadedAgain(page);
}

const replans = (page) => page.locator('[data-panel=replans] li p:not(.after), [aria-label="replans"] li p:not(.after)').allInnerTexts();
const phaseIs = (page, what, ...phases) => waitFor(page, what, (words) => words.includes(document.querySelector('[data-testid=phase]')?.innerText), phases);

async function theSupervisorIsKilled(page, bench) {
  // Not before: a slow browser would miss most of the run.
  await phaseIs(page, 'the bench waits for its start', 'ready');
  check((await asksApi(page, '/api/plan/start', {})) === '200', 'it is started');
  await phaseIs(page, 'the bench follows its plan', 'executing');
  const held = await asksApi(page, '/api/plan/hold', { reason: 'somebody is at the pump' });
  check(held === '200', `an operator holds it (${held})`);
  await phaseIs(page, 'and it rests', 'held');
  await until('the cause stands on the page', async () => (await replans(page)).join() === 'held by the operator');
  const before = await journalOf(page);
  await bench.stop('supervisor', 'SIGKILL');
  await tells(page, 'the page says that the supervisor is lost', 'The supervisor does not answer');
  await happened(page, 'so does the journal', 'supervisor.lost', 'raise');
  await isAccessible(page, 'a page without a supervisor');
  await shot(page, 'supervisor');
  bench.start('supervisor');
  await tellsNothing(page, 'the page comes back by itself');
  await wasNotLoadedAgain(page);
  await phaseIs(page, 'a hold outlives the supervisor', 'held');
  await happened(page, 'the journal has its return', 'supervisor.lost', 'return');
  await keepsTheJournal(page, before);
  await until('the record has every cause, that of before the restart, too', async () =>
    (await replans(page)).join() === 'held by the operator; the supervisor was restarted meanwhile,held by the operator');
  await shot(page, 'held');
  check((await asksApi(page, '/api/plan/resume', { reason: 'he has gone' })) === '200', 'the operator lets it go on');
  await phaseIs(page, 'and it follows a plan again', 'executing');
  await bench.stop('supervisor', 'SIGKILL');
  await tells(page, 'killed while it follows a plan, it is missed again', 'The supervisor does not answer');
  bench.start('supervisor');
  await tellsNothing(page, 'the next one answers');
  await phaseIs(page, 'and goes on with that plan', 'executing', 'done');
  await phaseIs(page, 'to the goal', 'done');
  check((await replans(page)).length === 2, 'it is the same one to its end');
  check(/^\d+ entries/.test(execFileSync(given.server, ['hmi', '--verify-audit', bench.trail], { encoding: 'utf8' })), 'the chain of the audit trail holds');
}

endInTime();

const browser = await launchBrowser(given);
let cell;
let opened;

async function opens(url, token) {
  opened = await openPage(browser.context, url);
  await opened.page.evaluate(() => (globalThis.sameLoad = true));
  await claims(opened.page, await token());
  return opened.page;
}

async function endsWell() {
  const unexpected = opened.problems.filter((problem) => !/status of (401|403|409|503)/.test(problem));
  check(unexpected.length === 0, `no errors, no foreign requests, no policy violations ${unexpected.join('; ')}`);
  await opened.page.close();
  await cell.end();
}

try {
  await browser.context.addInitScript({ path: axeFile(given.modules) });
  cell = await startMixer(given.server, { 'alarms.toml': ALARMS, 'main.st': HEAVY }, KEEPS_RECORDS);
  let page = await opens(cell.url, cell.setupToken);
  await actsBefore(page, cell);
  await theServerIsKilled(page, cell);
  await imagesAreNotSent(page, cell);
  await imagesAreLost(page, cell);
  await theRuntimeIsKilled(page, cell);
  await theLinkIsKilled(page, cell);
  await endsWell();
  cell = await startBench(given.server, given.cell);
  page = await opens(cell.url, cell.setupToken);
  await theSupervisorIsKilled(page, cell);
  await endsWell();
} catch (error) {
  if (opened) await failurePicture(given, 'kill', opened.page);
  if (cell) console.error(cell.logs());
  throw error;
} finally {
  await browser.close();
  await cell?.end();
}
