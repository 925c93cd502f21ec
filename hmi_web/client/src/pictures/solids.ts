// The faces of boxes, cylinders, balls and meshes: flat, convex, anticlockwise as seen from outside.

import type { Solid } from './arms_document';
import { moved, type Vector } from './space';

export interface Faces {
  points: Vector[];
  faces: number[][];
}

const SIDES = 20; // of a round

function box([x, y, z]: Vector): Faces {
  const points: Vector[] = [];
  for (const k of [-1, 1]) for (const j of [-1, 1]) for (const i of [-1, 1]) points.push([(i * x) / 2, (j * y) / 2, (k * z) / 2]);
  return { points, faces: [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]] };
}

function ring(radius: number, z: number): Vector[] {
  return Array.from({ length: SIDES }, (_, k) => {
    const angle = (2 * Math.PI * k) / SIDES;
    return [radius * Math.cos(angle), radius * Math.sin(angle), z];
  });
}

const next = (k: number) => (k + 1) % SIDES;
const around = Array.from({ length: SIDES }, (_, k) => k);

function cylinder(radius: number, length: number): Faces {
  const sides = around.map((k) => [k, next(k), SIDES + next(k), SIDES + k]);
  return { points: [...ring(radius, -length / 2), ...ring(radius, length / 2)], faces: [[...around].reverse(), around.map((k) => SIDES + k), ...sides] };
}

function ball(radius: number): Faces {
  const rings = SIDES / 2;
  const points: Vector[] = [];
  for (let row = 1; row < rings; row++) {
    const angle = (Math.PI * row) / rings;
    points.push(...ring(radius * Math.sin(angle), -radius * Math.cos(angle)));
  }
  const faces: number[][] = [around.map((k) => k).reverse(), around.map((k) => (rings - 2) * SIDES + k)];
  for (let row = 0; row + 2 < rings; row++) faces.push(...around.map((k) => [row * SIDES + k, row * SIDES + next(k), (row + 1) * SIDES + next(k), (row + 1) * SIDES + k]));
  return { points, faces };
}

function own(solid: Solid): Faces {
  switch (solid.kind) {
    case 'box':
      return box(solid.size);
    case 'cylinder':
      return cylinder(solid.radius, solid.length);
    case 'ball':
      return ball(solid.radius);
    case 'mesh':
      return { points: solid.points, faces: solid.triangles };
  }
}

// In the frame that the solid belongs to.
export function facesOf(solid: Solid): Faces {
  const { points, faces } = own(solid);
  return { points: points.map((point) => moved(solid.place, point)), faces };
}
