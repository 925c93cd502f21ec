// Who may do what, as people meet it: a real demo whose server nobody has claimed yet, its first administrator, an
// operator and an engineer, what they do to the plant, and what the audit trail says of it.

import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';

import { startDemo } from './demo_process.mjs';
import { unreadable } from './narrow.mjs';
import { leadOverPage } from './page_run.mjs';
import { asks, asksApi, dialog, dialogIsGone, fill, isAccessible, logsIn, PASSWORD, setupToken, submits, userLine } from './people.mjs';
import { check, drawn, launchBrowser, openPage, options, pictures, waitFor } from './support.mjs';

const SPEED = 0.4; // so that the run lasts until somebody holds it

const given = options();

const shot = pictures(given, 'access-');

async function looksWithoutLoggingIn(page) {
  await waitFor(page, 'whoever looks sees the plan', () => document.querySelectorAll('[data-action]').length > 5);
  check((await page.getByRole('button', { name: 'Abort' }).count()) === 0, 'but has no buttons that act');
  const status = await page.evaluate(async () => (await fetch('/api/plan/abort', { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: '{}' })).status);
  check(status === 401, `and the server would refuse them (${status})`);
}

async function claims(page, token) {
  await page.getByTestId('log-in').click();
  await fill(page, { 'Set-up token': 'AAAA-AAAA-AAAA-AAAA-AAAA', 'Your name': 'root', Password: PASSWORD });
  await dialog(page).getByRole('button', { name: 'Claim' }).click();
  await waitFor(page, 'a wrong token is refused in words', () =>
    document.querySelector('[data-testid=problem]').innerText.includes('not the set-up token'));
  await shot(page, 'claim');
  await isAccessible(page, 'the claim');
  await fill(page, { 'Set-up token': token });
  await page.keyboard.press('Enter');
  await dialogIsGone(page, 'the right one makes the administrator');
  check((await userLine(page)) === 'root administrator', 'who is logged in at once');
}

async function holdsTheCookieTight(context) {
  const [cookie] = await context.cookies();
  check(/^__Host-stepwright-\d+$/.test(cookie.name), 'the browser keeps the __Host- cookie of a loopback address');
  check(cookie.secure && cookie.httpOnly && cookie.sameSite === 'Strict', 'which is Secure, HttpOnly and SameSite=Strict');
}

async function addsUsers(page) {
  await page.getByRole('button', { name: 'Users' }).click();
  for (const [name, role] of [['olga', 'operator'], ['emil', 'engineer']]) {
    await fill(page, { Name: name, 'First password': PASSWORD });
    await dialog(page).getByLabel('Role', { exact: true }).selectOption(role);
    await dialog(page).getByRole('button', { name: 'Add' }).click();
    await waitFor(page, `${name} is a user`, (user) => document.querySelector(`[data-user=${user}]`) !== null, name);
  }
  await dialog(page).getByLabel('role of root').selectOption('viewer');
  await waitFor(page, 'the last administrator stays one', () =>
    document.querySelector('[data-testid=users-problem]').innerText.includes('only administrator'));
  check((await dialog(page).getByLabel('role of root').inputValue()) === 'administrator', 'and the page does not say otherwise');
  await isAccessible(page, 'the list of users');
  await shot(page, 'users');
  await page.setViewportSize({ width: 360, height: 780 });
  const wide = await page.evaluate(() => document.querySelector('dialog').scrollWidth - document.querySelector('dialog').clientWidth);
  check(wide <= 0, `the users fit in 360 px (${wide})`);
  await shot(page, 'users-360');
  await page.setViewportSize({ width: 1440, height: 900 });
  await page.keyboard.press('Escape');
  await dialogIsGone(page, 'Escape closes it');
}

async function forces(page) {
  await logsIn(page, 'emil');
  await page.getByLabel('Search tags by name or address').fill('%QX');
  const set = page.locator('[data-panel=tags] tbody tr').filter({ hasText: 'BOOL' }).first().getByRole('button', { name: /^Set / });
  const tag = (await set.getAttribute('aria-label')).replace('Set ', '');
  await set.click();
  await fill(page, { Value: 'MAYBE', Minutes: '5', Reason: 'test of the valve' });
  await dialog(page).getByRole('button', { name: 'Force' }).click();
  await waitFor(page, 'a value that is none is refused', () => document.querySelector('[data-testid=problem]').innerText !== '');
  await isAccessible(page, 'forcing');
  await shot(page, 'force');
  await fill(page, { Value: 'FALSE' });
  await page.keyboard.press('Enter');
  await dialogIsGone(page, `${tag} is forced`);
  await waitFor(page, 'a banner says so to everybody', (name) =>
    document.querySelector('[data-testid=forces]')?.innerText.includes(`${name} = FALSE`), tag);
  const told = execFileSync(given.server, ['forces', '--config', given.cell, '--set', `cell.state_dir="${given.state}"`], { encoding: 'utf8' });
  check(told.includes('1 of 64 places are forced'), `the runtime itself says so: ${told.trim().replaceAll('\n', '; ')}`);
  await waitFor(page, 'and its value is marked', (name) =>
    [...document.querySelectorAll('[data-panel=tags] tbody tr')].every((row) => (row.querySelector('[data-forced]') !== null) === row.querySelector('th').firstChild.textContent.trim().startsWith(name)), tag);
  await shot(page, 'banner');
  await isAccessible(page, 'the page with its banner');
  await page.evaluate(() => scrollTo(0, document.documentElement.scrollHeight));
  await drawn(page);
  const top = await page.getByTestId('forces').evaluate((node) => node.getBoundingClientRect().top);
  check(top >= 0 && top < 60, `it is seen wherever one has scrolled to (${top})`);
  await shot(page, 'banner-below');
  await page.evaluate(() => scrollTo(0, 0));
  await page.getByRole('button', { name: `release ${tag}` }).click();
  await waitFor(page, 'until it is released', () => document.querySelector('[data-testid=forces]') === null);
  return tag;
}

// A letter beside the symbol in the generated picture, and a word in its name: in every language, readable in every theme.
// Once the run is over, which a pump that is forced would not outlive.
async function marksThePicture(page, tag) {
  await logsIn(page, 'emil');
  check((await asks(page, 'POST', '/api/tags/force', { name: tag, value: 'FALSE', reason: 'to look at it' })).status === 200, `${tag} is forced again`);
  const LANGUAGES = { de: 'geforct', fr: 'valeur forcée', es: 'valor forzado', en: 'forced' };
  const look = () =>
    page.evaluate(() => {
      const [sign, ...more] = document.querySelectorAll('[data-panel=synoptic] [data-forced]');
      if (!sign) return null;
      const box = sign.querySelector('rect').getBoundingClientRect();
      const picture = sign.closest('[data-panel]').getBoundingClientRect();
      const inside = box.width > 8 && box.left >= picture.left && box.right <= picture.right && box.top >= picture.top && box.bottom <= picture.bottom;
      const name = sign.closest('[aria-label]').getAttribute('aria-label');
      // Rounds of the colours of the letter and of what it stands on: relative luminance of WCAG.
      const bright = (node, what) => {
        const [r, g, b] = getComputedStyle(node)[what].match(/[\d.]+/g).map(Number).map((c) => (c / 255 <= 0.03928 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4));
        return 0.2126 * r + 0.7152 * g + 0.0722 * b;
      };
      const [high, low] = [bright(sign.querySelector('text'), 'fill'), bright(sign.querySelector('rect'), 'fill')].sort((a, b) => b - a);
      return { letter: sign.textContent.trim(), name, inside, contrast: (high + 0.05) / (low + 0.05), more: more.length };
    });
  for (const [language, word] of Object.entries(LANGUAGES)) {
    await page.evaluate((code) => localStorage.setItem('stepwright.language', code), language);
    await page.reload();
    await waitFor(page, `in ${language} the picture marks it by name`, (end) =>
      document.querySelector('[data-panel=synoptic] [data-forced]')?.closest('[aria-label]').getAttribute('aria-label').endsWith(`, ${end}`), word);
  }
  for (const theme of ['light', 'dark'])
    for (const colours of ['standard', 'distinct'])
      for (const width of [1440, 360]) {
        await page.setViewportSize({ width, height: 900 });
        await page.evaluate(([one, other]) => Object.assign(document.documentElement.dataset, { theme: one, colours: other }), [theme, colours]);
        await drawn(page);
        const seen = await look();
        check(seen.letter === 'F' && seen.more === 0 && seen.inside && seen.contrast >= 4.5,
          `${theme}, ${colours}, ${width} px: a letter that can be read, at one place of the picture (${JSON.stringify(seen)})`);
        await shot(page.locator('[data-panel=synoptic]'), `forced-${theme}-${colours}-${width}`);
      }
  await page.setViewportSize({ width: 1440, height: 900 });
  await page.reload();
  check((await asks(page, 'POST', '/api/tags/unforce', { name: tag, reason: 'looked at' })).status === 200, 'and released');
  await waitFor(page, 'which ends the mark', () => document.querySelector('[data-panel=synoptic] svg') !== null && document.querySelector('[data-panel=synoptic] [data-forced]') === null);
}

// Two masters would fight over the plant: the supervisor's plan comes first.
async function changesNoProgramUnderAPlan(page) {
  check((await asksApi(page, '/api/change/apply', { program: '0'.repeat(64), base: '0'.repeat(64), charts: 'keep', reason: 'while a plan runs' })) === '409 H0093',
    'while the supervisor acts nobody changes its program');
  await page.locator('#change-more').click();
  await waitFor(page, 'and the page says why', () => document.querySelector('[data-testid=engaged]')?.innerText.includes('Hold or abort the run first'));
  await shot(page, 'engaged');
  await page.keyboard.press('Escape');
}

// A run that is held leaves the runtime to whoever changes its program; resumed, it brings its own again.
async function changesTheProgramOfAHeldRun(page) {
  await logsIn(page, 'emil');
  const name = 'idle.st';
  const text = 'PROGRAM Idle VAR turns : DINT; END_VAR turns := turns + 1; END_PROGRAM';
  await page.locator('#change-more').click();
  await page.getByTestId('program-file').setInputFiles([{ name, mimeType: 'text/plain', buffer: Buffer.from(text) }]);
  await waitFor(page, 'a program is compared with the one that the run rests with', () => (document.querySelector('[data-testid=comparison]')?.dataset.program ?? '') !== '');
  await page.getByRole('radio', { name: /Restart the charts/ }).check();
  await page.locator('[data-testid=change-form]').getByLabel('Reason').fill('maintenance');
  await page.keyboard.press('Enter');
  await waitFor(page, 'it takes over', () => document.querySelector('[data-testid=outcome]')?.dataset.outcome === 'kept');
  await waitFor(page, 'and the run stays held', () => document.querySelector('[data-testid=phase]').innerText === 'held');
  await page.locator('#change-details').focus();
  await page.keyboard.press('Escape');
  await logsIn(page, 'olga');
}

async function holds(page) {
  await logsIn(page, 'olga');
  await page.getByRole('button', { name: 'Hold' }).click();
  await fill(page, { 'Reason (may be empty)': 'somebody is at the pump' });
  await isAccessible(page, 'holding');
  await shot(page, 'hold');
  await submits(page, 'Hold the run', 'the supervisor has accepted the hold');
  await waitFor(page, 'and brings the plant to rest', () => document.querySelector('[data-testid=phase]').innerText === 'held');
  await shot(page, 'held');
  check((await asksApi(page, '/api/plan/hold', {})) === '409 X0008', 'what is held already cannot be held: the supervisor says why');
  check((await asksApi(page, '/api/plan/goal', { goal: '(= (no-such a1) 4)' })).startsWith('400 P'), 'a goal of something that is not there is refused with its place');
  await changesTheProgramOfAHeldRun(page);
  await page.getByRole('button', { name: 'Resume' }).click();
  await submits(page, 'Resume the run', 'the supervisor has accepted to go on');
  await waitFor(page, 'and follows a plan again', () => document.querySelector('[data-testid=phase]').innerText === 'executing');
}

async function aborts(page) {
  check((await page.getByRole('button', { name: 'Audit' }).count()) === 0, 'an operator does not see the audit trail');
  await page.getByRole('button', { name: 'Abort' }).click();
  await fill(page, { 'Reason (may be empty)': 'smoke in the hall' });
  await shot(page, 'abort');
  await isAccessible(page, 'aborting');
  await submits(page, 'Abort the run', 'the supervisor has the request');
  await waitFor(page, 'and leaves the plant in its safe state', () =>
    document.querySelector('[data-testid=phase]').innerText === 'safe');
}

// Names as long as they may be: the columns of the trail keep their room, and nothing is cut off.
const LONG_USER = 'maximiliane_von_und_zu_hohenberg';
const LONG_TAG = `Main.${'a_rather_long_name_of_one_part_'.repeat(8)}end`;

async function actsUnderALongName(page) {
  await logsIn(page, 'root');
  check((await asks(page, 'POST', '/api/users', { name: LONG_USER, role: 'engineer', password: PASSWORD })).status === 200, 'a long name is one');
  await logsIn(page, LONG_USER);
  const refused = await asksApi(page, '/api/tags/force', { name: LONG_TAG, value: 'TRUE', reason: 'x'.repeat(200) });
  check(refused.startsWith('400') || refused.startsWith('404'), `a variable that is none is not forced (${refused})`);
}

async function keepsItsColumns(page, width) {
  await page.setViewportSize({ width, height: 780 });
  await drawn(page);
  const seen = await page.evaluate(() => {
    const box = document.querySelector('dialog');
    const cells = [...document.querySelectorAll('dialog td')];
    return {
      heads: [...document.querySelectorAll('dialog thead th')].map((node) => Math.round(node.getBoundingClientRect().width)),
      cut: cells.filter((node) => node.scrollWidth > node.clientWidth + 1).map((node) => node.innerText.slice(0, 40)),
      wide: [document.documentElement.scrollWidth, box.scrollWidth - box.clientWidth],
    };
  });
  check(seen.heads.length === 8 && Math.min(...seen.heads) >= 50, `at ${width} px every column of the trail has room (${seen.heads.join(' ')})`);
  check(seen.cut.length === 0, `and no text reaches into the next ${seen.cut.join(' | ')}`);
  check(seen.wide[0] <= width && seen.wide[1] <= 0, `nor does the table out of its dialog (${seen.wide.join(' ')})`);
  const bad = await page.evaluate(unreadable);
  check(bad.length === 0, `at ${width} px all of it can be read ${bad.join('; ')}`);
}

async function readsTheTrail(page, tag) {
  await actsUnderALongName(page);
  await logsIn(page, 'root');
  await page.getByRole('button', { name: 'Audit' }).click();
  await waitFor(page, 'the chain holds', () => document.querySelector('[data-testid=audit-state]')?.innerText.includes('the chain holds'));
  const rows = await page.locator('[data-action]').filter({ has: page.locator('td') }).allInnerTexts();
  const has = (...words) => rows.some((row) => words.every((word) => row.includes(word)));
  check(has('olga', 'plan.abort', 'smoke in the hall', 'done'), 'who aborted, and why');
  check(has('olga', 'plan.hold', 'somebody is at the pump', 'done'), 'who held the run, and why');
  check(has('olga', 'plan.hold', 'refused: X0008'), 'what the supervisor refused, with its reason');
  check(has('olga', 'plan.resume', 'done'), 'who let it go on');
  check(has('emil', 'tag.force', tag, 'FALSE', 'test of the valve', 'done'), 'who forced what to which value, and why');
  check(has('emil', 'tag.force', 'MAYBE', 'refused'), 'what was refused');
  check(has('root', 'user.add', 'olga', 'operator'), 'who made whom an operator');
  await isAccessible(page, 'the audit trail');
  await shot(page, 'audit');
  check(has(LONG_USER, LONG_TAG, 'refused'), 'who tried to force what is not there');
  for (const width of [360, 1440]) {
    await keepsItsColumns(page, width);
    await shot(page, `audit-${width}`);
  }
  await page.setViewportSize({ width: 1440, height: 900 });
  await page.keyboard.press('Escape');
}

function trailIsWhole() {
  const file = join(given.state, 'access', 'audit.jsonl');
  const told = execFileSync(given.server, ['hmi', '--verify-audit', file], { encoding: 'utf8' });
  check(/^\d+ entries, head [0-9a-f]{64}$/.test(told.trim()), `the command says the same: ${told.trim()}`);
  check(!readFileSync(file, 'utf8').includes(PASSWORD), 'no password stands in it');
}

// The page goes back to looking when its session ends somewhere else.
async function losesItsSession(page, other) {
  await logsIn(other, 'olga');
  await page.getByRole('button', { name: 'Users' }).click();
  await page.getByRole('button', { name: 'end the session of olga' }).first().click();
  await waitFor(other, 'a revoked session is over at once', () => document.querySelector('[data-testid=log-in]') !== null);
  await waitFor(other, 'which its page says', () => document.querySelector('[data-testid=banner]')?.innerText.startsWith('Your session has ended.'));
  await waitFor(other, 'and only looks from then on', () =>
    document.querySelector('[data-testid=link]').innerText === 'live' && document.querySelector('[aria-label="act on the plan"]') === null);
}

await leadOverPage(given, {
  name: 'access',
  expected: [400, 401, 403, 404, 409],
  start: () => startDemo(given.server, SPEED),
  steps: async (page, demo) => {
    given.state = demo.stateDir;
    await looksWithoutLoggingIn(page);
    await claims(page, await setupToken(demo));
    await holdsTheCookieTight(page.context());
    await addsUsers(page);
    const tag = await forces(page);
    await changesNoProgramUnderAPlan(page);
    await holds(page);
    await aborts(page);
    await marksThePicture(page, tag);
    await readsTheTrail(page, tag);
    trailIsWhole();
    const second = await launchBrowser(given);
    const other = await openPage(second.context, demo.url);
    await losesItsSession(page, other.page);
    await second.close();
    check(existsSync(join(given.state, 'access', 'users.json')), 'users are kept with the cell');
  },
});
