// Where everything of the plant stands in a drawing of a given width, computed from its description alone:
// places along the track from left to right, tanks above and below it, vehicles on it, pipes between them.
// Lengths are pixels: text keeps its size on a narrow screen and the plant moves together.

import type { Pipe, Place, SynopticDescription, Tank, Vehicle } from '../lib/protocol';

export interface PlacedTank {
  tank: Tank;
  x: number; // of its left edge
  y: number; // of its top
  width: number;
  height: number;
}

export interface PlacedPipe {
  pipe: Pipe;
  path: string; // SVG path data, in the direction of the flow
}

export interface PlacedPump {
  id: string;
  x: number;
  y: number;
}

export interface SynopticDrawing {
  width: number;
  height: number;
  trackY: number;
  trackFrom: number;
  trackTo: number;
  toX(position: number): number;
  places: { place: Place; x: number }[];
  tanks: PlacedTank[]; // those that stand still
  vehicles: { vehicle: Vehicle; tank: Tank | undefined; width: number; height: number; y: number }[];
  pipes: PlacedPipe[]; // between tanks that stand still, or into and out of a vehicle at its place
  pumps: PlacedPump[]; // those that stand still
  aboard: string[]; // pumps that ride on a vehicle
}

export const WHEEL = 9;
const TOP = 22; // room for the labels of the upper tanks
const TANK_HEIGHT = 96;
const PUMP_ROOM = 58;
const VEHICLE_HEIGHT = 84;
const SPOUT_ROOM = 52;
const RETURN_ROOM = 64;

// False: there is nothing to draw.
export function isDescribed(description: SynopticDescription | undefined): boolean {
  return description !== undefined && (description.places.length > 0 || description.belts.length > 0);
}

export function layOut(description: SynopticDescription, width: number): SynopticDrawing {
  const tankWidth = Math.min(124, Math.max(70, width / 6.5));
  const hasUpper = description.tanks.some((tank) => tank.side === 'above');
  const hasLower = description.tanks.some((tank) => tank.side === 'below');
  const upperY = TOP;
  const vehicleY = hasUpper ? upperY + TANK_HEIGHT + PUMP_ROOM : TOP;
  const trackY = vehicleY + VEHICLE_HEIGHT + 2 * WHEEL;
  const lowerY = trackY + SPOUT_ROOM;
  const height = hasLower ? lowerY + TANK_HEIGHT + RETURN_ROOM : trackY + 34;

  const margin = tankWidth / 2 + 44;
  const positions = description.places.map((place) => place.position);
  const low = Math.min(...positions);
  const span = Math.max(...positions) - low || 1;
  const toX = (position: number) => margin + ((position - low) / span) * (width - 2 * margin);

  const drawing: SynopticDrawing = {
    width,
    height,
    trackY,
    trackFrom: margin - tankWidth / 2 - 12,
    trackTo: width - margin + tankWidth / 2 + 12,
    toX,
    places: description.places.map((place) => ({ place, x: toX(place.position) })),
    tanks: [],
    vehicles: [],
    pipes: [],
    pumps: [],
    aboard: [],
  };
  for (const tank of description.tanks) {
    const place = description.places.find((candidate) => candidate.id === tank.at);
    if (tank.side === 'vehicle' || !place) continue;
    const y = tank.side === 'above' ? upperY : lowerY;
    drawing.tanks.push({ tank, x: toX(place.position) - tankWidth / 2, y, width: tankWidth, height: TANK_HEIGHT });
  }
  for (const vehicle of description.vehicles) {
    const tank = description.tanks.find((candidate) => candidate.side === 'vehicle' && candidate.at === vehicle.id);
    drawing.vehicles.push({ vehicle, tank, width: tankWidth + 10, height: VEHICLE_HEIGHT, y: vehicleY });
  }
  routePipes(description, drawing);
  return drawing;
}

function routePipes(description: SynopticDescription, drawing: SynopticDrawing): void {
  const standing = (id: string) => drawing.tanks.find((placed) => placed.tank.id === id);
  for (const pipe of description.pipes) {
    const from = standing(pipe.from);
    const to = standing(pipe.to);
    if (from && to) connectStanding(drawing, pipe, from, to);
    else if (from) fillVehicle(drawing, pipe, from);
    else if (to) emptyVehicle(drawing, pipe, to);
  }
}

// Straight down from an upper tank through its pump.
function fillVehicle(drawing: SynopticDrawing, pipe: Pipe, from: PlacedTank): void {
  const x = from.x + from.width / 2;
  const top = from.y + from.height;
  drawing.pipes.push({ pipe, path: `M${x} ${top}V${top + PUMP_ROOM - 12}` });
  addPump(drawing, pipe.pump, x, top + PUMP_ROOM / 2 - 6);
}

// Down from the vehicle, whose pump rides along, into the tank below the track.
function emptyVehicle(drawing: SynopticDrawing, pipe: Pipe, to: PlacedTank): void {
  const x = to.x + to.width / 2;
  drawing.pipes.push({ pipe, path: `M${x} ${drawing.trackY + 6}V${to.y + 8}` });
  if (pipe.pump && !drawing.aboard.includes(pipe.pump)) drawing.aboard.push(pipe.pump);
}

// Out at the bottom, along the lower edge to the nearer side, up there and into the other tank from above.
function connectStanding(drawing: SynopticDrawing, pipe: Pipe, from: PlacedTank, to: PlacedTank): void {
  const x = from.x + from.width / 2;
  const bottom = from.y + from.height;
  const lane = drawing.height - 16;
  const onLeft = x < drawing.width / 2;
  const side = onLeft ? 14 : drawing.width - 14;
  const inlet = to.x + to.width / 2 + (onLeft ? -to.width / 4 : to.width / 4);
  drawing.pipes.push({ pipe, path: `M${x} ${bottom}V${lane}H${side}V8H${inlet}V${to.y + 8}` });
  addPump(drawing, pipe.pump, x, bottom + (lane - bottom) / 2 - 4);
}

function addPump(drawing: SynopticDrawing, id: string, x: number, y: number): void {
  if (id && !drawing.pumps.some((pump) => pump.id === id)) drawing.pumps.push({ id, x, y });
}
