// What the tests of acting on a page share: the page's dialogs, claiming the administrator, and axe-core.

import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

import { check, eventually, until, waitFor } from './support.mjs';

export const PASSWORD = 'correct horse';

export const dialog = (page) => page.getByTestId('dialog');
export const userLine = (page) => page.getByTestId('user').innerText();

export async function fill(page, values) {
  for (const [label, value] of Object.entries(values)) await dialog(page).getByLabel(label, { exact: true }).fill(value);
}

export async function dialogIsGone(page, what) {
  await waitFor(page, what, () => document.querySelector('[data-testid=dialog]') === null);
}

// The dialog's own button, and what becomes of it.
export async function submits(page, action, what) {
  await dialog(page).getByRole('button', { name: action }).click();
  await dialogIsGone(page, what);
}

// No serious violation where axe-core looks: on the whole page, or inside of what a selector names. Its text goes in as a script
// of the test, not of the page. Rules whose violations are never serious (axe-core gives each violation the impact of its rule) are left out.
export async function isAccessible(page, what, inside = 'html') {
  const { violations } = await page.evaluate(async (selector) => {
    const { rules, tagExclude } = globalThis.axe._audit;
    const judged = ({ enabled, impact, tags }) =>
      enabled && !tags.some((tag) => tagExclude.includes(tag)) && impact !== 'minor' && impact !== 'moderate';
    const values = rules.filter(judged).map(({ id }) => id);
    return globalThis.axe.run(document.querySelector(selector), { resultTypes: ['violations'], runOnly: { type: 'rule', values } });
  }, inside);
  const serious = violations.filter(({ impact }) => impact === 'serious' || impact === 'critical');
  const told = serious.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 120)).join(' | ')}`);
  check(serious.length === 0, `${what} has no serious fault of accessibility ${told.join('\n')}`);
}

export function axeFile(modules) {
  return createRequire(join(modules, 'axe-core', 'package.json')).resolve('axe-core/axe.min.js');
}

// The token with which a demo's page can be claimed, as whoever has started the demo reads it.
export async function setupToken(demo) {
  const log = () => readFileSync(join(demo.stateDir, 'hmi.log'), 'utf8');
  await until('the set-up token is on standard error', () => /set-up token [A-Z2-9-]{24}/.test(log()));
  const [, token] = /set-up token ([A-Z2-9-]{24})/.exec(log());
  await until('who has started the demo is told the token', () => demo.output().includes(`set-up token ${token} `));
  return token;
}

// The administrator of a server that nobody has claimed yet.
export async function claims(page, token) {
  await page.getByTestId('log-in').click();
  await fill(page, { 'Set-up token': token, 'Your name': 'root', Password: PASSWORD });
  await page.keyboard.press('Enter');
  await dialogIsGone(page, 'there is an administrator');
}

// What a demo's page is given to have nothing begin before it looks: however late it comes, it sees all of the run.
export const BY_OPERATOR = ['--set', 'executive.start="operator"'];

// The run of such a demo, by its first administrator.
export async function startsTheRun(page, demo) {
  await waitFor(page, 'the plan is ready', () => document.querySelector('[data-testid=phase]')?.innerText === 'ready');
  await claims(page, await setupToken(demo));
  await page.getByRole('button', { name: 'Start', exact: true }).click();
  await submits(page, 'Start the run', 'the run is started');
}

// Somebody else, maybe in place of whoever has logged in.
export async function logsIn(page, name) {
  if ((await page.getByTestId('log-out').count()) > 0) await page.getByTestId('log-out').click();
  // It lies where the other one was: the second click of a double click would not be meant for it.
  await page.keyboard.press('Shift');
  await page.getByTestId('log-in').click();
  await fill(page, { Name: name, Password: PASSWORD });
  await page.keyboard.press('Enter');
  await dialogIsGone(page, `${name} logs in`);
  await waitFor(page, 'and sees the cell', () => document.querySelector('[data-testid=link]').innerText === 'live');
}

// By the administrator.
export async function addsUsers(page) {
  for (const [name, role] of [['olga', 'operator'], ['emil', 'engineer']])
    check((await asks(page, 'POST', '/api/users', { name, role, password: PASSWORD })).status === 200, `${name} is a user`);
}

// Status of an answer and the code of its first problem.
export const codeOf = ({ status, json }) => `${status} ${json?.problems?.[0]?.code ?? ''}`.trim();

// Nothing was done: the server has not heard of who should do it (yet), or too many wait already.
const NOT_YET = ['503 D0001', '503 H0047'];

// Asks the API as the person who has logged in on this page, as soon as somebody is there; status and JSON, null if it is none.
export async function asks(page, method, path, body) {
  let answer;
  await eventually(`somebody is there for ${path}`, async () => {
    answer = await page.evaluate(async ([how, where, what]) => {
      const { csrf } = await (await fetch('/api/session')).json();
      const headers = { 'Content-Type': 'application/json', 'X-CSRF-Token': csrf };
      const response = await fetch(where, { method: how, headers, ...(what === undefined ? {} : { body: JSON.stringify(what) }) });
      return { status: response.status, json: await response.json().catch(() => null) };
    }, [method, path, body]);
    return !NOT_YET.includes(codeOf(answer));
  });
  return answer;
}

// Acts by the API; its status and the first problem's code.
export async function asksApi(page, path, body) {
  return codeOf(await asks(page, 'POST', path, body));
}
