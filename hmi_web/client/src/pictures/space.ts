// Places of space: vectors, and rotations with a shift. Metres, z up.

export type Vector = [x: number, y: number, z: number];

// A rotation, row by row, then a shift.
export interface Place {
  rows: readonly number[];
  at: Vector;
}

export const STILL: Place = { rows: [1, 0, 0, 0, 1, 0, 0, 0, 1], at: [0, 0, 0] };

export function turned(rows: readonly number[], [x, y, z]: Vector): Vector {
  return [
    rows[0]! * x + rows[1]! * y + rows[2]! * z,
    rows[3]! * x + rows[4]! * y + rows[5]! * z,
    rows[6]! * x + rows[7]! * y + rows[8]! * z,
  ];
}

export function moved(place: Place, point: Vector): Vector {
  const [x, y, z] = turned(place.rows, point);
  return [x + place.at[0], y + place.at[1], z + place.at[2]];
}

// First `second`, then `first`.
export function after(first: Place, second: Place): Place {
  const [a, b] = [first.rows, second.rows];
  const rows = new Array<number>(9);
  for (let row = 0; row < 9; row += 3)
    for (let column = 0; column < 3; column++)
      rows[row + column] = a[row]! * b[column]! + a[row + 1]! * b[3 + column]! + a[row + 2]! * b[6 + column]!;
  return { rows, at: moved(first, second.at) };
}

// By an angle about an axis of length 1 (Rodrigues).
export function about([x, y, z]: Vector, angle: number): number[] {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const k = 1 - c;
  return [
    c + k * x * x, k * x * y - s * z, k * x * z + s * y,
    k * x * y + s * z, c + k * y * y, k * y * z - s * x,
    k * x * z - s * y, k * y * z + s * x, c + k * z * z,
  ];
}

export const plus = (a: Vector, b: Vector, k = 1): Vector => [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]];
export const minus = (a: Vector, b: Vector): Vector => plus(a, b, -1);
export const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const size = (a: Vector): number => Math.hypot(a[0], a[1], a[2]);
export const gap = (a: Vector, b: Vector): number => size(minus(a, b));
