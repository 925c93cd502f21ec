// How often a second the page paints a screen of 500 symbols whose values all change ten times a second.

import { eventually } from '../../browser/support.mjs';
import { percentile } from './pixels.mjs';

export const SYMBOLS = 500;
const COLUMNS = 25;
const [WIDE, HIGH] = [48, 40];

// Tanks, pumps and numbers in turn, each with a tag of its own.
function symbol(index) {
  const tag = `Counting.v${index}`;
  const place = `translate(${(index % COLUMNS) * WIDE} ${Math.floor(index / COLUMNS) * HIGH})`;
  const shapes = [
    `<rect width="40" height="30" fill="var(--equipment)" stroke="var(--line)"/><rect width="40" height="30" fill="var(--liquid)" data-fill="${tag}" data-to="5000"/>`,
    `<g data-on="${tag}"><circle cx="15" cy="15" r="15" fill="var(--equipment)" stroke="var(--line-strong)"/><path d="M15 0L30 15L15 30" fill="none" stroke="var(--line-strong)"/></g>`,
    '',
  ][index % 3];
  return `<g transform="${place}">${shapes}<text y="38" font-size="9" data-text="${tag}">-</text></g>`;
}

export function screenText() {
  const parts = Array.from({ length: SYMBOLS }, (_, index) => symbol(index));
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${COLUMNS * WIDE} ${(SYMBOLS / COLUMNS) * HIGH}">${parts.join('\n')}</svg>`;
}

// Inside the page: the times of all frames for so long, and how many of them have shown another value of the first symbol; longer
// on a machine that is so busy that there was none.
function watchFrames(wanted) {
  const PATIENCE_S = 600;
  const value = document.querySelector('[data-testid=screen-drawing] [data-text]');
  return new Promise((resolve) => {
    const stamps = [];
    let shown = value.textContent;
    let updates = 0;
    const look = (now) => {
      stamps.push(now);
      if (value.textContent !== shown) {
        shown = value.textContent;
        updates += 1;
      }
      const seconds = (now - stamps[0]) / 1_000;
      if (seconds > (updates > 0 ? wanted : PATIENCE_S)) resolve({ stamps, updates, seconds });
      else requestAnimationFrame(look);
    };
    requestAnimationFrame(look);
  });
}

// Processor time of the page's main thread so far, ms: script, style and layout. What is painted is not in it.
async function workedMs(devtools) {
  const { metrics } = await devtools.send('Performance.getMetrics');
  const seconds = (name) => metrics.find((metric) => metric.name === name).value;
  return 1_000 * (seconds('ScriptDuration') + seconds('RecalcStyleDuration') + seconds('LayoutDuration'));
}

// The page of a cell that has the screen: frames a second, the time between two frames that one of a hundred exceeds, and what an
// update of all symbols costs the page before it is painted.
export async function screenFrames(context, url, seconds) {
  const page = await context.newPage();
  const devtools = await context.newCDPSession(page);
  await page.goto(url);
  await eventually('all symbols have values', () => page.evaluate((count) => {
    const texts = [...document.querySelectorAll('[data-testid=screen-drawing] [data-text]')];
    return texts.length === count && texts.every((one) => /\d/.test(one.textContent));
  }, SYMBOLS));
  await page.evaluate(watchFrames, 1); // the first ones warm the page
  // Of the thread: what else the machine does is not in it.
  await devtools.send('Performance.enable', { timeDomain: 'threadTicks' });
  const before = await workedMs(devtools);
  const { stamps, updates, seconds: watched } = await page.evaluate(watchFrames, seconds);
  const worked = (await workedMs(devtools)) - before;
  await page.close();
  if (updates === 0) throw new Error('the values of the screen do not change');
  const gaps = stamps.slice(1).map((time, at) => time - stamps[at]);
  return { fps: gaps.length / watched, p99_ms: percentile(gaps, 0.99), update_ms: worked / updates, updates_per_s: updates / watched };
}
