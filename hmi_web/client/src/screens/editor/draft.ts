// What somebody has drawn and not saved yet, in this browser: a session that ends, or a tab that is closed, loses nothing.

import { recall, remember } from '../../lib/remembered';

export interface Draft {
  name: string; // empty: of a new screen
  version: number; // that was changed
  svg: string;
}

const KEY = 'stepwright.screen-draft';

export function keepDraft(draft: Draft | null): void {
  remember(KEY, draft === null ? '' : JSON.stringify(draft));
}

// That of the screen, if there is one.
export function draftOf(name: string): Draft | null {
  try {
    const found = JSON.parse(recall(KEY) ?? '') as Partial<Draft> | null;
    if (found?.name !== name || typeof found.svg !== 'string' || typeof found.version !== 'number') return null;
    return { name, version: found.version, svg: found.svg };
  } catch {
    return null;
  }
}
