// A screen with a trend, and the monitors of its program, at 360 px in every language: no legend, no name and no formula is cut.

import { cellWithFiles } from './cell_folder.mjs';
import { unreadable } from './narrow.mjs';
import { leadOverPage } from './page_run.mjs';
import { isAccessible } from './people.mjs';
import { LEVEL_ALARM, PROGRAM } from './recipe_cell.mjs';
import { check, drawn, options, pictures, waitFor } from './support.mjs';

const WIDTH = 360;
const TAGS = '[tags."Main.level"]\nunit = "%"\ndescription = "level of the mixer in the hall behind the office"\n[tags."Main.total"]\ndescription = "all that has been mixed since this morning"\n';
const MONITORS = '[[monitors]]\nname = "stirs_only_with_something_in_it"\nformula = "never dry"\nlet = { dry = "Main.stir AND Main.level < 5.0" }\n';
const SCREEN = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 400 500">
<g data-part="trend" data-tags="Main.level; Main.total; Main.batches"><rect x="10" y="10" width="380" height="220" fill="none"/></g>
<g data-part="tags" data-tags="Main.level; Main.total; Main.batches"><rect x="10" y="240" width="380" height="120" fill="none"/></g>
<g data-part="alarms"><rect x="10" y="370" width="380" height="120" fill="none"/></g></svg>`;

const given = options();
const shot = pictures(given, 'narrow-screen-', { fullPage: true });

async function startCell() {
  const cell = await cellWithFiles(given.server, 'narrow-screen', {
    domain: 69,
    files: { 'main.st': PROGRAM, 'alarms.toml': LEVEL_ALARM, 'screens/Mixer.svg': SCREEN },
    more: `screens_dir = "screens"\n[history]\nfolder = "history"\nalarms = "alarms.toml"\n${TAGS}${MONITORS}`,
  });
  return cell.runs(() => {
    cell.run('compile', cell.file('main.st'), '--config', cell.config, '-o', cell.file('main.swb'));
    cell.download('main.swb');
  });
}

await leadOverPage(given, {
  name: 'narrow-screen',
  start: startCell,
  steps: async (page) => {
    await page.setViewportSize({ width: WIDTH, height: 740 });
    await waitFor(page, 'the screen and the monitors are there', () => document.querySelectorAll('[data-testid=screen] figcaption span').length === 3 && document.querySelector('[data-monitor]') !== null);
    for (const language of ['en', 'de', 'fr', 'es']) {
      await page.getByTestId('preferences').click();
      await page.locator('[data-testid=preferences] + .menu select').first().selectOption(language);
      await waitFor(page, 'the page is in that language', (code) => document.documentElement.lang === code, language);
      await page.keyboard.press('Escape');
      await drawn(page);
      await shot(page, language);
      const wide = await page.evaluate(() => document.documentElement.scrollWidth);
      check(wide <= WIDTH, `nothing sticks out of the page in ${language} (${wide})`);
      const cut = await page.evaluate(unreadable);
      check(cut.length === 0, `all can be read in ${language} ${cut.join('; ')}`);
      const beyond = await page.evaluate(() => {
        const room = document.querySelector('[data-panel=tags] .values');
        return room ? room.scrollWidth - room.clientWidth : -1;
      });
      check(beyond === 0, `nor is a value of the table of tags in ${language} (${beyond} px)`);
      await isAccessible(page, `the page in ${language}`);
    }
  },
});
