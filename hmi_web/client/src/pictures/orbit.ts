// A view of space from a direction, without perspective, as drawings have it: what is parallel stays so, and a length is the same
// wherever it is.

import { dot, plus, type Vector } from './space';

export interface Orbit {
  azimuth: number; // rad, of who looks, from x towards y
  elevation: number; // rad
  scale: number; // pixels for a metre
  centre: Vector; // in the middle of the picture
}

export const SIGHTS = {
  corner: { azimuth: -0.62, elevation: 0.5 },
  front: { azimuth: 0, elevation: 0 },
  side: { azimuth: -Math.PI / 2, elevation: 0 },
  top: { azimuth: Math.PI, elevation: Math.PI / 2 },
} as const;
export type Sight = keyof typeof SIGHTS;

const LEAST_SCALE = 0.4; // of all in sight
const MOST_SCALE = 12;

export interface Axes {
  right: Vector;
  up: Vector;
  towards: Vector; // who looks
}

export function axesOf({ azimuth, elevation }: Pick<Orbit, 'azimuth' | 'elevation'>): Axes {
  const [c, s, ce, se] = [Math.cos(azimuth), Math.sin(azimuth), Math.cos(elevation), Math.sin(elevation)];
  return { right: [-s, c, 0], up: [-c * se, -s * se, ce], towards: [c * ce, s * ce, se] };
}

// Pixels to the right and down, and metres towards who looks.
export function project(orbit: Orbit, axes: Axes, width: number, height: number, point: Vector): Vector {
  const off = plus(point, orbit.centre, -1);
  return [width / 2 + orbit.scale * dot(axes.right, off), height / 2 - orbit.scale * dot(axes.up, off), dot(axes.towards, off)];
}

const ROOM = 0.92; // of the picture that all takes, at most

// All of these points from a direction, with a little room around.
export function fitted(sight: Sight, points: readonly Vector[], width: number, height: number): Orbit {
  const { right, up, towards } = axesOf(SIGHTS[sight]);
  const range = (axis: Vector) => {
    let [low, high] = [Infinity, -Infinity];
    for (const point of points) {
      const along = dot(axis, point);
      low = Math.min(low, along);
      high = Math.max(high, along);
    }
    return low <= high ? { middle: (low + high) / 2, size: high - low } : { middle: 0, size: 2 };
  };
  const [across, above, deep] = [range(right), range(up), range(towards)];
  const scale = ROOM * Math.min(width / Math.max(across.size, 0.1), height / Math.max(above.size, 0.1));
  return { ...SIGHTS[sight], scale, centre: plus(plus(plus([0, 0, 0], right, across.middle), up, above.middle), towards, deep.middle) };
}

// By angles; never over the top.
export function orbited(orbit: Orbit, turn: number, lift: number): Orbit {
  return { ...orbit, azimuth: orbit.azimuth + turn, elevation: Math.min(Math.max(orbit.elevation + lift, -Math.PI / 2), Math.PI / 2) };
}

// The picture goes so many pixels to the right and down.
export function panned(orbit: Orbit, dx: number, dy: number): Orbit {
  const { right, up } = axesOf(orbit);
  return { ...orbit, centre: plus(plus(orbit.centre, right, -dx / orbit.scale), up, dy / orbit.scale) };
}

// What is at (x, y), from the middle of the picture, stays there. `whole`: the scale at which all is in sight.
export function zoomed(orbit: Orbit, whole: number, factor: number, x = 0, y = 0): Orbit {
  const scale = Math.min(Math.max(orbit.scale * factor, LEAST_SCALE * whole), MOST_SCALE * whole);
  const { right, up } = axesOf(orbit);
  const shift = 1 / orbit.scale - 1 / scale;
  return { ...orbit, scale, centre: plus(plus(orbit.centre, right, x * shift), up, -y * shift) };
}

// From one to another; the shorter way round.
export function between(from: Orbit, to: Orbit, share: number): Orbit {
  const mix = (a: number, b: number) => a + share * (b - a);
  const turn = Math.atan2(Math.sin(to.azimuth - from.azimuth), Math.cos(to.azimuth - from.azimuth));
  return {
    azimuth: from.azimuth + share * turn,
    elevation: mix(from.elevation, to.elevation),
    scale: from.scale * (to.scale / from.scale) ** share,
    centre: [mix(from.centre[0], to.centre[0]), mix(from.centre[1], to.centre[1]), mix(from.centre[2], to.centre[2])],
  };
}
