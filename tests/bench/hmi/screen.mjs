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

// The page of a cell that has the screen: frames a second, and the time between two frames that one of a hundred exceeds.
export async function screenFrames(context, url, seconds) {
  const page = await context.newPage();
  await page.goto(url);
  await eventually('all symbols have values', () => page.evaluate((count) => {
    const texts = [...document.querySelectorAll('[data-testid=screen-drawing] [data-text]')];
    return texts.length === count && texts.every((one) => /\d/.test(one.textContent));
  }, SYMBOLS));
  const times = await page.evaluate((wanted) => new Promise((resolve) => {
    const stamps = [];
    const look = (now) => {
      stamps.push(now);
      if (now - stamps[0] > 1_000 * wanted) resolve(stamps);
      else requestAnimationFrame(look);
    };
    requestAnimationFrame(look);
  }), seconds);
  await page.close();
  const gaps = times.slice(1).map((time, at) => time - times[at]);
  return { fps: (1_000 * gaps.length) / (times.at(-1) - times[0]), p99_ms: percentile(gaps, 0.99) };
}
