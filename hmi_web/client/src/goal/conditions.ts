// A goal as conditions that all must hold, each a row of a form; to PDDL and, as far as it is no more than that, back.

import { decimalText, readNumber } from '../lib/number_input';
import { t } from './texts';
import type { GoalSensor, GoalSymbol, GoalWords } from './words';

export const RELATIONS = ['=', '>=', '<=', '>', '<'] as const;
export type Relation = (typeof RELATIONS)[number];

// As it stands in the form; what does not belong to its kind is kept, so that nothing is lost by a slip of the hand.
export interface Condition {
  key: number;
  kind: 'fact' | 'quantity';
  name: string;
  objects: string[];
  holds: boolean; // of a fact
  relation: Relation; // of a quantity, as the rest
  number: string;
  other: string; // another quantity to compare with, "(demand c1)"; '': the number
}

export type Expression = string | Expression[];

let last = 0;

export function newCondition(kind: Condition['kind'], words: GoalWords): Condition {
  const symbol = symbolsOf(kind, words)[0];
  const condition: Condition = { key: ++last, kind, name: '', objects: [], holds: true, relation: '=', number: '', other: '' };
  return symbol ? named(condition, symbol, words) : condition;
}

// Those that a condition of this kind can be about.
export function symbolsOf(kind: Condition['kind'], words: GoalWords): GoalSymbol[] {
  return kind === 'fact' ? words.predicates : words.functions.filter((symbol) => symbol.changes);
}

export function symbolOf(condition: Condition, words: GoalWords): GoalSymbol | undefined {
  return symbolsOf(condition.kind, words).find((symbol) => symbol.name === condition.name);
}

// The same about something else; objects that fit there stay.
export function named(condition: Condition, symbol: GoalSymbol, words: GoalWords): Condition {
  const objects = symbol.parameters.map(({ type }, index) => {
    const choices = words.objects.get(type) ?? [];
    const before = condition.objects[index];
    return before !== undefined && choices.includes(before) ? before : (choices[0] ?? '');
  });
  return { ...condition, name: symbol.name, objects };
}

export const atomOf = (name: string, objects: string[]) => `(${[name, ...objects].join(' ')})`;
export const subjectOf = (condition: Condition) => atomOf(condition.name, condition.objects);

// Quantities that a number can be exchanged for: those about something that the condition speaks of, or about nothing.
export function othersOf(condition: Condition, words: GoalWords): string[] {
  const subject = subjectOf(condition);
  const found = words.functions.flatMap((symbol) => {
    if (symbol.parameters.length > 1) return [];
    const [parameter] = symbol.parameters;
    if (!parameter) return [atomOf(symbol.name, [])];
    const choices = words.objects.get(parameter.type) ?? [];
    return choices.filter((object) => condition.objects.includes(object)).map((object) => atomOf(symbol.name, [object]));
  });
  const all = found.filter((atom) => atom !== subject);
  return condition.other !== '' && !all.includes(condition.other) ? [condition.other, ...all] : all;
}

export function writeCondition(condition: Condition): string {
  const subject = subjectOf(condition);
  if (condition.kind === 'fact') return condition.holds ? subject : `(not ${subject})`;
  return `(${condition.relation} ${subject} ${condition.other || decimalText(condition.number) || condition.number.trim() || '?'})`;
}

// A line for each, so that a line of a problem tells the condition.
export function writeGoal(conditions: Condition[]): string {
  const [only] = conditions;
  if (only && conditions.length === 1) return writeCondition(only);
  return `(and${conditions.map((each) => `\n  ${writeCondition(each)}`).join('')})`;
}

// The condition that a problem of that line is about; -1: of none.
export function conditionOfLine(line: number, count: number): number {
  if (count === 1) return line === 1 ? 0 : -1;
  return line >= 2 && line < count + 2 ? line - 2 : -1;
}

// What is wrong with what was typed; '' = nothing.
export function problemOf(condition: Condition, sensor: GoalSensor | undefined): string {
  if (condition.objects.includes('')) return t('chooseObject');
  if (condition.kind === 'fact' || condition.other !== '') return '';
  if (condition.number.trim() === '') return t('numberMissing');
  const value = readNumber(condition.number);
  if (value === null) return t('noNumber', { text: condition.number.trim() });
  if (sensor?.range && (value < sensor.range[0] || value > sensor.range[1])) {
    return t('outOfRange', { label: sensor.label || sensor.fluent, low: sensor.range[0], high: sensor.range[1] });
  }
  const steps = sensor && sensor.step > 0 ? value / sensor.step : 0;
  if (sensor && condition.relation === '=' && Math.abs(steps - Math.round(steps)) > 1e-9) return t('onlySteps', { step: sensor.step });
  return '';
}

// PDDL as nested lists; null for what is none.
export function readExpression(text: string): Expression | null {
  const tokens = text.toLowerCase().replace(/;[^\n]*/g, '').match(/[()]|[^\s()]+/g) ?? [];
  const stack: Expression[][] = [[]];
  for (const token of tokens) {
    const open = stack.at(-1);
    if (!open) return null;
    if (token === '(') stack.push([]);
    else if (token !== ')') open.push(token);
    else {
      stack.pop();
      stack.at(-1)?.push(open);
    }
  }
  const [whole] = stack;
  return stack.length === 1 && whole?.length === 1 ? (whole[0] ?? null) : null;
}

function atom(expression: Expression | undefined): { name: string; objects: string[] } | null {
  if (!Array.isArray(expression) || expression.some((each) => typeof each !== 'string')) return null;
  const [name, ...objects] = expression as string[];
  return name === undefined ? null : { name, objects };
}

function fits(about: { name: string; objects: string[] }, symbols: GoalSymbol[], words: GoalWords): boolean {
  const symbol = symbols.find(({ name }) => name === about.name);
  if (!symbol || symbol.parameters.length !== about.objects.length) return false;
  return symbol.parameters.every(({ type }, index) => (words.objects.get(type) ?? []).includes(about.objects[index] ?? ''));
}

function conditionOf(expression: Expression, words: GoalWords): Condition | null {
  if (!Array.isArray(expression)) return null;
  const [head, left, right, ...more] = expression;
  const begun = { key: ++last, holds: true, relation: '=' as Relation, number: '', other: '' };
  const relation = RELATIONS.find((each) => each === head);
  if (relation && left !== undefined && right !== undefined && more.length === 0) {
    const about = atom(left);
    if (!about || !fits(about, symbolsOf('quantity', words), words)) return null;
    if (typeof right === 'string') return { ...begun, kind: 'quantity', ...about, relation, number: right };
    const other = atom(right);
    if (!other || !fits(other, words.functions, words)) return null;
    return { ...begun, kind: 'quantity', ...about, relation, other: atomOf(other.name, other.objects) };
  }
  const negated = head === 'not' && expression.length === 2;
  const about = atom(negated ? left : expression);
  if (!about || !fits(about, words.predicates, words)) return null;
  return { ...begun, kind: 'fact', ...about, holds: !negated };
}

// The goal as conditions; null where it says more than conditions can.
export function readGoal(text: string, words: GoalWords): Condition[] | null {
  const whole = readExpression(text);
  if (!Array.isArray(whole)) return null;
  const parts = whole[0] === 'and' ? whole.slice(1) : [whole];
  const conditions = parts.map((part) => conditionOf(part, words));
  return conditions.every((each) => each !== null) ? (conditions as Condition[]) : null;
}
