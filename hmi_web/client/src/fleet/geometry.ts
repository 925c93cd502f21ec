// Drawings of the floor as SVG path data, in metres; and places along a path.

import type { Pair, RoutePath } from './document';

const short = (value: number) => String(Math.round(value * 1_000) / 1_000);

export function areaData(corners: Pair[]): string {
  if (corners.length < 3) return '';
  return `M${corners.map(([x, y]) => `${short(x)} ${short(y)}`).join('L')}Z`;
}

export function wayData(poses: [number, number, number][]): string {
  if (poses.length < 2) return '';
  return `M${poses.map(([x, y]) => `${short(x)} ${short(y)}`).join('L')}`;
}

// Of the outlines of a map, in cells: column and row, then steps along x and y by turns.
export function wallData(outlines: unknown): string {
  if (!Array.isArray(outlines)) return '';
  return outlines
    .filter((line): line is number[] => Array.isArray(line) && line.every((step) => Number.isFinite(step)))
    .filter((line) => line.length >= 5)
    .map((line) => {
      const steps = line.slice(2).map((step, index) => `${index % 2 === 0 ? 'h' : 'v'}${step}`);
      return `M${line[0]} ${line[1]}${steps.join('')}z`;
    })
    .join('');
}

export interface Place {
  x: number;
  y: number;
  heading: number; // rad
}

// Where a path is after so many metres; what lies behind its end is its end.
export function placeAt(path: RoutePath, arcM: number): Place | null {
  const { poses } = path;
  const first = poses[0];
  if (!first) return null;
  // Chords are a little shorter than the way.
  const lengths = poses.map((pose, k) => Math.hypot(pose[0] - (poses[k - 1] ?? pose)[0], pose[1] - (poses[k - 1] ?? pose)[1]));
  const whole = lengths.reduce((sum, length) => sum + length, 0);
  let rest = path.lengthM > 0 ? (arcM / path.lengthM) * whole : arcM;
  for (let k = 1; k < poses.length; k++) {
    const from = poses[k - 1]!;
    const to = poses[k]!;
    const length = lengths[k]!;
    if (rest <= length) {
      const share = length > 0 ? Math.max(0, rest) / length : 0;
      return at([from[0] + (to[0] - from[0]) * share, from[1] + (to[1] - from[1]) * share, share < 0.5 ? from[2] : to[2]]);
    }
    rest -= length;
  }
  return at(poses[poses.length - 1] ?? first);
}

function at(pose: [number, number, number]): Place {
  return { x: pose[0], y: pose[1], heading: (pose[2] * Math.PI) / 180 };
}

// The nearest angle to `before` that means the same as `angle`: turning on never spins back.
export function unwrapped(angle: number, before: number): number {
  return angle + 2 * Math.PI * Math.round((before - angle) / (2 * Math.PI));
}
