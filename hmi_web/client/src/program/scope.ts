// What the names of a sheet stand for in one of its instances: tags of the running program, or steps of its chart.

import type { ProgramMessage, Tag, TagValue } from '../lib/protocol';
import { enumerationOf, nameOr } from '../lib/tag_notes';
import type { Instance, Sheet, Sources } from './document';

// Names are compared without upper and lower case.
const fold = (name: string) => name.toLowerCase();

// "level" of "level.x[3]".
export const firstName = (path: string) => /^[^.[^]*/.exec(path)?.[0] ?? path;

export class TagTable {
  private readonly byName = new Map<string, number>();
  private readonly byAddress = new Map<string, number>();
  private readonly steps = new Map<string, number>(); // "plan.s1" of the chart "plan" -> index among all steps

  constructor(readonly program: ProgramMessage | null) {
    program?.tags.forEach((tag, index) => {
      this.byName.set(fold(tag.name), index);
      if (tag.address !== '') this.byAddress.set(fold(tag.address), index);
    });
    let first = 0;
    for (const chart of program?.charts ?? []) {
      for (let i = first; i < first + chart.steps; ++i) this.steps.set(fold(`${chart.name}.${program?.steps[i]?.name}`), i);
      first += chart.steps;
    }
  }

  // By path or by address, -1 if there is none.
  index(name: string): number {
    const key = fold(name);
    return this.byName.get(key) ?? this.byAddress.get(key) ?? -1;
  }

  tag(index: number): Tag | undefined {
    return this.program?.tags[index];
  }

  // A value of it, of an enumeration by its name.
  value(index: number, values: readonly TagValue[]): TagValue {
    return nameOr(values[index] ?? null, enumerationOf(this.program, index));
  }

  step(chart: string, name: string): number {
    return this.steps.get(fold(`${chart}.${name}`)) ?? -1;
  }
}

// A value with its type; a step's flag is a BOOL.
export interface Live {
  value: TagValue;
  type: string;
}

export const NOT_KNOWN: Live = { value: null, type: '' };

export class Scope {
  private readonly own: Map<string, string>; // variable -> section
  private readonly known = new Map<string, { tag: number; step: number; type: string }>(); // by path

  constructor(
    readonly sheet: Sheet,
    readonly instance: string, // path; empty: the sheet has none (a function)
    private readonly tags: TagTable,
    private readonly asked: (tag: number) => void = () => {}, // the value of a tag is shown from now on
  ) {
    this.own = new Map(sheet.variables.map((variable) => [fold(variable.name), variable.section]));
  }

  declares(name: string): boolean {
    return this.own.has(fold(firstName(name)));
  }

  // The whole path, "" for what has no value between two scans.
  resolve(path: string): string {
    if (path.startsWith('%')) {
      const tag = this.tags.tag(this.tags.index(path));
      return tag ? tag.name : path;
    }
    const section = this.own.get(fold(firstName(path)));
    if (section === undefined && this.tags.step(this.instance, firstName(path)) >= 0) return `${this.instance}.${path}`;
    if (section === undefined || section === 'VAR_EXTERNAL' || section === 'VAR_GLOBAL') return path;
    if (section === 'VAR_TEMP' || section === 'VAR_IN_OUT' || this.instance === '') return '';
    return `${this.instance}.${path}`;
  }

  isTag(path: string): boolean {
    const whole = this.resolve(path);
    return whole !== '' && this.tags.index(whole) >= 0;
  }

  live(path: string, values: readonly TagValue[], activeSteps: ReadonlySet<number>): Live {
    let known = this.known.get(path);
    if (!known) this.known.set(path, (known = this.find(path)));
    if (known.tag >= 0) return { value: this.tags.value(known.tag, values), type: known.type };
    return known.step < 0 ? NOT_KNOWN : { value: activeSteps.has(known.step) ? 1 : 0, type: 'BOOL' };
  }

  private find(path: string): { tag: number; step: number; type: string } {
    const whole = this.resolve(path);
    const tag = whole === '' ? -1 : this.tags.index(whole);
    if (tag >= 0) this.asked(tag);
    const step = /^([^.]+)\.X$/i.exec(path);
    return { tag, step: step && tag < 0 ? this.tags.step(this.instance, step[1] ?? '') : -1, type: this.tags.tag(tag)?.type ?? '' };
  }

  // -1: no such step, or its chart is not followed.
  stepIndex(name: string): number {
    return this.tags.step(this.instance, name);
  }
}

// Instances of a sheet in the running program; of what has none (functions, types) the one without a path.
export function instancesOf(sheet: Sheet, instances: readonly Instance[]): string[] {
  const paths = instances.filter((one) => fold(one.pou) === fold(sheet.name)).map((one) => one.path);
  return paths.length > 0 && sheet.kind !== 'FUNCTION' ? paths : [''];
}

// The sheet of an instance, and the instance: of "M1.f.y" that of the block `f` if it has one.
export function homeOf(path: string, sources: Sources): { sheet: number; instance: string } | null {
  const key = fold(path);
  let best: Instance | null = null;
  for (const one of sources.instances) {
    const fits = key === fold(one.path) || key.startsWith(`${fold(one.path)}.`);
    const known = sources.sheets.some((sheet) => fold(sheet.name) === fold(one.pou));
    if (fits && known && one.path.length > (best?.path.length ?? -1)) best = one;
  }
  if (!best) return null;
  const pou = fold(best.pou);
  return { sheet: sources.sheets.findIndex((sheet) => fold(sheet.name) === pou), instance: best.path };
}
