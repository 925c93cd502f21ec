// A sheet of a program's document (program/document.ts) as lines that can be compared: declarations, then the body in the
// order of its blocks. ST keeps the numbers that its lines have in their file; what was drawn is written down.

import type { Block, Box, Condition, DrawnElement, Rung, Sheet, Variable } from '../program/document';

export interface Line {
  text: string;
  number: number; // in its file; 0: it has none
}

const plain = (text: string): Line => ({ text, number: 0 });

function declaration({ name, type, address, initial, comment }: Variable): Line {
  return plain(`  ${name}${address ? ` AT ${address}` : ''} : ${type}${initial ? ` := ${initial}` : ''};${comment ? ` (* ${comment} *)` : ''}`);
}

function declarations(variables: Variable[]): Line[] {
  const lines: Line[] = [];
  let section = '';
  for (const variable of variables) {
    if (variable.section !== section) {
      if (section !== '') lines.push(plain('END_VAR'));
      lines.push(plain(variable.section));
      section = variable.section;
    }
    lines.push(declaration(variable));
  }
  if (section !== '') lines.push(plain('END_VAR'));
  return lines;
}

function condition(one: Condition): string {
  switch (one.kind) {
    case 'true':
      return 'TRUE';
    case 'contact':
      return `${one.negated ? 'NOT ' : ''}${one.edge === 'rising' ? '↑' : one.edge === 'falling' ? '↓' : ''}${one.name}`;
    case 'test':
      return `${one.negated ? 'NOT ' : ''}(${one.text})`;
    default:
      return `(${one.of.map(condition).join(one.kind === 'all' ? ' AND ' : ' OR ')})`;
  }
}

const pins = (list: [string, string][], arrow: string): string[] => list.map(([pin, value]) => `${pin} ${arrow} ${value}`);

function box({ type, instance, power, text, inputs, outputs }: Box): string {
  if (text !== '') return text;
  const name = instance ? `${instance} : ${type}` : type;
  return `${name}(${[...(power ? [`${power} ← `.trim()] : []), ...pins(inputs, ':='), ...pins(outputs, '=>')].join(', ')})`;
}

const COIL = { normal: '', negated: 'NOT ', set: 'S ', reset: 'R ', rising: '↑', falling: '↓', connector: '' } as const;

function rung(one: Rung): Line[] {
  const head = [`(* ${one.number} *)`, ...(one.label ? [`${one.label}:`] : []), ...(one.comment ? [`(* ${one.comment} *)`] : [])];
  const ends = [
    ...one.boxes.map(box),
    ...one.coils.map(({ kind, name }) => `${COIL[kind]}${name}`),
    ...(one.jump ? [`JMP ${one.jump}`] : []),
    ...(one.returns ? ['RETURN'] : []),
  ];
  return [plain(head.join(' ')), plain(`  ${one.goesOn ? '… ' : ''}${condition(one.condition)}`), ...ends.map((end) => plain(`    → ${end}`))];
}

function element(one: DrawnElement, index: number): Line {
  const name = [one.instance, one.name].filter((part) => part !== '').join(' : ');
  const input = one.inputs.map((pin) => {
    const from = pin.connections.map((each) => `#${each.from + 1}${each.output ? `.${each.output}` : ''}`).join(' + ');
    return `${pin.negated ? 'NOT ' : ''}${pin.name ? `${pin.name} := ` : ''}${pin.text || from}`;
  });
  return plain(`#${index + 1} ${one.kind} ${one.negated ? 'NOT ' : ''}${name}${one.storage ? ` (${one.storage})` : ''}${input.length > 0 ? ` ← ${input.join(', ')}` : ''}`);
}

function block(one: Block, steps: string[]): Line[] {
  switch (one.kind) {
    case 'text':
      return one.lines.map((text, index) => ({ text, number: one.first + index }));
    case 'action':
      return [plain(`ACTION ${one.name}:`), ...one.lines.map((text) => plain(`  ${text}`)), plain('END_ACTION')];
    case 'step':
      return [
        plain(`${one.initial ? 'INITIAL_STEP' : 'STEP'} ${one.name}:${one.comment ? ` (* ${one.comment} *)` : ''}`),
        ...one.actions.map(({ target, qualifier, duration, indicator }) =>
          plain(`  ${target}(${[qualifier, duration, indicator].filter((part) => part !== '').join(', ')});`),
        ),
        plain('END_STEP'),
      ];
    case 'transition': {
      const names = (list: number[]) => list.map((index) => steps[index] ?? '?').join(', ');
      const head = `TRANSITION ${one.name}${one.name ? ' ' : ''}FROM ${names(one.from)} TO ${names(one.to)}`;
      return [plain(head), ...one.lines.map((text) => plain(`  ${text}`)), plain('END_TRANSITION')];
    }
    case 'rung':
      return rung(one);
    case 'diagram':
      return one.elements.map(element);
    case 'unknown':
      return [];
  }
}

export function linesOf(sheet: Sheet): Line[] {
  const steps = sheet.blocks.map((one) => (one.kind === 'step' ? one.name : ''));
  const head = `${sheet.kind} ${sheet.name}${sheet.result ? ` : ${sheet.result}` : ''}`.trim();
  return [plain(head), ...declarations(sheet.variables), ...sheet.blocks.flatMap((one) => block(one, steps))];
}
