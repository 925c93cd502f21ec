// Values of ST expressions from values of one scan. What cannot be known (functions with state, texts, numbers that are too
// close to tell apart after the server has rounded them) is null; AND and OR know more than their operands.

export type Kind = 'bool' | 'int' | 'real' | 'time';
export interface Known {
  kind: Kind;
  value: number;
}
export type Result = Known | null;

// The value of a variable by its path.
export type Lookup = (path: string) => Result;

// The server sends three decimals.
const TELLABLE = 0.001;
const MOST_TOKENS = 2_000;
const DEEPEST = 100;

export function kindOf(type: string): Kind | null {
  const name = type.toUpperCase();
  if (name === 'BOOL') return 'bool';
  if (name === 'REAL' || name === 'LREAL') return 'real';
  if (name === 'TIME' || name === 'LTIME') return 'time';
  return /^(U?[SDL]?INT|BYTE|[DL]?WORD)$/.test(name) ? 'int' : null;
}

const bool = (value: boolean): Known => ({ kind: 'bool', value: value ? 1 : 0 });

export function and(a: Result, b: Result): Result {
  if ((a?.kind ?? 'bool') !== 'bool' || (b?.kind ?? 'bool') !== 'bool') return null;
  if (a?.value === 0 || b?.value === 0) return bool(false);
  return a && b ? bool(true) : null;
}

export function or(a: Result, b: Result): Result {
  if ((a?.kind ?? 'bool') !== 'bool' || (b?.kind ?? 'bool') !== 'bool') return null;
  if (a?.value === 1 || b?.value === 1) return bool(true);
  return a && b ? bool(false) : null;
}

export function not(a: Result): Result {
  return a?.kind === 'bool' ? bool(a.value === 0) : null;
}

function xor(a: Result, b: Result): Result {
  return a?.kind === 'bool' && b?.kind === 'bool' ? bool(a.value !== b.value) : null;
}

export function compare(a: Result, operator: string, b: Result): Result {
  if (!a || !b || (a.kind === 'bool') !== (b.kind === 'bool')) return null;
  const rounded = a.kind === 'real' || b.kind === 'real';
  if (rounded && Math.abs(a.value - b.value) <= TELLABLE) return null;
  switch (operator) {
    case '=':
      return bool(a.value === b.value);
    case '<>':
      return bool(a.value !== b.value);
    case '<':
      return bool(a.value < b.value);
    case '<=':
      return bool(a.value <= b.value);
    case '>':
      return bool(a.value > b.value);
    default:
      return bool(a.value >= b.value);
  }
}

function arithmetic(a: Result, operator: string, b: Result): Result {
  if (!a || !b || a.kind === 'bool' || b.kind === 'bool') return null;
  const kind: Kind = a.kind === 'time' || b.kind === 'time' ? 'time' : a.kind === 'real' || b.kind === 'real' ? 'real' : 'int';
  const whole = kind !== 'real';
  const value =
    operator === '+' ? a.value + b.value
    : operator === '-' ? a.value - b.value
    : operator === '*' ? a.value * b.value
    : operator === '/' ? (b.value === 0 ? NaN : whole ? Math.trunc(a.value / b.value) : a.value / b.value)
    : operator === 'MOD' ? (b.value === 0 ? 0 : a.value % b.value)
    : a.value ** b.value;
  return Number.isFinite(value) && (!whole || Number.isSafeInteger(value)) ? { kind, value } : null;
}

const NS: Record<string, number> = { d: 86_400e9, h: 3_600e9, m: 60e9, s: 1e9, ms: 1e6, us: 1e3, ns: 1 };

export function duration(literal: string): Result {
  const body = /^(?:T|TIME|LT|LTIME)#(-?)((?:[\d_]+(?:\.\d+)?(?:ms|us|ns|[dhms])_?)+)$/i.exec(literal);
  if (!body) return null;
  let value = 0;
  for (const part of (body[2] ?? '').matchAll(/([\d_]+(?:\.\d+)?)(ms|us|ns|[dhms])/gi)) {
    value += Number((part[1] ?? '').replaceAll('_', '')) * (NS[(part[2] ?? '').toLowerCase()] ?? NaN);
  }
  return { kind: 'time', value: body[1] === '-' ? -value : value };
}

function number(literal: string): Result {
  const plain = literal.replaceAll('_', '').replace(/^[A-Za-z]+#/, '');
  const based = /^(2|8|16)#([0-9A-Fa-f]+)$/.exec(plain);
  if (based) return { kind: 'int', value: parseInt(based[2] ?? '', Number(based[1])) };
  const value = Number(plain);
  if (!Number.isFinite(value)) return null;
  return { kind: /[.eE]/.test(plain) ? 'real' : 'int', value };
}

type Function = (inputs: Result[]) => Result;
const every = (operator: string): Function => (inputs) =>
  inputs.slice(1).reduce<Result>((sum, next, i) => and(sum, compare(inputs[i] ?? null, operator, next)), bool(true));
const fold = (step: (a: Result, b: Result) => Result): Function => (inputs) => (inputs.length === 0 ? null : inputs.reduce((a, b) => step(a, b)));
const pick = (choose: (...values: number[]) => number): Function => (inputs) => {
  const known = inputs.filter((one) => one !== null && one.kind !== 'bool') as Known[];
  return known.length === inputs.length && known[0] ? { kind: known[0].kind, value: choose(...known.map(({ value }) => value)) } : null;
};

const FUNCTIONS: Record<string, Function> = {
  AND: fold(and),
  OR: fold(or),
  XOR: fold(xor),
  NOT: (inputs) => not(inputs[0] ?? null),
  ADD: fold((a, b) => arithmetic(a, '+', b)),
  MUL: fold((a, b) => arithmetic(a, '*', b)),
  SUB: ([a = null, b = null]) => arithmetic(a, '-', b),
  DIV: ([a = null, b = null]) => arithmetic(a, '/', b),
  MOD: ([a = null, b = null]) => arithmetic(a, 'MOD', b),
  GT: every('>'),
  GE: every('>='),
  EQ: every('='),
  LE: every('<='),
  LT: every('<'),
  NE: every('<>'),
  MOVE: ([a = null]) => a,
  ABS: pick((value) => Math.abs(value)),
  MIN: pick(Math.min),
  MAX: pick(Math.max),
  LIMIT: pick((low, value, high) => Math.min(Math.max(value, low), high)),
  SEL: ([which = null, a = null, b = null]) => (which?.kind !== 'bool' ? null : which.value === 0 ? a : b),
  BOOL_TO_INT: ([a = null]) => (a ? { kind: 'int', value: a.value } : null),
  INT_TO_REAL: ([a = null]) => (a ? { kind: 'real', value: a.value } : null),
  DINT_TO_REAL: ([a = null]) => (a ? { kind: 'real', value: a.value } : null),
};

// Of a function that keeps no state; null for every other.
export function callFunction(name: string, inputs: Result[]): Result {
  return FUNCTIONS[name.toUpperCase()]?.(inputs) ?? null;
}

const TOKEN =
  /\s*(?:(\(\*[\s\S]*?\*\)|\/\/[^\n]*)|((?:T|TIME|LT|LTIME)#[-\w.]+)|((?:[A-Za-z]+#)?(?:2|8|16)#[0-9A-Fa-f_]+|(?:[A-Za-z]+#-?)?\d[\d_]*(?:\.\d+)?(?:[eE][+-]?\d+)?)|(%[A-Z]+[\d.]+|[A-Za-z_]\w*)|(<>|<=|>=|:=|\*\*|[-+*/()[\],.<>=&^]))/iy;

function tokens(text: string): string[] | null {
  const list: string[] = [];
  const end = text.trimEnd().length;
  TOKEN.lastIndex = 0;
  while (TOKEN.lastIndex < end) {
    const found = TOKEN.exec(text);
    if (!found || list.length > MOST_TOKENS) return null;
    if (found[1] === undefined) list.push(found[0].trim());
  }
  return list;
}

class Unreadable extends Error {}

class Reader {
  private at = 0;
  private depth = 0;

  constructor(
    private readonly list: string[],
    private readonly lookup: Lookup,
  ) {}

  all(): Result {
    const result = this.disjunction();
    if (this.at < this.list.length) throw new Unreadable();
    return result;
  }

  private get next(): string {
    return (this.list[this.at] ?? '').toUpperCase();
  }
  private take(...words: string[]): string {
    const word = this.next;
    if (!words.includes(word)) return '';
    this.at += 1;
    return word;
  }
  private chain(words: string[], operand: () => Result, join: (a: Result, word: string, b: Result) => Result): Result {
    let result = operand();
    for (let word = this.take(...words); word !== ''; word = this.take(...words)) result = join(result, word, operand());
    return result;
  }

  private disjunction(): Result {
    return this.chain(['OR', 'OR_ELSE'], () => this.exclusive(), (a, _, b) => or(a, b));
  }
  private exclusive(): Result {
    return this.chain(['XOR'], () => this.conjunction(), (a, _, b) => xor(a, b));
  }
  private conjunction(): Result {
    return this.chain(['AND', '&', 'AND_THEN'], () => this.equality(), (a, _, b) => and(a, b));
  }
  private equality(): Result {
    return this.chain(['=', '<>'], () => this.order(), compare);
  }
  private order(): Result {
    return this.chain(['<', '<=', '>', '>='], () => this.sum(), compare);
  }
  private sum(): Result {
    return this.chain(['+', '-'], () => this.product(), arithmetic);
  }
  private product(): Result {
    return this.chain(['*', '/', 'MOD'], () => this.power(), arithmetic);
  }
  private power(): Result {
    return this.chain(['**'], () => this.unary(), arithmetic);
  }

  private unary(): Result {
    if (++this.depth > DEEPEST) throw new Unreadable();
    const word = this.take('NOT', '-', '+');
    const operand = word === '' ? this.primary() : this.unary();
    this.depth -= 1;
    if (word === 'NOT') return not(operand);
    return word === '-' ? arithmetic({ kind: operand?.kind === 'time' ? 'time' : 'int', value: 0 }, '-', operand) : operand;
  }

  private primary(): Result {
    const word = this.list[this.at++] ?? '';
    if (word === '(') return this.closed(this.disjunction());
    if (/^T(IME)?#|^LT(IME)?#/i.test(word)) return duration(word);
    if (/^([A-Za-z]+#-?)?\d/.test(word)) return number(word);
    if (/^(TRUE|FALSE)$/i.test(word)) return bool(word.toUpperCase() === 'TRUE');
    if (!/^[%A-Za-z_]/.test(word)) throw new Unreadable();
    return this.next === '(' ? this.call(word) : this.path(word);
  }

  private closed(result: Result): Result {
    if (this.take(')') === '') throw new Unreadable();
    return result;
  }

  private call(name: string): Result {
    this.take('(');
    const inputs: Result[] = [];
    if (this.take(')') !== '') return callFunction(name, inputs);
    do {
      if (this.list[this.at + 1] === ':=') this.at += 2;
      inputs.push(this.disjunction());
    } while (this.take(',') !== '');
    return this.closed(callFunction(name, inputs));
  }

  // Indexes are expressions, too.
  private path(first: string): Result {
    let path: string | null = first;
    for (;;) {
      if (this.take('.') !== '') {
        const member = this.list[this.at++] ?? '';
        if (!/^[A-Za-z_]/.test(member)) path = null;
        else if (path !== null) path += `.${member}`;
      } else if (this.take('[') !== '') {
        do {
          const index: Result = this.disjunction();
          path = path === null || index?.kind !== 'int' ? null : `${path}[${index.value}]`;
        } while (this.take(',') !== '');
        if (this.take(']') === '') throw new Unreadable();
      } else if (this.take('^') !== '') {
        path = null;
      } else {
        return path === null ? null : this.lookup(path);
      }
    }
  }
}

// Null, too, for what is no expression.
export function evaluate(text: string, lookup: Lookup): Result {
  const list = tokens(text);
  if (!list || list.length === 0) return null;
  try {
    return new Reader(list, lookup).all();
  } catch (error) {
    if (error instanceof Unreadable) return null;
    throw error;
  }
}
