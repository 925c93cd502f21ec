// How far each vehicle is on its way, by the program that runs: polygons left, polygons that it may be in.
// supervisor/doc/fleet_program.md.

import type { ProgramMessage, Value } from '../lib/protocol';
import { partNamed, type Part } from '../sfc/parts';
import type { FleetVehicle } from './vehicles';

export interface Progress {
  left: number; // polygons, from the first
  heldTo: number; // the last polygon that it may be in; below `left`: none
  arcM: number | null;
  permittedM: number | null;
  step: string; // of its chart
}

// A vehicle's chart is the program of this name.
export const CHART = 'mission_';

// The polygon up to which a step lets its vehicle drive, or in which it stands; null if the step says nothing of it.
export function polygonOfStep(step: string, vehicle: FleetVehicle): number | null {
  const driving = /^P(\d+)/.exec(step);
  if (driving) return Number(driving[1]);
  const standing = /^(?:FAILED_)?S(\d+)_/.exec(step);
  if (standing) return vehicle.path?.stops[Number(standing[1]) - 1]?.polygon ?? null;
  if (step === 'DONE') return vehicle.polygons.length - 1;
  return step === 'START' ? 0 : null;
}

const tagNames = ({ variable }: FleetVehicle) => ({
  areas: `areas_${variable}`.toLowerCase(),
  inside: `vehicle_${variable}.area`.toLowerCase(),
  arc: `arc_${variable}`.toLowerCase(),
  permitted: `permitted_${variable}`.toLowerCase(),
});

// The variables that progressOf asks for.
export const tagsOfProgress = (vehicle: FleetVehicle): string[] => Object.values(tagNames(vehicle));

// `tag` gives the value of a variable of the program by its name.
export function progressOf(
  vehicle: FleetVehicle,
  program: ProgramMessage | null,
  charts: Part[],
  activeSteps: number[],
  tag: (name: string) => Value,
): Progress {
  const { variable } = vehicle;
  const names = tagNames(vehicle);
  const areas = tag(names.areas);
  const left = Math.max(0, areas ?? 0);
  const chart = partNamed(charts, CHART + variable);
  const active = chart
    ? activeSteps.find((step) => step >= chart.firstStep && step < chart.firstStep + chart.steps)
    : undefined;
  const step = active === undefined ? '' : (program?.steps[active]?.name ?? '');
  const inside = tag(names.inside);
  const heldTo = polygonOfStep(step, vehicle) ?? Math.max(left, inside ?? left);
  return { left, heldTo: areas === null ? -1 : heldTo, arcM: tag(names.arc), permittedM: tag(names.permitted), step };
}
