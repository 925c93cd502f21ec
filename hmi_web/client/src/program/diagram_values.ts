// The values on the wires of drawn function blocks, computed from values of one scan: outputs of instances are known, functions
// are computed, what leads back to itself is open.

import type { Diagram, DrawnElement, Pin } from './document';
import { and, callFunction, evaluate, not, or, type Known, type Lookup, type Result } from './expression';

const TRUE: Known = { kind: 'bool', value: 1 };

export class DiagramValues {
  private readonly known = new Map<string, Result>();
  private readonly running = new Set<string>();

  constructor(
    private readonly diagram: Diagram,
    private readonly lookup: Lookup,
  ) {}

  // What arrives at an input.
  at(pin: Pin): Result {
    const values = pin.connections.map(({ from, output }) => this.of(from, output));
    const value = pin.text !== '' ? evaluate(pin.text, this.lookup) : values.length > 1 ? values.reduce(or) : (values[0] ?? null);
    if (pin.edge) return null;
    return pin.negated ? not(value) : value;
  }

  // What leaves an element by an output.
  of(index: number, output: string): Result {
    const key = `${index} ${output.toUpperCase()}`;
    const known = this.known.get(key);
    if (known !== undefined) return known;
    const element = this.diagram.elements[index];
    if (!element || this.running.has(key)) return null;
    this.running.add(key);
    const value = this.compute(element, output);
    this.running.delete(key);
    this.known.set(key, value);
    return value;
  }

  private first(element: DrawnElement): Result {
    return element.inputs[0] ? this.at(element.inputs[0]) : null;
  }

  private compute(element: DrawnElement, output: string): Result {
    switch (element.kind) {
      case 'inVariable':
      case 'inOutVariable': {
        const value = element.edge ? null : evaluate(element.name, this.lookup);
        return element.negated ? not(value) : value;
      }
      case 'block':
        return this.block(element, output);
      case 'leftPowerRail':
        return TRUE;
      case 'contact': {
        const value = element.edge ? null : evaluate(element.name, this.lookup);
        return and(this.first(element), element.negated ? not(value) : value);
      }
      case 'continuation': {
        const name = element.name.toLowerCase();
        const from = this.diagram.elements.find((one) => one.kind === 'connector' && one.name.toLowerCase() === name);
        return from ? this.first(from) : null;
      }
      default:
        return this.first(element);
    }
  }

  private block(element: DrawnElement, output: string): Result {
    const pin = element.outputs.find((one) => one.name.toUpperCase() === output.toUpperCase()) ?? element.outputs[0];
    const name = pin?.name ?? output;
    const inputs = element.inputs.filter((one) => one.name.toUpperCase() !== 'EN');
    const enable = element.inputs.find((one) => one.name.toUpperCase() === 'EN');
    let value: Result;
    if (name.toUpperCase() === 'ENO') value = enable ? this.at(enable) : TRUE;
    else if (element.instance !== '') value = this.lookup(`${element.instance}.${name}`);
    else value = enable && this.at(enable)?.value !== 1 ? null : callFunction(element.name, inputs.map((one) => this.at(one)));
    return pin?.negated ? not(value) : value;
  }
}
