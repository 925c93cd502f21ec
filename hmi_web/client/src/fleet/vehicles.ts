// The vehicles as the page shows them: those of the plant with what the plan says of them, and those of the plan that
// the plant does not have.

import type { Forklift } from '../lib/protocol';
import type { FleetNews, Pair, RoutePath, RoutePolygon, Routes, VehicleNews } from './document';

export interface FleetVehicle {
  name: string; // the plan's, or the plant's
  variable: string; // in names of variables of the program
  forklift: Forklift | null;
  news: VehicleNews | null;
  path: RoutePath | null;
  polygons: RoutePolygon[];
}

export interface Body {
  front: number; // m, from the reference point
  rear: number;
  half: number; // of the width
  wheelbase: number;
  outline: Pair[];
}

// Names in the program have letters, digits and underscores only.
export function identifier(name: string): string {
  return name.toLowerCase().replace(/[^a-z0-9_]/g, '_');
}

// By name; a plan that names its vehicles otherwise means those of the plant in their order.
export function joined(forklifts: Forklift[], news: FleetNews | null, routes: Routes): FleetVehicle[] {
  const names = news?.vehicles.map((one) => one.vehicle) ?? routes.paths.map((path) => path.vehicle);
  const newsOf = new Map(news?.vehicles.map((one) => [one.vehicle, one]) ?? []);
  const called = new Map(forklifts.map((forklift) => [identifier(forklift.id), forklift]));
  const named = (name: string) => called.get(identifier(name)) ?? called.get(identifier(newsOf.get(name)?.variable ?? ''));
  const inOrder = !names.some(named);
  const planned = names.filter((name) => name !== '').map((name, index) => {
    const forklift = (inOrder ? forklifts[index] : named(name)) ?? null;
    return vehicle(name, forklift, newsOf.get(name) ?? null, routes);
  });
  const taken = new Set(planned.map((one) => one.forklift?.id));
  const others = forklifts
    .filter((forklift) => !taken.has(forklift.id))
    .map((forklift) => vehicle(forklift.label || forklift.id, forklift, null, routes));
  return [...planned, ...others];
}

function vehicle(name: string, forklift: Forklift | null, news: VehicleNews | null, routes: Routes): FleetVehicle {
  return {
    name,
    variable: identifier(news?.variable ?? name),
    forklift,
    news,
    path: routes.paths.find((path) => path.vehicle === name) ?? null,
    polygons: routes.polygons.find((one) => one.vehicle === name)?.polygons ?? [],
  };
}

// The default of the plant's forklift where nobody says anything.
const DEFAULT = { front: 1.6, rear: 2.4, half: 0.7, wheelbase: 1.9 };
const LONGEST_M = 50;

export function bodyOf({ forklift, news }: FleetVehicle): Body {
  const given = news?.outline ?? [];
  const fits = given.length >= 3 && given.every(([x, y]) => Math.abs(x) < LONGEST_M && Math.abs(y) < LONGEST_M);
  const body = {
    front: sound(forklift?.front, DEFAULT.front),
    rear: sound(forklift?.rear, DEFAULT.rear),
    half: sound(forklift?.width, 2 * DEFAULT.half) / 2,
    wheelbase: sound(forklift?.wheelbase, DEFAULT.wheelbase),
  };
  if (!fits || forklift) return { ...body, outline: box(body) };
  const front = Math.max(...given.map(([x]) => x));
  const rear = -Math.min(...given.map(([x]) => x));
  const half = Math.max(...given.map(([, y]) => Math.abs(y)));
  return { front, rear, half, wheelbase: Math.min(body.wheelbase, rear), outline: given };
}

function sound(value: number | undefined, otherwise: number): number {
  return typeof value === 'number' && value > 0 && value < LONGEST_M ? value : otherwise;
}

function box({ front, rear, half }: { front: number; rear: number; half: number }): Pair[] {
  return [
    [front, half],
    [-rear, half],
    [-rear, -half],
    [front, -half],
  ];
}
