// Missions over time: when each vehicle is on its way, serves and waits, as planned; and when it is expected to end.

import { ticksOf, type Timeline } from '../plan/timeline';
import type { FleetNews } from './document';
import type { FleetVehicle } from './vehicles';

export interface Span {
  from: number; // s, clock of the cell
  to: number;
}

export interface MissionRow {
  name: string;
  mission: Span | null;
  services: (Span & { place: string })[];
  waits: (Span & { other: string })[];
  arrives: number | null;
}

export function rowsOf(vehicles: FleetVehicle[], news: FleetNews | null): MissionRow[] {
  const epoch = news?.epochS ?? 0;
  const s = (ms: number) => ms / 1_000 + epoch;
  return vehicles.map((vehicle) => {
    const entries = vehicle.polygons.flatMap(({ entryMs }) => (entryMs === null ? [] : [entryMs]));
    const exits = vehicle.polygons.flatMap(({ exitMs }) => (exitMs === null ? [] : [exitMs]));
    const arrives = vehicle.news?.arrivesMs ?? null;
    return {
      name: vehicle.name,
      mission: entries.length > 0 && exits.length > 0 ? { from: s(least(entries)), to: s(most(exits)) } : null,
      services: (vehicle.path?.stops ?? []).flatMap((stop) =>
        stop.endMs === null ? [] : [{ from: s(stop.endMs - stop.serviceMs), to: s(stop.endMs), place: stop.location }],
      ),
      waits: (news?.waits ?? [])
        .filter((wait) => wait.vehicle === vehicle.name)
        .map((wait) => ({ from: s(wait.fromMs), to: s(wait.untilMs), other: wait.for })),
      arrives: arrives === null ? null : s(arrives),
    };
  });
}

export function timeOf(rows: MissionRow[], now: number): Timeline | null {
  const spans = rows.flatMap(({ mission }) => (mission ? [mission] : []));
  if (spans.length === 0) return null;
  const from = least(spans.map((span) => span.from));
  const ends = [...spans.map((span) => span.to), ...rows.flatMap(({ arrives }) => (arrives === null ? [] : [arrives]))];
  const last = most(ends);
  // Time that goes on after the end does not push the missions together.
  const to = Math.max(from + 1, last, Math.min(now, last + 0.1 * (last - from)));
  return { from, to, ticks: ticksOf(from, to) };
}

function least(values: number[]): number {
  return values.reduce((best, value) => Math.min(best, value), Infinity);
}

function most(values: number[]): number {
  return values.reduce((best, value) => Math.max(best, value), -Infinity);
}
