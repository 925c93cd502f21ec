// Which variables are forced, by their names: upper and lower case alike, as IEC 61131-3 has it. A part of a forced variable is
// forced, and so is, in part, what a forced one belongs to. What shares a place in an I/O area with it is forced, too: places can be
// forced by their address, and variables can lie over each other there.

import type { StandingForce, Tag } from './protocol';

const within = (part: string, whole: string): boolean => part.startsWith(whole) && (part[whole.length] === '.' || part[whole.length] === '[');

// The bits of a direct address.
interface Place {
  area: string;
  from: number;
  to: number; // behind the last
}

const BITS: Record<string, number> = { X: 1, B: 8, W: 16, D: 32, L: 64 };

// Of "%QX0.3", "%IW1"; null: it is none.
export function placeOf(address: string): Place | null {
  const [, area = '', size = '', number = '', bit] = /^%([IQ])([XBWDL]?)(\d+)(?:\.(\d))?$/.exec(address.toUpperCase()) ?? [];
  if (area === '') return null;
  const bits = BITS[size || 'X'] ?? 1;
  const from = Number(number) * Math.max(bits, 8) + Number(bit ?? 0);
  return { area, from, to: from + bits };
}

const overlap = (one: Place, other: Place): boolean => one.area === other.area && one.from < other.to && other.from < one.to;

export class ForcedNames {
  private readonly names: ReadonlySet<string>;

  // `tags`: of the program that runs.
  constructor(forces: readonly StandingForce[], tags: readonly Tag[] = []) {
    const names = new Set(forces.map(({ name }) => name.toLowerCase()));
    if (names.size > 0) {
      const located = tags.flatMap((tag) => {
        const place = placeOf(tag.address);
        return place ? [{ name: tag.name.toLowerCase(), place }] : [];
      });
      const places = [...names].flatMap((name) => placeOf(name) ?? []).concat(located.filter(({ name }) => names.has(name)).map(({ place }) => place));
      for (const { name, place } of located) if (places.some((one) => overlap(one, place))) names.add(name);
    }
    this.names = names;
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
