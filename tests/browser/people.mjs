// What the tests of acting on a page share: the page's dialogs, claiming the administrator, and axe-core.

import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

import { check, until, waitFor } from './support.mjs';

export const PASSWORD = 'correct horse';

export const dialog = (page) => page.getByTestId('dialog');
export const userLine = (page) => page.getByTestId('user').innerText();

export async function fill(page, values) {
  for (const [label, value] of Object.entries(values)) await dialog(page).getByLabel(label, { exact: true }).fill(value);
}

export async function dialogIsGone(page, what) {
  await waitFor(page, what, () => document.querySelector('[data-testid=dialog]') === null);
}

// No serious violation where axe-core looks. Its text goes in as a script of the test, not of the page.
export async function isAccessible(page, what) {
  const { violations } = await page.evaluate(async () => globalThis.axe.run(document, { resultTypes: ['violations'] }));
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

// Asks the API as the person who has logged in on this page; the status and the first problem's code.
export function asksApi(page, path, body) {
  return page.evaluate(async ([where, what]) => {
    const { csrf } = await (await fetch('/api/session')).json();
    const headers = { 'Content-Type': 'application/json', 'X-CSRF-Token': csrf };
    const answer = await fetch(where, { method: 'POST', headers, body: JSON.stringify(what) });
    const { problems } = await answer.json();
    return `${answer.status} ${problems?.[0]?.code ?? ''}`.trim();
  }, [path, body]);
}
