// What the panels of a fleet share: the vehicles with what is known of each, and which of them is selected.

import { untrack } from 'svelte';

import type { Cell } from '../lib/cell.svelte';
import type { Forklift, Value } from '../lib/protocol';
import { chartRanges } from '../sfc/parts';
import { readFleet, readRoutes, type Section } from './document';
import { areaData, placeAt, wayData } from './geometry';
import { Poses, type Pose } from './poses';
import { progressOf, tagsOfProgress, type Progress } from './progress';
import { joined, type FleetVehicle } from './vehicles';
import { t } from './texts';
import { errorText, isAbnormal } from './words';

const NO_PROGRESS: Progress = { left: 0, heldTo: -1, arcM: null, permittedM: null, step: '' };
const STANDS_M_S = 0.03;
// What is read or drawn large changes no more often than this, however fast the cell runs.
const BEAT_MS = 250;
const SLOW_BEAT_MS = 500; // of many vehicles
const MANY = 8;

const errorTag = (one: FleetVehicle) => `vehicle_${one.variable}.errorid`.toLowerCase();

export class Fleet {
  // Name of a vehicle; empty: none.
  selected = $state('');
  private readonly cell: Cell;
  private readonly poses = new Poses();

  constructor(cell: Cell) {
    this.cell = cell;
  }

  readonly forklifts = $derived.by((): Forklift[] => this.cell.hello?.synoptic.floor.forklifts ?? []);
  readonly news = $derived.by(() => readFleet(this.cell.plan?.fleet));
  readonly routes = $derived.by(() => readRoutes(this.cell.routes));
  readonly vehicles = $derived.by(() => joined(this.forklifts, this.news, this.routes));
  readonly chosen = $derived.by(() => this.vehicles.find(({ name }) => name === this.selected) ?? null);
  // Of another program they would be progress on other ways.
  private readonly ours = $derived.by(() => {
    const digest = this.cell.plan?.program_digest ?? '';
    return digest === '' || digest === this.cell.live.program;
  });
  private readonly charts = $derived.by(() => (this.cell.program ? chartRanges(this.cell.program) : []));
  private readonly beat = $derived.by(() => Math.floor((this.cell.heardAt?.getTime() ?? 0) / (this.forklifts.length > MANY ? SLOW_BEAT_MS : BEAT_MS)));
  readonly time = $derived.by(() => {
    void this.beat;
    return untrack(() => this.cell.live.time_s);
  });
  readonly progress = $derived.by(() => {
    void this.beat;
    const { vehicles, charts, ours } = this;
    return untrack(() => {
      const tag = (name: string) => (ours ? this.cell.tag(name) : null);
      const steps = ours ? this.cell.live.steps : [];
      return new Map(vehicles.map((one) => [one.name, progressOf(one, this.cell.program, charts, steps, tag)]));
    });
  });
  private readonly errors = $derived.by(() => {
    void this.beat;
    const { vehicles, ours } = this;
    const tag = (one: FleetVehicle) => (ours ? this.cell.tag(errorTag(one)) : null);
    return untrack(() => new Map(vehicles.map((one) => [one.name, tag(one) || (one.news?.error ?? 0)])));
  });
  private readonly speeds = $derived.by(() => {
    void this.beat;
    const { vehicles } = this;
    return untrack(() => new Map(vehicles.map((one) => [one.name, this.value(one.forklift?.speed)])));
  });
  readonly now = $derived.by(() => new Map(this.vehicles.map((one) => [one.name, this.poseOf(one)])));

  // Drawings, which change with the plan only.
  readonly polygonData = $derived.by(
    () => new Map(this.routes.polygons.map((one) => [one.vehicle, one.polygons.map(({ corners }) => areaData(corners))])),
  );
  readonly wayData = $derived.by(() => new Map(this.routes.paths.map((path) => [path.vehicle, wayData(path.poses)])));
  readonly places = $derived.by(() => {
    const places = new Map<string, FloorPlace>();
    for (const path of this.routes.paths) {
      path.stops.forEach((stop, index) => {
        const at = placeAt(path, stop.arcM);
        if (!at) return;
        const name = stop.location || t('stopOf', { number: index + 1, vehicle: path.vehicle });
        const place = places.get(name) ?? { name, x: at.x, y: at.y, visits: [] };
        place.visits.push({ vehicle: path.vehicle, stop: index, kind: stop.kind, goal: stop.goal });
        places.set(name, place);
      });
    }
    return [...places.values()];
  });

  // The tags that all this is made of.
  readonly shownTags = $derived.by(() =>
    this.vehicles.flatMap((one) => [...tagsOfProgress(one), errorTag(one)]).map((name) => this.cell.tagNumber(name)).filter((tag) => tag >= 0),
  );

  private poseOf(vehicle: FleetVehicle): Pose | null {
    return vehicle.forklift ? this.poses.of(vehicle.forklift, (id) => this.cell.point(id)) : null;
  }

  progressOf(vehicle: FleetVehicle): Progress {
    return this.progress.get(vehicle.name) ?? NO_PROGRESS;
  }

  // By the program at once, and by the supervisor once it has said so.
  errorOf(vehicle: FleetVehicle): number {
    return this.errors.get(vehicle.name) ?? 0;
  }

  speedOf(vehicle: FleetVehicle): Value {
    return this.speeds.get(vehicle.name) ?? null;
  }

  stateOf(vehicle: FleetVehicle): string {
    const state = vehicle.news?.state ?? '';
    if (this.errorOf(vehicle) !== 0 && !isAbnormal(state)) return 'stopped';
    if (state !== '') return state;
    const speed = this.speedOf(vehicle);
    return speed === null ? '' : Math.abs(speed) > STANDS_M_S ? 'driving' : 'resting';
  }

  // Why a vehicle is lost or has stopped.
  reasonOf(vehicle: FleetVehicle): string {
    return vehicle.news?.reason || errorText(this.errorOf(vehicle));
  }

  // The supervisor speaks English.
  reasonLanguage(vehicle: FleetVehicle): 'en' | undefined {
    return vehicle.news?.reason ? 'en' : undefined;
  }

  isWaiting(vehicle: FleetVehicle): boolean {
    return vehicle.news?.waitsFor !== '' && this.stateOf(vehicle) === 'waiting';
  }

  named(name: string): FleetVehicle | null {
    return this.vehicles.find((one) => one.name === name) ?? null;
  }

  value(point: string | undefined): Value {
    return point ? this.cell.point(point) : null;
  }

  // Something that is shown of the vehicle.
  isForced({ forklift }: FleetVehicle): boolean {
    if (!forklift) return false;
    const { x, y, heading, speed, lock, loaded, bumper, enable, lift } = forklift;
    return [x, y, heading, speed, lock, loaded, bumper, enable, lift].some((point) => this.isPointForced(point));
  }

  isPointForced(point: string | undefined): boolean {
    return point !== undefined && this.cell.forcedPoints.has(point);
  }

  // A section that its first vehicle has left behind keeps nobody waiting any more.
  isAhead(section: Section): boolean {
    const [first, second] = section.order;
    const last = (name: string) =>
      Math.max(-1, ...section.polygons.filter(({ vehicle }) => vehicle === name).map(({ polygon }) => polygon));
    const left = (name: string) => this.progress.get(name)?.left ?? 0;
    return left(first) <= last(first) && left(second) <= last(second);
  }

  toggle(name: string): void {
    this.selected = this.selected === name ? '' : name;
  }
}

export interface FloorPlace {
  name: string;
  x: number;
  y: number;
  visits: { vehicle: string; stop: number; kind: string; goal: string }[];
}
