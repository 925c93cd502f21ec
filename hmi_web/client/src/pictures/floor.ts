// What is drawn of a plan's floor at this moment: how far the way is covered, which places are visited, where the body is.

import type { Pair } from '../fleet/document';
import type { Value } from '../lib/protocol';
import type { Body, FloorPicture, Swept, WayPoint } from './document';

// An arc that falls by less is one that trembles; by more, that of the program before, which the first scan still shows.
const TREMBLES_M = 1;

// The last that was known of a way, while another program runs or the value is not known.
export class Covered {
  private program = '';
  private last = 0;

  // `arcM`: of the program whose way the picture has; null: that one does not run.
  of(picture: FloorPicture, arcM: Value): number {
    if (picture.program !== this.program) {
      this.program = picture.program;
      this.last = 0;
    }
    const trembles = arcM !== null && arcM < this.last && this.last - arcM < TREMBLES_M;
    const known = arcM === null || trembles ? Math.max(this.last, picture.coveredM) : arcM;
    this.last = Math.min(Math.max(known, 0), picture.lengthM);
    return this.last;
  }
}

// So many pieces, from the first, are behind the body.
export function piecesDriven(swept: Swept[], coveredM: number): number {
  const ahead = swept.findIndex(({ fromM, toM }) => (fromM + toM) / 2 > coveredM);
  return coveredM <= 0 ? 0 : ahead < 0 ? swept.length : ahead;
}

export interface WayPart {
  driven: boolean;
  reverse: boolean;
  points: Pair[];
}

function between(from: WayPoint, to: WayPoint, arcM: number): WayPoint {
  const length = to.arcM - from.arcM;
  const share = length > 0 ? Math.min(Math.max((arcM - from.arcM) / length, 0), 1) : 0;
  return { x: from.x + share * (to.x - from.x), y: from.y + share * (to.y - from.y), arcM, reverse: from.reverse };
}

// Cut where the body is and where it changes its direction.
export function wayParts(way: WayPoint[], coveredM: number): WayPart[] {
  const parts: WayPart[] = [];
  const add = (from: WayPoint, to: WayPoint, driven: boolean) => {
    const last = parts.at(-1);
    if (last && last.driven === driven && last.reverse === from.reverse) last.points.push([to.x, to.y]);
    else parts.push({ driven, reverse: from.reverse, points: [[from.x, from.y], [to.x, to.y]] });
  };
  way.slice(1).forEach((to, index) => {
    const from = way[index]!;
    if (to.arcM <= coveredM) add(from, to, true);
    else if (from.arcM >= coveredM) add(from, to, false);
    else {
      const here = between(from, to, coveredM);
      add(from, here, true);
      add(here, to, false);
    }
  });
  return parts;
}

export function pointAt(way: WayPoint[], arcM: number): Pair | null {
  const end = way.findIndex((point) => point.arcM >= arcM);
  const to = way[end < 0 ? way.length - 1 : end];
  if (!to) return null;
  const at = between(way[Math.max(0, end - 1)] ?? to, to, arcM);
  return end <= 0 ? [to.x, to.y] : [at.x, at.y];
}

// `through`: the way leads through it, which the task does not need; `off`: the way does not lead there; `open`: no way is planned.
export type StopState = 'done' | 'next' | 'ahead' | 'through' | 'off' | 'open';

export interface StopRow {
  number: number | null; // on the floor
  places: string[];
  arcM: number | null;
  state: StopState;
}

// Places that were visited before this plan, then those on its way, then the others.
export function stopRows(picture: FloorPicture, coveredM: number): StopRow[] {
  let counted = 0;
  let next = true;
  const rows = picture.stops.map(({ places, arcM, counts }): StopRow => {
    const reached = picture.program !== '' && arcM <= coveredM;
    const state: StopState = !counts ? 'through' : reached ? 'done' : next ? 'next' : 'ahead';
    if (state === 'next') next = false;
    return { number: counts ? ++counted : null, places, arcM, state };
  });
  const named = new Set(picture.stops.filter(({ counts }) => counts).flatMap(({ places }) => places));
  const met = new Set(picture.stops.flatMap(({ places }) => places));
  const row = (name: string, state: StopState): StopRow => ({ number: null, places: [name], arcM: null, state });
  const before = picture.places.filter(({ name, visited }) => visited && !named.has(name));
  const others = picture.places.filter(({ name, visited }) => !visited && !met.has(name));
  const rest = picture.program === '' ? 'open' : 'off';
  return [...before.map(({ name }) => row(name, 'done')), ...rows, ...others.map(({ name }) => row(name, rest))];
}

const ORDER: readonly StopState[] = ['next', 'ahead', 'done', 'through', 'open', 'off'];

// What a place looks like, of all that it has to do with the way.
export function stateOfPlace(rows: StopRow[], name: string): StopState {
  const states = rows.filter(({ places }) => places.includes(name)).map(({ state }) => state);
  return ORDER.find((state) => states.includes(state)) ?? 'off';
}

export interface LinkPose {
  x: number;
  y: number;
  headingRad: number;
  length: number;
  width: number;
}

// Each link behind the one in front, turned by its hitch. Empty where the pose is not known.
export function linkPoses(body: Body, value: (variable: string) => Value): LinkPose[] {
  const [x, y, heading] = [body.x, body.y, body.heading].map(value);
  const first = body.links[0];
  if (typeof x !== 'number' || typeof y !== 'number' || !first) return [];
  const behind = body.coupled === '' ? body.links.length : Math.round(value(body.coupled) ?? 0);
  const poses: LinkPose[] = [{ x, y, headingRad: heading ?? 0, length: first.length, width: first.width }];
  for (const link of body.links.slice(1, 1 + Math.max(0, behind))) {
    const front = poses.at(-1)!;
    const headingRad = front.headingRad - link.hitchRad * (value(link.hitch) ?? 0);
    poses.push({
      x: front.x - link.behind * Math.cos(headingRad),
      y: front.y - link.behind * Math.sin(headingRad),
      headingRad,
      length: link.length,
      width: link.width,
    });
  }
  return poses;
}

// All variables that the picture is drawn with.
export function variablesOf(picture: FloorPicture): string[] {
  const { body } = picture;
  const all = [picture.progress, body.x, body.y, body.heading, body.coupled, ...body.links.map(({ hitch }) => hitch), ...picture.places.map(({ at }) => at)];
  return [...new Set(all.filter((name) => name !== ''))];
}
