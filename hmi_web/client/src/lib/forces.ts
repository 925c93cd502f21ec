// Which variables are forced, by their names: upper and lower case alike, as IEC 61131-3 has it. A part of a forced variable is
// forced, and so is, in part, what a forced one belongs to; what lies at the same place the server tells.

import type { StandingForce } from './protocol';

const within = (part: string, whole: string): boolean => part.startsWith(whole) && (part[whole.length] === '.' || part[whole.length] === '[');

export class ForcedNames {
  private readonly names: ReadonlySet<string>;

  constructor(forces: readonly StandingForce[]) {
    this.names = new Set(forces.flatMap(({ name, also }) => [name, ...also]).map((name) => name.toLowerCase()));
  }

  // By the whole name.
  has(name: string): boolean {
    if (this.names.size === 0 || name === '') return false;
    const wanted = name.toLowerCase();
    if (this.names.has(wanted)) return true;
    for (const forced of this.names) if (within(wanted, forced) || within(forced, wanted)) return true;
    return false;
  }
}
