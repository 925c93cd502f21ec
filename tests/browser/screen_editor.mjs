// The editor of screens, as tests use it.

import { check, waitFor } from './support.mjs';

// Once it is open: before, nobody can type into it, but a test could, and what it typed would be lost.
export const editor = (page) => page.locator('[data-testid=screen-editor]:not([inert])');
export const field = (page, label) => page.getByTestId('properties').getByLabel(label, { exact: true });
export const item = (page, key) => page.locator(`[data-testid=canvas] [data-item=${key}]`);
export const adds = (page, kind) => page.locator(`[data-symbol-kind=${kind}]`).click();

export const says = (page, words) =>
  waitFor(page, `the editor says: ${words}`, (wanted) => document.querySelector('[data-testid=editor-told]')?.innerText.includes(wanted), words);

// Into the properties of what is chosen.
export async function places(page, values) {
  for (const [label, value] of Object.entries(values)) {
    await field(page, label).fill(String(value));
    await field(page, label).press('Tab');
  }
}

// A finger needs 40 px for whatever is pressed or typed into; of a box that is ticked its words count, too.
export async function fitsFingers(page, what, inside) {
  const small = await page.locator(inside).evaluateAll((places) =>
    places.flatMap((place) => [...place.querySelectorAll('button, select, textarea, a[href], input:not(.visually-hidden)')]).flatMap((one) => {
      const { width, height } = (/checkbox|radio/.test(one.type) ? (one.closest('label') ?? one) : one).getBoundingClientRect();
      return one.checkVisibility() && (width < 39.5 || height < 39.5) ? [`${one.ariaLabel || one.innerText || one.type} ${Math.round(width)} x ${Math.round(height)}`] : [];
    }),
  );
  check(small.length === 0, `${what}: a finger finds everything (${small.join(', ')})`);
}
