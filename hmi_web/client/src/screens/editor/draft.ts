// What somebody has drawn and not saved yet, in this browser: a session that ends, or a tab that is closed, loses nothing. It is for
// who has drawn it, and each tab keeps its own.

import { recall, remember } from '../../lib/remembered';

export interface Draft {
  name: string; // empty: of a new screen
  version: number; // that was changed
  svg: string;
}
interface Kept extends Draft {
  user: string;
  tab: string;
}

const KEY = 'stepwright.screen-drafts';
const TAB = 'stepwright.tab';
const MOST = 8; // the newest; a browser has room for some megabytes

// A tab is the same one for as long as it is open.
function thisTab(): string {
  try {
    const known = sessionStorage.getItem(TAB);
    if (known) return known;
    const fresh = String(Math.random()).slice(2);
    sessionStorage.setItem(TAB, fresh);
    return fresh;
  } catch {
    return '';
  }
}

const isKept = (one: Partial<Kept> | null): one is Kept =>
  typeof one?.user === 'string' && typeof one.tab === 'string' && typeof one.name === 'string' && typeof one.svg === 'string' && typeof one.version === 'number';

// The oldest first.
function all(): Kept[] {
  try {
    const found: unknown = JSON.parse(recall(KEY) ?? '[]');
    return Array.isArray(found) ? found.filter(isKept) : [];
  } catch {
    return [];
  }
}

const others = (user: string, name: string) => {
  const tab = thisTab();
  return all().filter((one) => one.user !== user || one.name !== name || one.tab !== tab);
};

export function keepDraft(user: string, draft: Draft): void {
  remember(KEY, JSON.stringify([...others(user, draft.name), { ...draft, user, tab: thisTab() }].slice(-MOST)));
}

export function forgetDraft(user: string, name: string): void {
  remember(KEY, JSON.stringify(others(user, name)));
}

// That of the screen, if there is one: of this tab, or the newest of another one.
export function draftOf(user: string, name: string): Draft | null {
  const tab = thisTab();
  const mine = all().filter((one) => one.user === user && one.name === name);
  const found = mine.find((one) => one.tab === tab) ?? mine.at(-1);
  return found ? { name, version: found.version, svg: found.svg } : null;
}
