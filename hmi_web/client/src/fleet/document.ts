// The fleet's part of the plan document, read with doubt: what is missing, of the wrong kind or nowhere near a floor
// is left out, and the rest is shown. hmi_web/doc/protocol.md, messages `plan` and `routes`.

import { fieldsOf, listOf, numberOf, textOf, type Fields } from '../lib/doubt';

export type Pair = [number, number]; // x, y in m

export interface VehicleNews {
  vehicle: string;
  variable: string; // as it stands in names of variables
  state: string;
  waitsFor: string;
  delayMs: number | null;
  arrivesMs: number | null; // clock of the schedule
  stopsDone: number;
  error: number;
  reason: string;
  outline: Pair[]; // around the reference point, heading 0
}

export interface GoalNews {
  name: string;
  from: string;
  to: string;
  amount: number;
  delivered: number;
  state: string;
  dueMs: number | null; // clock of the run's first schedule
  late: boolean;
  reason: string; // why it was given up
  vehicle: string;
}

export interface Wait {
  vehicle: string;
  for: string;
  fromMs: number;
  untilMs: number;
}

export interface FleetNews {
  epochS: number; // scan clock at time 0 of the schedule
  firstEpochS: number; // at time 0 of the run's first one
  vehicles: VehicleNews[];
  goals: GoalNews[];
  waits: Wait[];
  blocked: { name: string; area: Pair[] }[];
  makespanMs: number | null;
}

export interface Stop {
  kind: string;
  location: string;
  goal: string;
  amount: number;
  arcM: number;
  serviceMs: number;
  polygon: number;
  endMs: number | null;
}

export interface RoutePath {
  vehicle: string;
  lengthM: number;
  stops: Stop[];
  poses: [number, number, number][]; // m, m, degrees
}

export interface RoutePolygon {
  corners: Pair[]; // fewer than three: nothing to draw
  entryMs: number | null;
  exitMs: number | null;
}

export interface Section {
  polygons: { vehicle: string; polygon: number }[];
  areas: Pair[][];
  order: [string, string]; // who goes first, who waits
}

export interface Routes {
  paths: RoutePath[];
  polygons: { vehicle: string; polygons: RoutePolygon[] }[];
  sections: Section[];
}

// No floor reaches so far; coordinates beyond are mistakes, and would shrink everything else to a dot.
const FARTHEST_M = 10_000;

const members = (value: unknown): Fields => fieldsOf(value) ?? {};

function count(value: unknown): number {
  return Math.max(0, Math.round(numberOf(value) ?? 0));
}

export function place(value: unknown): Pair | null {
  const [x, y] = listOf(value).map(numberOf);
  if (typeof x !== 'number' || typeof y !== 'number') return null;
  return Math.abs(x) <= FARTHEST_M && Math.abs(y) <= FARTHEST_M ? [x, y] : null;
}

// All of its corners, or none: an outline without one of them would be another one.
export function outline(value: unknown): Pair[] {
  const corners = listOf(value).map(place);
  return corners.length >= 3 && corners.every((corner) => corner !== null) ? (corners as Pair[]) : [];
}

function vehicleNews(value: unknown): VehicleNews[] {
  const from = members(value);
  const vehicle = textOf(from.vehicle);
  if (vehicle === '') return [];
  return [
    {
      vehicle,
      variable: textOf(from.variable) || vehicle,
      state: textOf(from.state),
      waitsFor: textOf(from.waits_for),
      delayMs: numberOf(from.delay_ms),
      arrivesMs: numberOf(from.arrives_ms),
      stopsDone: count(from.stops_done),
      error: count(from.error),
      reason: textOf(from.reason),
      outline: outline(from.outline_m),
    },
  ];
}

function goalNews(value: unknown): GoalNews[] {
  const from = members(value);
  const name = textOf(from.name);
  if (name === '') return [];
  return [
    {
      name,
      from: textOf(from.from),
      to: textOf(from.to),
      amount: count(from.amount),
      delivered: count(from.delivered),
      state: textOf(from.state),
      dueMs: numberOf(from.due_ms),
      late: from.late === true,
      reason: textOf(from.reason),
      vehicle: textOf(from.vehicle),
    },
  ];
}

function wait(value: unknown): Wait[] {
  const from = members(value);
  const begin = numberOf(from.from_ms);
  const end = numberOf(from.until_ms);
  if (begin === null || end === null || end < begin) return [];
  return [{ vehicle: textOf(from.vehicle), for: textOf(from.for), fromMs: begin, untilMs: end }];
}

function blockedPlace(value: unknown): { name: string; area: Pair[] }[] {
  const from = members(value);
  const area = outline(from.corners_m);
  return area.length > 0 ? [{ name: textOf(from.name), area }] : [];
}

// Null if the document is not about a fleet.
export function readFleet(value: unknown): FleetNews | null {
  const from = fieldsOf(value);
  if (!from) return null;
  return {
    epochS: numberOf(from.epoch_s) ?? 0,
    firstEpochS: numberOf(from.first_epoch_s) ?? numberOf(from.epoch_s) ?? 0,
    vehicles: unique(listOf(from.vehicles).flatMap(vehicleNews), (news) => news.vehicle),
    goals: unique(listOf(from.goals).flatMap(goalNews), (goal) => goal.name),
    waits: listOf(from.waits).flatMap(wait),
    blocked: listOf(from.blocked).flatMap(blockedPlace),
    makespanMs: numberOf(from.makespan_ms),
  };
}

function unique<T>(items: T[], nameOf: (item: T) => string): T[] {
  return [...new Map(items.map((item) => [nameOf(item), item])).values()];
}

function stop(value: unknown): Stop[] {
  const from = members(value);
  const arcM = numberOf(from.arc_m);
  if (arcM === null) return [];
  return [
    {
      kind: textOf(from.kind),
      location: textOf(from.location),
      goal: textOf(from.goal),
      amount: count(from.amount),
      arcM,
      serviceMs: numberOf(from.service_ms) ?? 0,
      polygon: count(from.polygon),
      endMs: numberOf(from.end_ms),
    },
  ];
}

function pose(value: unknown): [number, number, number][] {
  const at = place(value);
  return at ? [[at[0], at[1], numberOf(listOf(value)[2]) ?? 0]] : [];
}

function path(value: unknown): RoutePath {
  const from = members(value);
  return {
    vehicle: textOf(from.vehicle),
    lengthM: Math.max(0, numberOf(from.length_m) ?? 0),
    stops: listOf(from.stops).flatMap(stop),
    poses: listOf(from.poses_m_m_deg).flatMap(pose),
  };
}

// A polygon keeps its number, even where there is nothing to draw.
function polygon(value: unknown): RoutePolygon {
  const from = members(value);
  const [entry, exit] = listOf(from.earliest_ms).map(numberOf);
  return { corners: outline(from.corners_m), entryMs: entry ?? null, exitMs: exit ?? null };
}

// One outline, or a list of them.
function areas(value: unknown): Pair[][] {
  const whole = outline(value);
  return whole.length > 0 ? [whole] : listOf(value).map(outline).filter((area) => area.length > 0);
}

function section(value: unknown): Section[] {
  const from = members(value);
  const [first, second] = listOf(from.order).map(textOf);
  if (!first || !second) return [];
  const polygons = listOf(from.polygons).map((one) => ({
    vehicle: textOf(members(one).vehicle),
    polygon: count(members(one).polygon),
  }));
  return [{ polygons, areas: areas(from.corners_m), order: [first, second] }];
}

export function readRoutes(value: unknown): Routes {
  const from = members(value);
  return {
    paths: listOf(from.paths).map(path),
    polygons: listOf(from.polygons).map((one) => ({
      vehicle: textOf(members(one).vehicle),
      polygons: listOf(members(one).polygons).map(polygon),
    })),
    sections: listOf(from.sections).flatMap(section),
  };
}
