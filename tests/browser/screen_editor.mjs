// The editor of screens, as tests use it.

import { waitFor } from './support.mjs';

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
