// Recipes as the server's API tells of them (hmi_web/doc/recipes.md).

import { sentences, type Problem } from '../access/api';
import { isString } from '../lib/string_value';
import { t } from './texts';

export interface RecipeTag {
  name: string;
  type: string;
  unit: string;
  comment: string;
  min?: number; // a BOOL and a text have no range; that of a TIME is in seconds
  max?: number;
  value?: string; // of the running program, at this moment
  problem?: string; // why there is none
}

// What a damaged file leaves has a name and problems only.
export interface RecipeEntry {
  name: string;
  comment?: string;
  saved_by?: string;
  saved_ms?: number;
  problems: string[];
}

export interface Recipe extends RecipeEntry {
  values: Record<string, string>;
}

export interface Comparison {
  differing: number;
  rows: { tag: string; left: string | null; right: string | null; state: 'same' | 'differs' | 'missing'; problem?: string }[];
}

export const pathOf = (name: string) => `/api/recipes/${encodeURIComponent(name)}`;

export function rangeOf(tag: RecipeTag): string {
  if (tag.type === 'BOOL') return t('trueOrFalse');
  if (isString(tag.type)) return t('text');
  const range = t('range', { min: String(tag.min), max: String(tag.max), unit: tag.unit }).trim();
  return tag.type === 'TIME' ? t('timeRange', { range }) : range;
}

// What the server says of single values, and what it says of none of them.
export function sortProblems(problems: Problem[], tags: RecipeTag[]): { fields: Record<string, string>; rest: Problem[] } {
  const fields: Record<string, string> = {};
  const rest: Problem[] = [];
  for (const problem of problems) {
    const tag = tags.find(({ name }) => problem.file === `values.${name}`);
    if (tag) fields[tag.name] = sentences([{ ...problem, message: problem.message.replace(`${tag.name}: `, '') }]);
    else rest.push(problem);
  }
  return { fields, rest };
}
