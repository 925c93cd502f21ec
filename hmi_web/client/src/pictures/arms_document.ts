// The picture of a cell of arms (supervisor/doc/pictures.md, arms), read with doubt: what is missing, of the wrong kind or points
// nowhere is left out, and the rest is drawn.

import { fieldsOf, listOf, numberOf, recordsOf, textOf, type Fields } from '../lib/doubt';
import { STILL, type Place, type Vector } from './space';

export type Solid =
  | { kind: 'box'; place: Place; size: Vector }
  | { kind: 'cylinder'; place: Place; radius: number; length: number }
  | { kind: 'ball'; place: Place; radius: number }
  | { kind: 'mesh'; place: Place; points: Vector[]; triangles: number[][] };

// factor * variable + offset; `rest` stands for the variable while it is not known.
export interface Reading {
  variable: string;
  factor: number;
  offset: number;
  rest: number;
}

export interface Body {
  name: string;
  solids: Solid[];
}

export interface Surface {
  name: string;
  place: Place;
  size: [number, number];
}

export interface Frame {
  name: string;
  parent: number; // -1: the cell
  arm: number; // whose body it is; -1: none's
  place: Place;
  motion: 'fixed' | 'turns' | 'slides';
  axis: Vector;
  value: Reading;
  solids: Solid[];
}

export interface Wait {
  at: number;
  other: number;
  progress: number;
}

export interface Step {
  kind: string;
  thing: string;
  waits: Wait[];
}

export interface Capsule {
  frame: number;
  from: Vector;
  to: Vector;
  radius: number;
}

// Of a thing, while the arm's progress is at least `from` and below `until`.
export interface Held extends Capsule {
  begins: number;
  until: number;
}

export interface WayPoint {
  at: Vector;
  progress: number;
}

export interface Arm {
  name: string;
  joints: { name: string; frame: number }[];
  tool: number; // frame
  opening: Reading;
  capsules: Capsule[];
  held: Held[];
  steps: Step[];
  way: WayPoint[];
  progress: string; // variables
  waiting: string;
  grasped: string;
  standing: string;
  error: string;
}

// Where a thing is once the arm has come so far.
export interface Stage {
  arm: number; // -1: from the beginning
  from: number;
  frame: number; // that carries it; -1: it stands in the cell
  place: Place;
}

export interface Thing {
  name: string;
  solids: Solid[];
  stages: Stage[];
}

export interface Slot {
  kind: string;
  x: Reading;
  y: Reading;
  z: Reading;
  yaw: Reading;
}

export interface ArmsPicture {
  kind: 'arms';
  id: string;
  program: string; // digest; empty: nothing is planned
  bodies: Body[];
  surfaces: Surface[];
  frames: Frame[];
  arms: Arm[];
  things: Thing[];
  seen: Slot[];
  kinds: Map<number, string>;
  distance: string; // variable
  leastDistanceM: number;
  cause: string; // variable
  causes: string[];
  causeArm: string; // variable
  leftOut: string[];
}

const FAR_M = 1_000;
const MOST = 512; // frames, solids of one, faces of a mesh

const number = (value: unknown, otherwise = 0): number => numberOf(value) ?? otherwise;
const some = <T>(list: T[]): T[] => list.slice(0, MOST);

function vector(value: unknown): Vector | null {
  const [x, y, z] = listOf(value).map(numberOf);
  const near = (one: number | null | undefined): one is number => typeof one === 'number' && Math.abs(one) < FAR_M;
  return near(x) && near(y) && near(z) ? [x, y, z] : null;
}

function place(value: unknown): Place {
  const rows = listOf(value).slice(3, 12).map(numberOf);
  const at = vector(value) ?? [0, 0, 0];
  return { at, rows: rows.length === 9 && rows.every((one) => one !== null && Math.abs(one) <= 1.001) ? (rows as number[]) : STILL.rows };
}

function solid(from: Fields): Solid[] {
  const at = place(from.place);
  const [radius, length] = [number(from.radius_m), number(from.length_m)];
  switch (from.kind) {
    case 'box': {
      const size = vector(from.size_m);
      return size && size.every((side) => side > 0) ? [{ kind: 'box', place: at, size }] : [];
    }
    case 'cylinder':
      return radius > 0 && length > 0 ? [{ kind: 'cylinder', place: at, radius, length }] : [];
    case 'ball':
      return radius > 0 ? [{ kind: 'ball', place: at, radius }] : [];
    case 'mesh': {
      const points = listOf(from.points_m).map(vector);
      const triangles = some(listOf(from.triangles).map((one) => listOf(one).map((index) => number(index, -1))));
      const whole = triangles.filter((one) => one.length === 3 && one.every((index) => points[index]));
      return whole.length > 0 ? [{ kind: 'mesh', place: at, points: points.map((one): Vector => one ?? [0, 0, 0]), triangles: whole }] : [];
    }
    default:
      return [];
  }
}

const solids = (value: unknown): Solid[] => some(recordsOf(value)).flatMap(solid);

function reading(value: unknown): Reading {
  const from = fieldsOf(value) ?? {};
  return { variable: textOf(from.variable), factor: number(from.factor, 1), offset: number(from.offset), rest: number(from.rest) };
}

// A parent comes before its children.
function frame(from: Fields, index: number): Frame {
  const parent = number(from.parent, -1);
  return {
    name: textOf(from.name),
    parent: Number.isInteger(parent) && parent >= -1 && parent < index ? parent : -1,
    arm: number(from.arm, -1),
    place: place(from.place),
    motion: from.motion === 'turns' || from.motion === 'slides' ? from.motion : 'fixed',
    axis: vector(from.axis) ?? [0, 0, 1],
    value: reading(from.value),
    solids: solids(from.solids),
  };
}

function step(from: Fields): Step {
  const waits = recordsOf(from.waits).map((wait) => ({ at: number(wait.at), other: number(wait.other, -1), progress: number(wait.progress) }));
  return { kind: textOf(from.kind), thing: textOf(from.thing), waits };
}

function capsule(from: Fields, known: (frame: unknown) => boolean): Capsule[] {
  const [start, end] = [vector(from.from_m), vector(from.to_m)];
  return start && end && known(from.frame) ? [{ frame: number(from.frame), from: start, to: end, radius: Math.max(0, number(from.radius_m)) }] : [];
}

function way(value: unknown): WayPoint[] {
  return listOf(value).flatMap((point) => {
    const at = vector(point);
    const progress = numberOf(listOf(point)[3]);
    return at && progress !== null ? [{ at, progress }] : [];
  });
}

function arm(from: Fields, frames: number, planned: unknown): Arm[] {
  const known = (index: unknown) => Number.isInteger(index) && (index as number) >= 0 && (index as number) < frames;
  if (!known(from.tool)) return [];
  return [
    {
      name: textOf(from.name),
      joints: recordsOf(from.joints).filter((joint) => known(joint.frame)).map((joint) => ({ name: textOf(joint.name), frame: number(joint.frame) })),
      tool: number(from.tool),
      opening: reading(from.opening),
      capsules: some(recordsOf(from.capsules)).flatMap((one) => capsule(one, known)),
      held: some(recordsOf(from.held)).flatMap((one) => capsule(one, known).map((body) => ({ ...body, begins: number(one.from), until: number(one.until) }))),
      steps: recordsOf(from.steps).map(step),
      way: way(planned),
      progress: textOf(from.progress),
      waiting: textOf(from.waiting),
      grasped: textOf(from.grasped),
      standing: textOf(from.standing),
      error: textOf(from.error),
    },
  ];
}

function thing(from: Fields, frames: number): Thing {
  const stages = recordsOf(from.stages).map((one): Stage => ({
    arm: number(one.arm, -1),
    from: number(one.from),
    frame: number(one.frame, -1) < frames ? number(one.frame, -1) : -1,
    place: place(one.place),
  }));
  return { name: textOf(from.name), solids: solids(from.solids), stages };
}

export function armsPicture(from: Fields, id: string): ArmsPicture {
  const frames = some(recordsOf(from.frames)).map(frame);
  const ways = listOf(from.ways);
  return {
    kind: 'arms',
    id,
    program: textOf(from.program),
    bodies: some(recordsOf(from.bodies)).map((one) => ({ name: textOf(one.name), solids: solids(one.solids) })),
    surfaces: recordsOf(from.surfaces).flatMap((one) => {
      const [x, y] = listOf(one.size_m).map(numberOf);
      return typeof x === 'number' && typeof y === 'number' ? [{ name: textOf(one.name), place: place(one.place), size: [x, y] as [number, number] }] : [];
    }),
    frames,
    arms: recordsOf(from.arms).flatMap((one, index) => arm(one, frames.length, ways[index])),
    things: some(recordsOf(from.things)).map((one) => thing(one, frames.length)),
    seen: recordsOf(from.seen).map((one) => ({ kind: textOf(one.kind), x: reading(one.x), y: reading(one.y), z: reading(one.z), yaw: reading(one.yaw) })),
    kinds: new Map(recordsOf(from.kinds).map((one) => [number(one.kind), textOf(one.name)])),
    distance: textOf(from.distance),
    leastDistanceM: Math.max(0, number(from.least_distance_m)),
    cause: textOf(from.cause),
    causes: listOf(from.causes).map(textOf),
    causeArm: textOf(from.cause_arm),
    leftOut: listOf(from.left_out).map(textOf).filter((part) => part !== ''),
  };
}
