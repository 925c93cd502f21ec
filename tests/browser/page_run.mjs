// The frame of a test that leads over the page of one cell.

import { axeFile } from './people.mjs';
import { check, endInTime, failurePicture, launchBrowser, openPage } from './support.mjs';

// `start` brings up a cell with url, logs and end; `steps` are taken on its page, in which `watch` has run before anything else.
// `look`: how the browser is to draw.
// The page may tell of answers with the statuses `expected`, which the server gives on purpose, and that somebody is not there yet; of
// nothing else.
export async function leadOverPage(given, { name, start, steps, watch, expected = [], look = {} }) {
  endInTime();
  const browser = await launchBrowser(given, look);
  let cell;
  let opened;
  try {
    await browser.context.addInitScript({ path: axeFile(given.modules) });
    if (watch) await browser.context.addInitScript(watch);
    cell = await start();
    opened = await openPage(browser.context, cell.url);
    const { page, problems } = opened;
    await steps(page, cell);
    const unexpected = problems.filter((problem) => ![...expected, 503].some((status) => problem.includes(`status of ${status}`)));
    check(unexpected.length === 0, `no errors, no foreign requests, no policy violations ${unexpected.join('; ')}`);
  } catch (error) {
    if (opened) await failurePicture(given, name, opened.page);
    if (opened) console.error(opened.problems.join('\n'));
    if (cell) console.error(cell.logs());
    throw error;
  } finally {
    await browser.close();
    await cell?.end();
    cell?.forget?.();
  }
}
