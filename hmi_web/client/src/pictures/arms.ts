// Where a cell's arms and things are at this moment, what each arm does and what it waits for: the picture with the variables' values.

import type { Value } from '../lib/protocol';
import type { Arm, ArmsPicture, Capsule, Frame, Reading, Step, Thing } from './arms_document';
import { about, after, dot, gap, minus, moved, plus, STILL, type Place, type Vector } from './space';

export type Known = (variable: string) => Value; // null: it is not known

export function valueOf(reading: Reading, known: Known): number {
  if (reading.variable === '') return reading.offset;
  return reading.factor * (known(reading.variable) ?? reading.rest) + reading.offset;
}

function moving(frame: Frame, known: Known): Place {
  if (frame.motion === 'fixed') return STILL;
  const value = valueOf(frame.value, known);
  return frame.motion === 'turns' ? { rows: about(frame.axis, value), at: [0, 0, 0] } : { rows: STILL.rows, at: plus([0, 0, 0], frame.axis, value) };
}

// Of each frame in the cell.
export function framePlaces(picture: ArmsPicture, known: Known): Place[] {
  const places: Place[] = [];
  for (const frame of picture.frames) {
    const parent = frame.parent < 0 ? STILL : places[frame.parent]!;
    places.push(after(after(parent, frame.place), moving(frame, known)));
  }
  return places;
}

export interface ThingPlace {
  thing: Thing;
  place: Place;
  holder: number; // an arm; -1: it stands
}

// The last of its stages that has begun. `progress`: of each arm.
export function thingPlace(picture: ArmsPicture, thing: Thing, places: Place[], progress: number[]): ThingPlace {
  const stage = thing.stages.filter(({ arm, from }) => arm < 0 || (progress[arm] ?? 0) >= from - 1e-9).at(-1) ?? { frame: -1, place: STILL };
  const carrier = places[stage.frame];
  return {
    thing,
    place: carrier ? after(carrier, stage.place) : stage.place,
    holder: carrier ? (picture.frames[stage.frame]?.arm ?? -1) : -1,
  };
}

// The last that was known, while another program runs.
export class Progress {
  private program = '';
  private last: number[] = [];

  of(picture: ArmsPicture, known: Known | null): number[] {
    if (picture.program !== this.program) {
      this.program = picture.program;
      this.last = [];
    }
    this.last = picture.arms.map(({ progress, steps }, index) => {
      const value = known && progress !== '' ? known(progress) : null;
      return Math.min(Math.max(value ?? this.last[index] ?? 0, 0), steps.length);
    });
    return this.last;
  }
}

export interface Doing {
  number: number; // of the step, from 1; 0: nothing is planned
  step: Step | null; // null: all are done, or nothing is planned
  share: number; // of all steps
  waitsFor: string; // an arm; empty: none
}

// What an arm is at, and whom it waits for: it says so itself on its way; before a step it stands, and the other one is not there yet.
export function doing(picture: ArmsPicture, arm: Arm, progress: number[], known: Known): Doing {
  const own = progress[picture.arms.indexOf(arm)] ?? 0;
  const index = Math.min(Math.floor(own + 1e-9), arm.steps.length);
  const step = arm.steps[index] ?? null;
  const open = step?.waits.find((wait) => (progress[wait.other] ?? 0) < wait.progress) ?? null;
  const says = arm.waiting !== '' && known(arm.waiting) === 1;
  const stands = own - index < 1e-6 && arm.standing !== '' && known(arm.standing) === 1;
  return {
    number: arm.steps.length === 0 ? 0 : Math.min(index + 1, arm.steps.length),
    step,
    share: arm.steps.length > 0 ? own / arm.steps.length : 0,
    waitsFor: open && (says || stands) ? (picture.arms[open.other]?.name ?? '') : '',
  };
}

// What is told of an arm beside the picture.
export interface ArmRow {
  name: string;
  joints: number[]; // degrees
  tool: Vector;
  openingM: number;
  held: string; // thing; empty: none
  isFelt: boolean; // what is held
  doing: Doing;
  steps: number;
}

const clamped = (value: number, low: number, high: number) => Math.min(Math.max(value, low), high);

// The nearest two points of two lines from end to end (Ericson 2005, Real-Time Collision Detection, 5.1.9).
export function nearest(a: [Vector, Vector], b: [Vector, Vector]): [Vector, Vector] {
  const [da, db, r] = [minus(a[1], a[0]), minus(b[1], b[0]), minus(a[0], b[0])];
  const [aa, bb, ab, ar, br] = [dot(da, da), dot(db, db), dot(da, db), dot(da, r), dot(db, r)];
  const flat = aa * bb - ab * ab;
  let s = flat > 1e-15 ? clamped((ab * br - ar * bb) / flat, 0, 1) : 0;
  let t = bb > 1e-15 ? (ab * s + br) / bb : 0;
  if (t < 0 || t > 1 || bb <= 1e-15) {
    t = clamped(t, 0, 1);
    s = aa > 1e-15 ? clamped((ab * t - ar) / aa, 0, 1) : 0;
  }
  return [plus(a[0], da, s), plus(b[0], db, t)];
}

export interface Distance {
  from: Vector;
  to: Vector;
  metres: number; // below zero where they overlap
}

// Of two arms by their capsules, with what they hold where their progress is known; null: there are none.
export function distanceOf(one: Arm, other: Arm, places: Place[], progress: number[] | null): Distance | null {
  const bodies = (arm: Arm, come: number | undefined) => [...arm.capsules, ...arm.held.filter(({ begins, until }) => come !== undefined && come >= begins && come < until)];
  const ends = ({ frame, from, to }: Capsule): [Vector, Vector] => [moved(places[frame]!, from), moved(places[frame]!, to)];
  const theirs = bodies(other, progress?.[1]).map((capsule) => ({ radius: capsule.radius, ends: ends(capsule) }));
  let best: Distance | null = null;
  for (const mine of bodies(one, progress?.[0])) {
    const line = ends(mine);
    for (const { radius, ends: there } of theirs) {
      const [p, q] = nearest(line, there);
      const apart = gap(p, q);
      const metres = apart - mine.radius - radius;
      if (best && metres >= best.metres) continue;
      const along = apart > 1e-9 ? plus([0, 0, 0], minus(q, p), 1 / apart) : ([0, 0, 0] as Vector);
      best = { from: plus(p, along, mine.radius), to: plus(q, along, -radius), metres };
    }
  }
  return best;
}

// Where tools have been since the program began; points that lie closer than the eye sees are left out.
const FINE_M = 0.004;
const MOST_POINTS = 4_000;

export class Trails {
  private program = '';
  private trails: Vector[][] = [];

  // Grows by where the tools are now; `tools` null: that is not known.
  of(program: string, tools: Vector[] | null): readonly Vector[][] {
    if (program !== this.program) {
      this.program = program;
      this.trails = [];
    }
    tools?.forEach((tool, arm) => {
      const trail = (this.trails[arm] ??= []);
      const last = trail.at(-1);
      if (last && gap(last, tool) < FINE_M) return;
      trail.push(tool);
      if (trail.length > MOST_POINTS) trail.splice(0, trail.length - MOST_POINTS);
    });
    return this.trails;
  }
}

// A way, cut where the arm is.
export function splitWay(arm: Arm, progress: number): { behind: Vector[]; ahead: Vector[] } {
  const next = arm.way.findIndex((point) => point.progress > progress);
  if (next < 0) return { behind: arm.way.map(({ at }) => at), ahead: [] };
  const [from, to] = [arm.way[Math.max(0, next - 1)]!, arm.way[next]!];
  const span = to.progress - from.progress;
  const here = plus(from.at, minus(to.at, from.at), span > 1e-9 ? clamped((progress - from.progress) / span, 0, 1) : 0);
  return { behind: [...arm.way.slice(0, next).map(({ at }) => at), here], ahead: [here, ...arm.way.slice(next).map(({ at }) => at)] };
}

export interface SeenThing {
  name: string;
  at: Vector;
}

export function seenThings(picture: ArmsPicture, known: Known): SeenThing[] {
  return picture.seen.flatMap(({ kind, x, y, z }) => {
    const which = kind === '' ? null : known(kind);
    if (which === null || which === 0) return [];
    return [{ name: picture.kinds.get(which) ?? String(which), at: [valueOf(x, known), valueOf(y, known), valueOf(z, known)] as Vector }];
  });
}

// The cause of a stop, and of which arm; null: it was not stopped.
export function stopOf(picture: ArmsPicture, known: Known): { cause: string; arm: string } | null {
  const cause = picture.cause === '' ? null : known(picture.cause);
  if (cause === null || cause === 0) return null;
  const arm = picture.causeArm === '' ? 0 : (known(picture.causeArm) ?? 0);
  return { cause: picture.causes[cause] ?? String(cause), arm: picture.arms[arm - 1]?.name ?? '' };
}

// All variables that the picture is drawn with.
export function variablesOf(picture: ArmsPicture): string[] {
  const readings = [
    ...picture.frames.map(({ value }) => value),
    ...picture.arms.map(({ opening }) => opening),
    ...picture.seen.flatMap(({ x, y, z, yaw }) => [x, y, z, yaw]),
  ];
  const names = [
    ...readings.map(({ variable }) => variable),
    ...picture.arms.flatMap(({ progress, waiting, grasped, standing, error }) => [progress, waiting, grasped, standing, error]),
    ...picture.seen.map(({ kind }) => kind),
    picture.distance, picture.cause, picture.causeArm,
  ];
  return [...new Set(names.filter((name) => name !== ''))];
}
