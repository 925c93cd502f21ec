// Screens as the server's API tells of them (hmi_web/doc/screens.md).

import type { Role } from '../access/session.svelte';

export interface ScreenVersion {
  version: number;
  based_on: number;
  saved_by: string;
  saved_ms: number; // 0: it was not saved on a page
  comment: string;
  least: Role;
  symbol: boolean;
  aside: boolean; // somebody else had saved before
  removed: boolean;
}

export interface ScreenEntry extends ScreenVersion {
  name: string;
}

export interface ScreenList {
  screens: ScreenEntry[];
  start: string; // of who asks
  starts?: Record<string, string>; // for engineers: of each role, and of "everybody" who has none of his own
}

export interface Screen {
  name: string;
  version: number;
  svg: string;
}

// Of ASCII letters, digits, blanks and . _ -, the first and the last a letter or a digit, as the server has it: a name is a folder
// and a part of an address, too. NAME.svg is a file.
export const isScreenName = (name: string): boolean => /^[A-Za-z0-9]([A-Za-z0-9 ._-]{0,62}[A-Za-z0-9])?$/.test(name) && !/\.svg$/i.test(name);

export const LIST = '/api/screens';
export const pathOf = (name: string) => `${LIST}/${encodeURIComponent(name)}`;

// Those that are looked at: faces are repeated in others, and removed ones are kept for engineers.
export const shownOf = (list: ScreenList | null): ScreenEntry[] => (list?.screens ?? []).filter(({ symbol, removed }) => !symbol && !removed);

// The screen to show: the one that is asked for, else the start, else the first.
export function chosenOf(list: ScreenList | null, asked: string): string {
  const names = shownOf(list).map(({ name }) => name);
  return [asked, list?.start ?? ''].find((name) => names.includes(name)) ?? names[0] ?? '';
}

// The part of the address that says which screen is looked at: "#screen=Mixer".
const KEY = 'screen';
export const askedIn = (hash: string): string => new URLSearchParams(hash.replace(/^#/, '')).get(KEY) ?? '';
export const hashOf = (name: string): string => `#${new URLSearchParams({ [KEY]: name }).toString()}`;
