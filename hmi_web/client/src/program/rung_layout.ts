// Where the symbols and wires of a ladder network stand. Geometry only, in px: what has power is looked up when it is drawn.

import { isConnector, type Box, type Coil, type Condition, type Rung } from './document';

const LETTER = 7.3;
const GAP = 14; // of wire between neighbours
const BRANCH = 12; // beside parallel branches
const ROW = 18; // of a box
const MARGIN = 12;

// Which power a wire has: before or behind a condition; none: that of the whole network.
export interface Wire {
  points: string;
  of?: Condition;
  side: 'in' | 'out';
}

export type Symbol =
  | { kind: 'contact' | 'test'; x: number; y: number; width: number; condition: Condition }
  | { kind: 'coil'; x: number; y: number; width: number; coil: Coil; index: number }
  | { kind: 'box'; x: number; y: number; width: number; height: number; box: Box; index: number; rows: BoxRow[]; textLines: string[] }
  | { kind: 'connector'; x: number; y: number; width: number; name: string; of?: Condition } // of: the line begins here
  | { kind: 'jump'; x: number; y: number; width: number; label: string };

export interface BoxRow {
  pin: string; // inside, left
  value: string; // outside, left: an expression
  input: number; // of the box's inputs, -1: none (the power)
  out: string; // inside, right
  variable: string; // outside, right
  output: number; // of the box's outputs; -1: read from the instance
}

export interface RungLayout {
  width: number;
  height: number;
  left: number; // of the rails
  right: number;
  symbols: Symbol[];
  wires: Wire[];
}

interface Size {
  width: number;
  up: number;
  down: number;
}

const textWidth = (text: string) => 2 * Math.ceil((text.length * LETTER) / 2);

function sizeOf(condition: Condition): Size {
  switch (condition.kind) {
    case 'true':
      return { width: 24, up: 10, down: 10 };
    case 'contact':
      return { width: Math.max(44, textWidth(condition.name) + 6), up: 28, down: 12 };
    case 'test':
      return { width: textWidth(condition.text) + (condition.negated ? textWidth('NOT ') : 0) + 16, up: 16, down: 16 };
    default: {
      const sizes = condition.of.map(sizeOf);
      if (sizes.length === 0) return { width: 24, up: 10, down: 10 };
      const up = condition.kind === 'all' ? Math.max(...sizes.map((size) => size.up)) : (sizes[0]?.up ?? 0);
      if (condition.kind === 'all') {
        const width = sizes.reduce((sum, size) => sum + size.width, GAP * (sizes.length - 1));
        return { width, up, down: Math.max(...sizes.map((size) => size.down)) };
      }
      const height = sizes.reduce((sum, size) => sum + size.up + size.down, 0);
      return { width: Math.max(...sizes.map((size) => size.width)) + 2 * BRANCH, up, down: height - up };
    }
  }
}

// The state of the line that ended there, as it is.
const continues = (condition: Condition): boolean =>
  condition.kind === 'contact' && isConnector(condition.name) && !condition.negated && condition.edge === '';

// Whether the line begins with a connector: nothing leads there.
function beginsAnew(condition: Condition): boolean {
  if (condition.kind === 'any') return condition.of.length > 0 && condition.of.every(beginsAnew);
  const first = condition.kind === 'all' ? condition.of[0] : undefined;
  return first ? beginsAnew(first) : continues(condition);
}

class Drawing {
  readonly symbols: Symbol[] = [];
  readonly wires: Wire[] = [];

  wire(points: [number, number][], of: Condition | undefined, side: 'in' | 'out'): void {
    this.wires.push({ points: points.map(([x, y]) => `${x},${y}`).join(' '), ...(of ? { of } : {}), side });
  }

  // From x on, with the wire at y; ends at x + its width. `begins`: nothing stands between it and the rail.
  place(condition: Condition, x: number, y: number, begins: boolean): void {
    const { width } = sizeOf(condition);
    if (condition.kind === 'all' && condition.of.length > 0) return this.series(condition.of, x, y, begins);
    if (condition.kind === 'any' && condition.of.length > 0) return this.parallel(condition, x, y, width, begins);
    if (begins && condition.kind === 'contact' && continues(condition)) return this.connector(condition, condition.name, x, y, width);
    if (condition.kind === 'contact' || condition.kind === 'test') {
      const half = condition.kind === 'contact' ? 8 : (width - 8) / 2;
      const middle = x + width / 2;
      this.wire([[x, y], [middle - half, y]], condition, 'in');
      this.wire([[middle + half, y], [x + width, y]], condition, 'out');
      this.symbols.push({ kind: condition.kind, x, y, width, condition });
      return;
    }
    this.wire([[x, y], [x + width, y]], condition, 'out');
  }

  private connector(of: Condition, name: string, x: number, y: number, width: number): void {
    const end = textWidth(name) + 8;
    this.wire([[x + end, y], [x + width, y]], of, 'out');
    this.symbols.push({ kind: 'connector', x, y, width: end, name, of });
  }

  private series(of: Condition[], x: number, y: number, begins: boolean): void {
    of.forEach((one, i) => {
      this.place(one, x, y, begins && i === 0);
      x += sizeOf(one).width;
      if (i + 1 < of.length) this.wire([[x, y], [x + GAP, y]], one, 'out');
      x += GAP;
    });
  }

  private parallel(condition: Extract<Condition, { of: Condition[] }>, x: number, y: number, width: number, begins: boolean): void {
    let at = y;
    const end = x + width;
    let fed = y; // the lowest branch that the line in front leads to
    const ends = condition.of.map((one, i) => {
      const size = sizeOf(one);
      if (i > 0) at += size.up;
      if (!begins || !beginsAnew(one)) {
        this.wire([[x, at], [x + BRANCH, at]], condition, 'in');
        fed = at;
      }
      this.place(one, x + BRANCH, at, begins);
      this.wire([[x + BRANCH + size.width, at], [end, at]], one, 'out');
      const here = at;
      at += size.down;
      return here;
    });
    const last = ends.at(-1) ?? y;
    this.wire([[x, y], [x, fed]], condition, 'in');
    this.wire([[end, y], [end, last]], condition, 'out');
  }
}

// `more`: outputs of an instance that are shown though nothing is connected to them.
function rowsOf(box: Box, more: string[]): BoxRow[] {
  const inputs = [
    { pin: box.power || (box.text ? '' : 'EN'), value: '', input: -1 },
    ...box.inputs.filter(([, value]) => value !== '').map(([pin, value]) => ({ pin, value, input: box.inputs.findIndex((one) => one[0] === pin && one[1] === value) })),
  ];
  const connected = box.outputs.map(([pin, variable], output) => ({ out: pin || box.type, variable, output })).filter(({ variable }) => variable !== '');
  const others = more
    .filter((pin) => !connected.some((one) => one.out.toLowerCase() === pin.toLowerCase()))
    .map((pin) => ({ out: pin, variable: '', output: -1 }));
  const outputs = [...connected, ...others];
  return Array.from({ length: Math.max(inputs.length, outputs.length) }, (_, i) => ({
    ...(inputs[i] ?? { pin: '', value: '', input: -1 }),
    ...(outputs[i] ?? { out: '', variable: '', output: -1 }),
  }));
}

const VALUE = 9; // letters of a value behind its name

interface Output {
  width: number;
  up: number;
  down: number;
  put(drawing: Drawing, x: number, y: number): void;
}

function boxOutput(box: Box, index: number, more: string[]): Output {
  const textLines = box.text === '' ? [] : box.text.trim().split('\n').slice(0, 12);
  const rows = box.text === '' ? rowsOf(box, more) : [];
  const widest = (list: string[]) => Math.max(0, ...list.map(textWidth));
  const left = rows.some((row) => row.value !== '') ? widest(rows.filter((row) => row.value).map((row) => row.value)) + VALUE * LETTER : 20;
  const right = rows.some((row) => row.out !== '') ? widest(rows.map((row) => row.variable)) + (VALUE + 2) * LETTER : 0;
  const inside = Math.max(70, widest([box.type, box.instance]) + 12, widest(rows.map((row) => row.pin)) + widest(rows.map((row) => row.out)) + 28, widest(textLines) + 16);
  const height = Math.max(rows.length, textLines.length) * ROW + 26;
  const top = 36; // of the box above the wire: its title, and its name outside
  return {
    width: left + inside + right,
    up: top + 16,
    down: height - top + 14,
    put: (drawing, x, y) => {
      drawing.wire([[x, y], [x + left, y]], undefined, 'out');
      drawing.symbols.push({ kind: 'box', x: x + left, y: y - top, width: inside, height: height + 8, box, index, rows, textLines });
    },
  };
}

function coilOutput(coil: Coil, index: number): Output {
  const width = Math.max(54, textWidth(coil.name) + 10);
  return {
    width,
    up: 28,
    down: 14,
    put: (drawing, x, y) => {
      drawing.wire([[x, y], [x + width / 2 - 10, y]], undefined, 'out');
      drawing.wire([[x + width / 2 + 10, y], [x + width, y]], undefined, 'out');
      drawing.symbols.push({ kind: 'coil', x, y, width, coil, index });
    },
  };
}

// Its line ends here, and not at the rail.
function connectorOutput(name: string): Output {
  const width = textWidth(name) + 24;
  return { width, up: 14, down: 14, put: (drawing, x, y) => {
    drawing.wire([[x, y], [x + 10, y]], undefined, 'out');
    drawing.symbols.push({ kind: 'connector', x: x + 10, y, width: width - 10, name });
  } };
}

function jumpOutput(label: string): Output {
  const width = textWidth(label) + 34;
  return { width, up: 14, down: 14, put: (drawing, x, y) => {
    drawing.wire([[x, y], [x + 10, y]], undefined, 'out');
    drawing.symbols.push({ kind: 'jump', x: x + 10, y, width, label });
  } };
}

export function layOutRung(rung: Rung, outputsOf: (box: Box) => string[], minimum: number): RungLayout {
  const drawing = new Drawing();
  const condition = sizeOf(rung.condition);
  const outputs = [
    ...rung.boxes.map((box, i) => boxOutput(box, i, outputsOf(box))),
    ...rung.coils.map((coil, i) => (coil.kind === 'connector' ? connectorOutput(coil.name) : coilOutput(coil, i))),
    ...(rung.jump === '' ? [] : [jumpOutput(`→ ${rung.jump}`)]),
    ...(rung.returns ? [jumpOutput('RETURN')] : []),
  ];
  const widest = Math.max(30, ...outputs.map((output) => output.width));
  const left = MARGIN;
  const right = Math.max(minimum - MARGIN, left + GAP + condition.width + 2 * BRANCH + widest + GAP);
  const y = Math.max(condition.up, outputs[0]?.up ?? 0);
  if (!beginsAnew(rung.condition)) drawing.wire([[left, y], [left + GAP, y]], rung.condition, 'in');
  drawing.place(rung.condition, left + GAP, y, true);
  const from = right - GAP - widest;
  const knee = from - BRANCH;
  drawing.wire([[left + GAP + condition.width, y], [knee, y]], undefined, 'out');
  let at = y;
  let last = y;
  let bottom = y + condition.down;
  outputs.forEach((output, i) => {
    if (i > 0) at += output.up;
    const begin = right - GAP - output.width;
    drawing.wire([[knee, at], [begin, at]], undefined, 'out');
    output.put(drawing, begin, at);
    const coil = rung.coils[i - rung.boxes.length];
    if (coil && coil.kind !== 'connector') drawing.wire([[right - GAP, at], [right, at]], undefined, 'out');
    last = at;
    at += output.down;
    bottom = Math.max(bottom, at);
  });
  if (last > y) drawing.wire([[knee, y], [knee, last]], undefined, 'out');
  return { width: right + MARGIN, height: bottom + 4, left, right, symbols: drawing.symbols, wires: drawing.wires };
}
