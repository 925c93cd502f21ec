// Goals as an operator puts them together: a real bench whose runs an operator starts; the form, a plan that is only
// looked at, the start with that goal, another goal meanwhile, and another run from where the plant is.

import { startDemo } from './demo_process.mjs';
import { leadOverPage } from './page_run.mjs';
import { asksApi, claims, dialog, dialogIsGone, fill, isAccessible, setupToken, submits } from './people.mjs';
import { check, fitsEveryWidth, options, pictures, until, waitFor } from './support.mjs';

const SPEED = 2; // a run that is not held lasts for half a minute

const given = options();

const shot = pictures(given, 'goal-');
const row = (page, number) => dialog(page).locator(`[data-condition="${number}"]`);
const rows = (page) => dialog(page).locator('[data-condition]').count();
const button = (page, name) => dialog(page).getByRole('button', { name, exact: true });
const preview = (page) => page.getByTestId('goal-preview').innerText();

async function phaseIs(page, phase, what) {
  await waitFor(page, what, (word) => document.querySelector('[data-testid=phase]')?.innerText === word, phase);
}

async function waitsForItsStart(page) {
  await phaseIs(page, 'ready', 'the plan is ready and waits for somebody');
  await waitFor(page, 'it is shown, and nothing of it has begun', () => document.querySelectorAll('[data-action][data-state=pending]').length === 17);
  check((await page.getByTestId('runtime-state').innerText()) === 'empty', 'and the runtime has no program yet');
  check(await page.getByRole('button', { name: 'Hold' }).isDisabled(), 'what does not run is not held');
}

async function opensTheForm(page) {
  await page.getByRole('button', { name: 'New goal' }).click();
  await waitFor(page, "the form has the problem's goal", () => document.querySelectorAll('[data-condition]').length === 5);
  check((await row(page, 1).getByTestId('now').innerText()) === 'true', 'the vehicle is where it should be at the end');
  check((await row(page, 2).getByTestId('now').innerText()) === '2', 'the level is what it is now, beside what it should be');
  check((await row(page, 4).getByLabel('what condition 4 is compared with').inputValue()) === '(demand c1)', 'one quantity is compared with another');
  check((await row(page, 4).innerText()).includes('demand c1 is 7'), 'and what that is now is said');
  check((await row(page, 2).innerText()).includes('0 to 10 tenths'), 'range and unit are those of the binding');
  const places = await row(page, 1).getByLabel('p (place) of condition 1').locator('option').allInnerTexts();
  check(places.join() === 'f1,a1,a2', 'objects are choices by their type');
  await isAccessible(page, 'the form');
  await shot(page, 'form');
}

async function mistakesAreTold(page) {
  await row(page, 2).getByLabel('number of condition 2').fill('11');
  await button(page, 'What if?').click();
  await waitFor(page, 'a number out of range is told at its place', () =>
    document.querySelector('[data-condition="2"] [data-testid=condition-problem]')?.innerText.includes('from 0 to 10'));
  await shot(page, 'field-error');
  await row(page, 2).getByLabel('number of condition 2').fill('3');
  await button(page, 'As PDDL text').click();
  await dialog(page).getByLabel('Goal (PDDL)').fill('(and\n  (is-at v1 f1)\n  (= (level a9) 3))');
  await button(page, 'What if?').click();
  await waitFor(page, 'what the supervisor refuses has line and column', () =>
    /line 3, column \d+: .*a9/.test(document.querySelector('[data-testid=problem]').innerText));
  await dialog(page).getByLabel('Goal (PDDL)').fill('(and\n  (is-at v1 f1)\n  (or (= (level a1) 3) (= (level a2) 3)))');
  await button(page, 'As a form').click();
  await waitFor(page, 'what is more than conditions stays text', () => document.querySelector('[data-testid=problem]').innerText.includes('more than the form'));
  await dialog(page).getByLabel('Goal (PDDL)').fill('(is-at v1 f1)');
  await button(page, 'As a form').click();
  await waitFor(page, 'plain conditions are a form again', () => document.querySelectorAll('[data-condition]').length === 1);
}

async function putsItTogether(page) {
  await button(page, 'Add a quantity').click();
  await dialog(page).getByLabel('what condition 2 is about').selectOption('level');
  await dialog(page).getByLabel('d (distributor) of condition 2').selectOption('a1');
  await dialog(page).getByLabel('number of condition 2').fill('3');
  await button(page, 'Add a fact').click();
  check((await rows(page)) === 3, 'conditions are added');
  await button(page, 'remove condition 3').click();
  check((await preview(page)) === '(and\n  (is-at v1 f1)\n  (= (level a1) 3))', 'and taken away, and the preview is PDDL');
}

async function asksWhatIf(page) {
  await button(page, 'What if?').click();
  await waitFor(page, 'the plan is told', () => document.querySelector('[data-testid=what-if]')?.dataset.state === 'planned');
  const figures = await dialog(page).locator('[data-figure=actions] td').allInnerTexts();
  check(Number(figures[0]) === 4 && figures[1] === '17' && figures[2].startsWith('−13'), `fewer actions than the plan that is ready: ${figures.join(' ')}`);
  const makespan = await dialog(page).locator('[data-figure=makespan] td').allInnerTexts();
  check(makespan[2].startsWith('−'), `and sooner done: ${makespan.join(' ')}`);
  check((await dialog(page).getByLabel('actions of the what-if').locator('li').count()) === 4, 'with its actions and bars');
  await isAccessible(page, 'the what-if');
  check((await page.getByTestId('phase').innerText()) === 'ready', 'and nothing of it has touched the run');
  await fitsEveryWidth(page, [1440, 360], (each, name) => shot(each, `what-if-${name}`));
  await page.setViewportSize({ width: 1440, height: 900 });
}

async function startsWithIt(page) {
  await fill(page, { 'Reason (may be empty)': 'a small order' });
  await button(page, 'Start with this goal').click();
  await dialogIsGone(page, 'the supervisor has accepted the start');
  await phaseIs(page, 'done', 'the goal of the form is reached');
  const levels = await page.locator('[data-testid=final-levels] tbody tr').allInnerTexts();
  check(levels.some((text) => /level a1\s+3\.00\s+(2\.[89]|3\.[01])/.test(text)), `the level is what was asked for: ${levels.join(' | ')}`);
}

async function changesItsMindMeanwhile(page) {
  await page.getByRole('button', { name: 'New goal' }).click();
  await waitFor(page, 'the form has the goal of the run before', () => document.querySelectorAll('[data-condition]').length === 2);
  await dialog(page).getByLabel('number of condition 2').fill('9');
  await button(page, 'Add a quantity').click();
  await dialog(page).getByLabel('what condition 3 is about').selectOption('level');
  await dialog(page).getByLabel('d (distributor) of condition 3').selectOption('a2');
  await dialog(page).getByLabel('number of condition 3').fill('7');
  await button(page, 'Start with this goal').click();
  await dialogIsGone(page, 'another run is started from where the plant is');
  await holdsAtOnce(page);
  await handsOverWhileHeld(page);
  await page.getByRole('button', { name: 'New goal' }).click();
  await waitFor(page, 'another goal can be put together', () => document.querySelectorAll('[data-condition]').length === 3);
  await dialog(page).getByLabel('number of condition 2').fill('6');
  await button(page, 'What if?').click();
  await waitFor(page, 'and looked at', () => document.querySelector('[data-testid=what-if]')?.dataset.state === 'planned');
  check((await dialog(page).locator('[data-figure=actions] td').count()) === 1, 'beside no other one: a run that is held follows no plan');
  await shot(page, 'meanwhile');
  check((await asksApi(page, '/api/plan/resume', {})) === '200', 'somebody else resumes the run');
  await button(page, 'Run this goal').click();
  await dialogIsGone(page, 'which is to be run instead of what runs then');
  await phaseIs(page, 'done', 'which it does to the end');
  const goals = await page.locator('[data-panel=state] li').allInnerTexts();
  check(goals.some((text) => text.includes('(level a1) 6') || text.includes('= (level a1) 6')), `the goal is the last one: ${goals.join(' | ')}`);
}

// As soon as the supervisor takes a hold: it is asked itself, for the page may draw what is over already.
async function holdsAtOnce(page) {
  await until('it runs, and is held at once', async () => (await asksApi(page, '/api/plan/hold', {})) === '200');
  await phaseIs(page, 'held', 'the plant rests');
}

// What is handed over while the run is held runs once somebody resumes it, and the form says so.
async function handsOverWhileHeld(page) {
  await page.getByRole('button', { name: 'New goal' }).click();
  await waitFor(page, 'the form is there', () => document.querySelectorAll('[data-condition]').length === 3);
  check((await dialog(page).innerText()).includes('nothing runs before somebody resumes the run'), 'it says that nothing runs yet');
  check((await button(page, 'Run this goal').count()) === 0, 'and does not offer to run it');
  await dialog(page).getByLabel('number of condition 2').fill('8');
  await isAccessible(page, 'the form of a held run');
  await shot(page, 'held');
  await button(page, 'Take over for when it is resumed').click();
  await dialogIsGone(page, 'the supervisor has taken the goal over');
  await waitFor(page, 'and says that it is the goal of the run', () => /the goal was changed to [^]*\(level a1\) 8/.test(document.querySelector('[data-testid=message]')?.textContent ?? ''));
  check((await page.getByTestId('phase').innerText()) === 'held', 'which is held as before');
}

async function startsAgain(page) {
  await page.getByRole('button', { name: 'Start' }).click();
  await isAccessible(page, 'starting');
  await shot(page, 'start');
  check((await page.locator('[data-action]').count()) > 0, 'the run before had actions');
  await submits(page, 'Start the run', 'the same goal can be started again');
  // The run before was done as well, but not without actions.
  await waitFor(page, 'and is met: there is nothing to do', () =>
    document.querySelector('[data-testid=phase]')?.innerText === 'done' && document.querySelectorAll('[data-action]').length === 0);
  check((await asksApi(page, '/api/plan/hold', {})) === '409 X0008', 'a run that is over is not held');
  check((await asksApi(page, '/api/plan/what-if', { goal: '(= (level a1)', id: '1' })).startsWith('400 P'), 'a goal that is none is refused');
}

await leadOverPage(given, {
  name: 'goal',
  expected: [400, 409],
  start: () => startDemo(given.server, SPEED, 'bench', ['--set', 'executive.start=operator']),
  steps: async (page, demo) => {
    await claims(page, await setupToken(demo));
    await waitsForItsStart(page);
    await shot(page, 'ready');
    await opensTheForm(page);
    await mistakesAreTold(page);
    await putsItTogether(page);
    await asksWhatIf(page);
    await startsWithIt(page);
    await changesItsMindMeanwhile(page);
    await startsAgain(page);
  },
});
