// The program as a person reads it while it runs: a page over a cell of real processes whose program is written in ST, as a
// chart, as ladder and as function blocks.

import { leadOverPage } from './page_run.mjs';
import { isAccessible } from './people.mjs';
import { startProgramCell } from './program_cell.mjs';
import { check, drawn, options, pictures, waitFor } from './support.mjs';

const given = options();

const shot = pictures(given, 'program-', { fullPage: true });
const openSheet = (page, name) => page.locator(`[data-sheet="${name}"]`).click();

async function opensByKeyboard(page) {
  const fetched = () => page.evaluate(() => performance.getEntriesByType('resource').some((one) => /ProgramPanel|api\/program/.test(one.name)));
  await page.locator('#program-more').waitFor();
  check(!(await fetched()), 'the panel is not fetched at the start');
  await page.locator('#program-more').focus();
  await page.keyboard.press('Enter');
  await waitFor(page, 'it opens and has the focus', () => document.activeElement?.id === 'program-details');
  await waitFor(page, 'with the sheets of the program', () => document.querySelectorAll('[data-testid=sheets] li').length === 7);
}

async function showsPowerFlow(page, cell) {
  await openSheet(page, 'Ladder');
  await waitFor(page, 'no power flows while nobody has started', () => document.querySelector('[data-network="1"]')?.dataset.power === 'off');
  check((await page.locator('[data-contact=Stop]').first().getAttribute('data-closed')) === 'true', 'a negated contact is closed');
  await shot(page, 'ladder-off');
  cell.force('Start', 'TRUE');
  await waitFor(page, 'power flows to the coil', () =>
    document.querySelector('[data-network="1"]')?.dataset.power === 'on' && document.querySelector('[data-coil=Running]')?.dataset.on === 'true');
  await waitFor(page, 'an edge is left open while its variable is TRUE', () => document.querySelector('[data-network="4"]')?.dataset.power === 'open');
  cell.force('Start', 'FALSE');
  await waitFor(page, 'it holds itself', () =>
    document.querySelector('[data-contact=Start]')?.dataset.closed === 'false' && document.querySelector('[data-network="1"]')?.dataset.power === 'on');
  await waitFor(page, 'an edge is known to be away', () => document.querySelector('[data-network="4"]')?.dataset.power === 'off');
  await waitFor(page, 'the block has its outputs beside it', () =>
    document.querySelector('[data-box=patience] [data-output=Q]')?.textContent === 'TRUE' && document.querySelector('[data-coil=Late]')?.dataset.on === 'true');
  await shot(page, 'ladder-on');
}

async function showsWires(page) {
  await openSheet(page, 'Blend');
  await waitFor(page, 'wires have values', () => document.querySelector('[data-value=High]')?.textContent === 'TRUE');
  // The level grows with every scan: a sum of another scan would show.
  const seen = await page.evaluate(async () => {
    const pairs = [];
    for (let i = 0; i < 25; ++i) {
      const level = Number(document.querySelector('[data-wire="0"]').textContent);
      const sum = Number(document.querySelector('[data-value=Sum]').textContent);
      pairs.push([level, sum]);
      await new Promise((resolve) => setTimeout(resolve, 70));
    }
    return pairs;
  });
  check(seen.every(([level, sum]) => sum === level + 5), `all values are of one scan: ${JSON.stringify(seen.slice(0, 4))}`);
  check(new Set(seen.map(([level]) => level)).size > 3, 'while they change');
  await shot(page, 'blocks');
}

async function showsText(page) {
  await openSheet(page, 'Mixer');
  await waitFor(page, 'a condition has its value', () => document.querySelector('[data-tested=TRUE]') !== null);
  await waitFor(page, 'lines have theirs, also of an element that a variable chooses', () =>
    document.querySelector('[data-value="full"]')?.textContent.includes('TRUE') && document.querySelector('[data-value="history[2]"]')?.textContent.includes('20'));
  await page.getByTestId('instance').selectOption('Second');
  await waitFor(page, 'another instance has its own', () => document.querySelector('[data-value="picked"]')?.textContent.includes('20'));
  await openSheet(page, 'Sequence');
  await waitFor(page, 'the active step is marked, and the action that it drives', () =>
    document.querySelector('[data-testid=sheet] [data-step=Pumping]')?.dataset.active === 'true' && document.querySelector('h4[data-active=true]') !== null);
  await waitFor(page, 'the transition behind it waits', () => document.querySelector('[data-testid=sheet] [data-transition=ends]')?.dataset.enabled === 'true');
  await shot(page, 'chart');
}

async function jumpsFromATag(page) {
  await page.locator('#tag-search').fill('Level');
  await page.getByRole('button', { name: 'Uses of Level' }).click();
  await waitFor(page, 'a tag leads to its uses', () => document.querySelector('[data-testid=uses]')?.dataset.target === 'Level');
  const accesses = await page.locator('[data-testid=uses] [data-use]').evaluateAll((list) => list.map((one) => `${one.dataset.access} ${one.dataset.use}`));
  check(accesses[0] === 'write Sequence (Chart), action Fill, line 1', `who writes it comes first: ${accesses[0]}`);
  for (const wanted of ['read Mixer (Main), line', 'read Mixer (Second), line', 'read Blend (Nets), drawn connection', 'read Sequence (Chart), transition ends'])
    check(accesses.some((one) => one.startsWith(wanted)), `found: ${wanted}`);
  await page.locator('[data-use="Sequence (Chart), action Fill, line 1"]').first().press('Enter');
  await waitFor(page, 'a use is jumped to and has the focus', () =>
    document.activeElement?.closest('[data-block]')?.textContent.includes('Action Fill') && document.activeElement.textContent.includes('Level := Level + 1'));
  await shot(page, 'uses');
}

async function searches(page) {
  await page.locator('#program-details').focus();
  await page.keyboard.press('/');
  await page.keyboard.type('noise');
  await waitFor(page, 'a comment is found', () => document.querySelector('[data-testid=hits] code')?.textContent.includes('without its noise'));
  await page.keyboard.press('Enter');
  await waitFor(page, 'and jumped to', () => document.activeElement?.textContent.includes('without its noise'));
  await page.keyboard.press('/');
  await page.keyboard.type('patience');
  await waitFor(page, 'names are found', () => document.querySelector('[data-testid=hits] [data-kind=variable]') !== null);
  await page.keyboard.press('ArrowDown');
  await waitFor(page, 'arrows walk through what was found', () => document.activeElement?.closest('[data-testid=hits]') !== null);
  await page.keyboard.press('Escape');
  await waitFor(page, 'Escape ends the search and not the panel', () =>
    document.querySelector('[data-testid=hits]') === null && document.activeElement?.id === 'program-search');
}

async function fitsEveryWidth(page) {
  for (const [sheet, scheme] of [['Ladder', 'light'], ['Mixer', 'dark'], ['Blend', 'light']]) {
    await page.emulateMedia({ colorScheme: scheme });
    await openSheet(page, sheet);
    for (const width of [1440, 360]) {
      await page.setViewportSize({ width, height: 900 });
      await drawn(page);
      const wide = await page.evaluate(() => document.documentElement.scrollWidth);
      check(wide <= width, `nothing of ${sheet} sticks out at ${width} px (${wide})`);
      await shot(page, `${sheet.toLowerCase()}-${scheme}-${width}`);
    }
    await page.setViewportSize({ width: 1440, height: 900 });
    await isAccessible(page, `${sheet} in ${scheme}`);
  }
  await page.emulateMedia({ colorScheme: 'light' });
}

async function knowsItsSources(page, cell) {
  const answers = await page.evaluate(async () => {
    const first = await fetch('/api/program', { cache: 'no-store' });
    const etag = first.headers.get('ETag');
    const second = await fetch('/api/program', { cache: 'no-store', headers: { 'If-None-Match': etag } });
    return [first.status, second.status, (await second.text()).length, etag];
  });
  check(answers[0] === 200 && answers[1] === 304 && answers[2] === 0, `what a page has already is not sent again: ${answers}`);
  cell.load('--bare');
  await waitFor(page, 'a program without sources says so', () => document.querySelector('[data-testid=program-absent]')?.textContent.includes('without its sources'));
  await waitFor(page, 'and its chart is there', () => document.querySelector('[data-testid=active-steps]')?.textContent.includes('Waiting'));
  cell.load();
  await waitFor(page, 'the next one has some', () => document.querySelectorAll('[data-testid=sheets] li').length === 7);
  await page.locator('#program-details').focus();
  await page.keyboard.press('Escape');
  await waitFor(page, 'Escape closes the panel and gives the focus back', () =>
    document.querySelector('#program-details') === null && document.activeElement?.id === 'program-more');
}

await leadOverPage(given, {
  name: 'program',
  start: () => startProgramCell(given.server),
  steps: async (page, cell) => {
    await opensByKeyboard(page);
    await showsPowerFlow(page, cell);
    await showsWires(page);
    await showsText(page);
    await jumpsFromATag(page);
    await searches(page);
    await fitsEveryWidth(page);
    await knowsItsSources(page, cell);
  },
});
