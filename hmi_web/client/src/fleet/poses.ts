// Where vehicles are, by their own navigation; by the simulated plant where there is nothing measured.

import type { Forklift, Value } from '../lib/protocol';
import { unwrapped } from './geometry';

export interface Pose {
  x: number;
  y: number;
  heading: number; // rad, not wrapped: it never jumps by a turn
  silent: boolean; // it shows nothing any more: this is where it was last
}

const FARTHEST_M = 10_000;
// A vehicle that stands nearer to the origin than this may well measure zeros.
const AT_ORIGIN_M = 1;

// Remembers the last pose of each vehicle.
export class Poses {
  private readonly last = new Map<string, Pose>();

  of(forklift: Forklift, point: (id: string) => Value): Pose | null {
    const before = this.last.get(forklift.id) ?? null;
    const pose = this.read(point(forklift.x), point(forklift.y), point(forklift.heading), before)
      ?? this.read(point(forklift.true_x), point(forklift.true_y), point(forklift.true_heading), before);
    if (pose) this.last.set(forklift.id, pose);
    return pose ?? before;
  }

  private read(x: Value, y: Value, heading: Value, before: Pose | null): Pose | null {
    if (x === null || y === null || !(Math.abs(x) <= FARTHEST_M) || !(Math.abs(y) <= FARTHEST_M)) return null;
    // A vehicle that answers nothing answers zeros.
    const silent = x === 0 && y === 0 && (heading ?? 0) === 0 && before !== null && Math.hypot(before.x, before.y) > AT_ORIGIN_M;
    if (silent) return { ...before, silent };
    return { x, y, heading: unwrapped(heading ?? 0, before?.heading ?? 0), silent: false };
  }
}
