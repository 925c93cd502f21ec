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

// The name of the screen that a file becomes: letters of other alphabets as those of ASCII that people write for them.
const SPELT: Record<string, string> = { ä: 'ae', ö: 'oe', ü: 'ue', Ä: 'Ae', Ö: 'Oe', Ü: 'Ue', ß: 'ss', æ: 'ae', Æ: 'Ae', ø: 'o', Ø: 'O', œ: 'oe', Œ: 'Oe', ł: 'l', Ł: 'L' };
export function nameOfFile(file: string): string {
  const spelt = file.normalize('NFC').replace(/(\.svg)+$/i, '').replace(/[^\x20-\x7e]/g, (sign) => SPELT[sign] ?? sign.normalize('NFD').replace(/[\u0300-\u036f]/g, ''));
  const plain = spelt.replace(/[^A-Za-z0-9 ._-]+/g, ' ').replace(/ +/g, ' ').slice(0, 60);
  return plain.replace(/^[^A-Za-z0-9]+|[^A-Za-z0-9]+$/g, '') || 'Import';
}

export const LIST = '/api/screens';
export const CHECK = '/api/screen-check';
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
