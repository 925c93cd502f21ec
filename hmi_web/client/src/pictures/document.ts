// Pictures of a plan (supervisor/doc/pictures.md), read with doubt: what is missing, of the wrong kind or nowhere near a floor is
// left out, and the rest is drawn.

import { outline, place, type Pair } from '../fleet/document';
import { fieldsOf, listOf, numberOf, recordsOf, textOf, type Fields } from '../lib/doubt';
import { armsPicture, type ArmsPicture } from './arms_document';

export interface Area {
  name: string;
  corners: Pair[];
}

export interface Place extends Area {
  at: string; // variable: what moves is in it
  visited: boolean; // by an earlier plan of this run
}

export interface Swept {
  fromM: number;
  toM: number;
  outlines: Pair[][];
}

export interface WayPoint {
  x: number;
  y: number;
  arcM: number;
  reverse: boolean; // on the way to the next one
}

export interface Stop {
  places: string[];
  arcM: number;
  counts: boolean; // for the task
}

export interface Link {
  length: number;
  width: number;
  behind: number; // the one in front
  hitch: string; // variable: how far it is turned against the one in front, clockwise,
  hitchRad: number; // in so many radians
}

export interface Body {
  x: string;
  y: string;
  heading: string;
  coupled: string; // variable: how many links follow the first one; empty: all
  links: Link[];
}

export interface FloorPicture {
  kind: 'floor';
  id: string;
  program: string; // digest of the program whose way it is; empty: nothing is planned
  border: Pair[];
  walls: Area[];
  blocked: Area[];
  places: Place[];
  regions: Pair[][];
  earlier: Pair[][]; // swept by earlier plans
  swept: Swept[];
  way: WayPoint[];
  stops: Stop[];
  lengthM: number;
  coveredM: number; // when the picture was made
  progress: string; // variable: how far along the way
  body: Body;
  leftOut: string[];
}

export type Verdict = 'undecided' | 'done' | 'failed';

export interface TaskState {
  state: number;
  column: number;
  row: number;
  verdict: Verdict;
  left: number | null; // edges to the end
}

export interface TaskEdge {
  from: number;
  to: number;
  letters: string[][]; // any of them leads there: places that it is in together
}

export interface AutomatonPicture {
  kind: 'automaton';
  id: string;
  text: string;
  variable: string; // the state that holds now
  initial: number;
  planned: number[];
  states: TaskState[];
  edges: TaskEdge[];
  leftOut: number;
}

export type Picture = FloorPicture | AutomatonPicture | ArmsPicture;

const MOST_LINKS = 64;

const members = (value: unknown): Fields => fieldsOf(value) ?? {};
const positive = (value: unknown): number => Math.max(0, numberOf(value) ?? 0);
const count = (value: unknown): number | null => {
  const number = numberOf(value);
  return number !== null && Number.isInteger(number) && number >= 0 ? number : null;
};
const outlines = (value: unknown): Pair[][] => listOf(value).map(outline).filter((ring) => ring.length > 0);

function area(value: Fields): Area[] {
  const corners = outline(value.corners_m);
  return corners.length > 0 ? [{ name: textOf(value.name), corners }] : [];
}

function regions(value: unknown): Pair[][] {
  const from = members(value);
  const corners = listOf(from.corners_m).map(place);
  return listOf(from.triangles).flatMap((each) => {
    const ring = listOf(each).map((index) => corners[numberOf(index) ?? -1] ?? null);
    return ring.length === 3 && ring.every((corner) => corner !== null) ? [ring as Pair[]] : [];
  });
}

function wayPoint(value: unknown): WayPoint[] {
  const at = place(value);
  const [, , arcM, direction] = listOf(value).map(numberOf);
  return at && typeof arcM === 'number' ? [{ x: at[0], y: at[1], arcM, reverse: direction === -1 }] : [];
}

function stop(value: Fields): Stop[] {
  const arcM = numberOf(value.arc_m);
  const places = listOf(value.places).map(textOf).filter((name) => name !== '');
  return arcM === null || places.length === 0 ? [] : [{ places, arcM, counts: value.counts !== false }];
}

function body(value: unknown): Body {
  const from = members(value);
  const links = recordsOf(from.links).slice(0, MOST_LINKS).map((link) => ({
    length: positive(link.length_m),
    width: positive(link.width_m),
    behind: positive(link.behind_m),
    hitch: textOf(link.hitch),
    hitchRad: numberOf(link.hitch_rad) ?? 1,
  }));
  return { x: textOf(from.x), y: textOf(from.y), heading: textOf(from.heading), coupled: textOf(from.coupled), links };
}

function floorPicture(from: Fields, id: string): FloorPicture {
  return {
    kind: 'floor',
    id,
    program: textOf(from.program),
    border: outline(from.border_m),
    walls: recordsOf(from.walls).flatMap(area),
    blocked: recordsOf(from.blocked).flatMap(area),
    places: recordsOf(from.places).flatMap((one) =>
      area(one).map((found) => ({ ...found, at: textOf(one.at), visited: one.visited === true })),
    ),
    regions: regions(from.regions),
    earlier: outlines(from.earlier_m),
    swept: recordsOf(from.swept).map((one) => ({ fromM: positive(one.from_m), toM: positive(one.to_m), outlines: outlines(one.outlines_m) })),
    way: listOf(from.way).flatMap(wayPoint),
    stops: recordsOf(from.stops).flatMap(stop),
    lengthM: positive(from.length_m),
    coveredM: positive(from.covered_m),
    progress: textOf(from.progress),
    body: body(from.body),
    leftOut: listOf(from.left_out).map(textOf).filter((part) => part !== ''),
  };
}

const VERDICTS: readonly Verdict[] = ['undecided', 'done', 'failed'];

function taskState(from: Fields): TaskState[] {
  const state = count(from.state);
  const verdict = VERDICTS.find((one) => one === from.verdict) ?? 'undecided';
  return state === null ? [] : [{ state, column: count(from.column) ?? 0, row: positive(from.row), verdict, left: count(from.left) }];
}

function automatonPicture(from: Fields, id: string): AutomatonPicture {
  const states = recordsOf(from.states).flatMap(taskState);
  const known = new Set(states.map(({ state }) => state));
  const edges = recordsOf(from.edges).flatMap((edge) => {
    const [start, end] = [count(edge.from), count(edge.to)];
    if (start === null || end === null || !known.has(start) || !known.has(end) || start === end) return [];
    return [{ from: start, to: end, letters: listOf(edge.letters).map((names) => listOf(names).map(textOf)) }];
  });
  return {
    kind: 'automaton',
    id,
    text: textOf(from.text),
    variable: textOf(from.variable),
    initial: count(from.initial) ?? 0,
    planned: listOf(from.planned).map(count).filter((state) => state !== null && known.has(state)) as number[],
    states,
    edges,
    leftOut: count(from.left_out) ?? 0,
  };
}

// Those of a kind that this page draws, each of another name.
export function readPictures(value: unknown): Picture[] {
  const pictures = recordsOf(value).flatMap((from): Picture[] => {
    const id = textOf(from.id);
    if (from.kind === 'floor') return [floorPicture(from, id)];
    if (from.kind === 'arms') return [armsPicture(from, id)];
    return from.kind === 'automaton' ? [automatonPicture(from, id)] : [];
  });
  return [...new Map(pictures.map((picture) => [`${picture.kind} ${picture.id}`, picture])).values()];
}
