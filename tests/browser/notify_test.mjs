// People are told of an alarm that nobody acknowledges, by mail and by a web hook; a server that never answers holds up nothing; a
// button sends a test. An online change that takes away what an alarm watches is told on the page and in the log.

import { readFileSync } from 'node:fs';

import { leadOverPage } from './page_run.mjs';
import { asksApi, claims, isAccessible } from './people.mjs';
import { startMailServer, startSilentServer, startWebHook } from './receivers.mjs';
import { KEEPS_RECORDS, LEVEL_ALARM, PROGRAM, startMixer } from './recipe_cell.mjs';
import { check, options, pictures, until, waitFor } from './support.mjs';

const given = options();
const shot = pictures(given, 'notify-', { fullPage: true });
const mail = await startMailServer();
const hook = await startWebHook();
const silent = await startSilentServer();

const NOTIFIES = `
[[notify]]
name = "dead"
mail = ["nobody@plant.example"]
server = "smtp://127.0.0.1:${silent.port}"
from = "line@plant.example"
tls = false
delay_s = 0

[[notify]]
name = "shift"
mail = ["shift@plant.example", "chief@plant.example"]
server = "smtp://127.0.0.1:${mail.port}"
from = "line@plant.example"
tls = false
delay_s = 1

[[notify]]
name = "chat"
web_hook = "http://127.0.0.1:${hook.port}/hooks/line"
password_file = "hook.secret"
delay_s = 0
`;

// Limits of times are in seconds.
const SOAK_ALARM = `
[[alarm]]
name = "soak.long"
source = "Main.soak"
when = "high"
limit = 60
priority = "high"
text = "It soaks for too long"
`;

// Without what the alarm watches.
const LACKING = PROGRAM.replaceAll('level', 'filled');

async function tellsOfAnAlarm(page, cell) {
  check((await asksApi(page, '/api/tags/write', { name: 'Main.level', value: '60', reason: 'test of notifications' })) === '200', 'the level is raised');
  await until('the shift gets a mail', () => mail.mails.some(({ text }) => text.includes('The mixer is too full')));
  const [told] = mail.mails;
  check(told.from === 'line@plant.example' && told.to.join() === 'shift@plant.example,chief@plant.example', 'from the line to everybody');
  check(/^Subject: recipes-\d+: The mixer is too full \(high\)$/m.test(told.text), `its subject says what stands (${told.text.split('\n').slice(0, 8).join(' | ')})`);
  await until('the chat is told, too', () => hook.posts.length > 0);
  const [post] = hook.posts;
  check(post.method === 'POST' && post.type === 'application/json' && post.secret === 'Bearer s3cret', 'with its secret');
  check(post.body.kind === 'alarms' && post.body.alarms[0].name === 'level.high' && post.body.alarms[0].value === 60, 'and the alarm');
  check((await asksApi(page, '/api/alarms/acknowledge-all', { names: ['level.high'] })) === '200', 'somebody acknowledges it');
}

// People read a time as they write it; programs get seconds.
async function tellsATime(page) {
  check((await asksApi(page, '/api/tags/write', { name: 'Main.soak', value: 'T#90s', reason: 'test of notifications' })) === '200', 'it is to soak for longer');
  const told = () => mail.mails.find(({ text }) => text.includes('It soaks for too long'));
  await until('the shift gets a mail about it', () => told() !== undefined);
  check(/1 min 30 s/.test(told().text), `which says the time as people write it (${told().text.split('\n').slice(-6).join(' | ')})`);
  const posted = () => hook.posts.flatMap(({ body }) => body.alarms ?? []).find(({ name }) => name === 'soak.long');
  await until('the chat is told', () => posted() !== undefined);
  check(posted().value === 90, `in seconds (${JSON.stringify(posted())})`);
  await page.getByRole('button', { name: 'Alarms' }).click();
  await page.getByRole('button', { name: 'Journal' }).click();
  await waitFor(page, 'the journal tells it in its words', () => document.querySelector('[data-testid=journal] tbody')?.innerText.includes('It soaks for too long'));
  await page.getByRole('button', { name: 'Standing' }).click();
  await waitFor(page, 'and the list of alarms has it', () => document.querySelector('[data-alarm="soak.long"]') !== null);
  const row = await page.locator('[data-alarm="soak.long"]').innerText();
  check(/1 min 30 s/.test(row) && !row.includes('90000000000'), `the list of alarms, too (${row.replaceAll('\n', ' ').replaceAll('\t', ' ')})`);
  await page.getByRole('button', { name: 'Alarms' }).click();
  await waitFor(page, 'which closes again', () => document.querySelector('[data-alarm="soak.long"]') === null);
  check((await asksApi(page, '/api/alarms/acknowledge-all', { names: ['soak.long'] })) === '200', 'it is acknowledged');
}

// However quickly one follows the other.
async function tellsWhatWasThere(page, cell) {
  for (const value of ['4', '5', '6'])
    check((await asksApi(page, '/api/tags/write', { name: 'Main.batches', value, reason: 'test of the trail' })) === '200', `${value} is written`);
  const told = readFileSync(cell.trail, 'utf8').trim().split('\n').map((line) => JSON.parse(line)).filter(({ action, target, result }) => action === 'tag.write' && target === 'Main.batches' && result === 'done');
  check(told.map(({ before, after }) => `${before}>${after}`).join(' ') === '3>4 4>5 5>6', `the trail has what each has replaced (${told.map(({ before }) => before).join(' ')})`);
}

async function sendsATest(page) {
  await page.getByRole('button', { name: 'Alarms' }).click();
  await page.getByRole('button', { name: 'Notifications' }).click();
  await waitFor(page, 'all notifications are listed', () => document.querySelectorAll('[data-testid=notifications] tbody tr').length === 3);
  await page.locator('[data-channel=shift]').getByRole('button', { name: 'Test' }).click();
  await until('a test arrives', () => mail.mails.some(({ text }) => /^Subject: recipes-\d+: test of 'shift'$/m.test(text)));
  await waitFor(page, 'and the list says so', () => document.querySelector('[data-channel=shift]').dataset.tests === '1' && document.querySelector('[data-channel=shift]').dataset.failing === 'false');
  await waitFor(page, 'that a server does not answer is told beside it, in words', () => {
    const row = document.querySelector('[data-channel=dead]');
    return row.dataset.failing === 'true' && row.innerText.includes('127.0.0.1');
  });
  await isAccessible(page, 'the list of notifications');
  await shot(page, 'list');
}

async function losesItsVariable(page, cell) {
  await page.getByRole('button', { name: 'Standing' }).click();
  cell.run('compile', cell.file('lacking.st'), '-o', cell.file('lacking.swb'));
  cell.run('download', '--config', cell.config, cell.file('lacking.swb'), '--change');
  await waitFor(page, 'an alarm whose variable has gone is in a state of its own', () => document.querySelector('[data-alarm="level.high"]')?.dataset.state === 'no variable');
  check((await page.getByTestId('no-variable').innerText()) === '1 alarm without its variable', 'and the bar counts it');
  await until('the log says which', () => /the program has no variable 'Main\.level': the alarm 'level\.high' cannot come/.test(cell.logs()));
  check(/'dead' cannot be told of alarms/.test(cell.logs()), 'and which server does not answer');
  await shot(page, 'no-variable');
}

try {
  await leadOverPage(given, {
    name: 'notify',
    start: () => startMixer(given.server, { 'alarms.toml': LEVEL_ALARM + SOAK_ALARM, 'hook.secret': 's3cret\n', 'lacking.st': LACKING }, KEEPS_RECORDS + NOTIFIES),
    steps: async (page, cell) => {
      await claims(page, await cell.setupToken());
      await tellsOfAnAlarm(page, cell);
      await tellsATime(page);
      await tellsWhatWasThere(page, cell);
      await sendsATest(page);
      await losesItsVariable(page, cell);
    },
  });
} finally {
  for (const each of [mail, hook, silent]) each.end();
}
