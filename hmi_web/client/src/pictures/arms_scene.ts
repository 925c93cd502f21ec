// The solids of a cell of arms, ready to be drawn: their faces once, then where they are and from where somebody looks.

import type { ArmsPicture } from './arms_document';
import type { ThingPlace } from './arms';
import { axesOf, type Orbit } from './orbit';
import { pixelOf, type Raster } from './raster';
import { facesOf, type Faces } from './solids';
import { dot, moved, STILL, turned, type Place, type Vector } from './space';

export type Colour = readonly [red: number, green: number, blue: number];

export interface Palette {
  background: Colour;
  fixed: Colour; // what stands for good
  arms: Colour[];
  thing: Colour;
  held: Colour;
  edge: Colour;
}

interface Part {
  faces: Faces;
  frame: number; // of the picture; -1: the cell
  thing: number; // -1: none
  arm: number;
  owner: number;
}

const LIGHT: Vector = [-0.35, 0.55, 0.76]; // to the left, above, in front of the picture
const DARKEST = 0.55;
const MOST_CORNERS = 64;

export class ArmsScene {
  private readonly parts: Part[] = [];
  private xs: Float64Array = new Float64Array(1_024); // of a part's points
  private ys: Float64Array = new Float64Array(1_024);
  private zs: Float64Array = new Float64Array(1_024);
  private readonly faceX = new Float64Array(MOST_CORNERS);
  private readonly faceY = new Float64Array(MOST_CORNERS);
  private readonly faceZ = new Float64Array(MOST_CORNERS);

  constructor(private readonly picture: ArmsPicture) {
    let owner = 0;
    for (const body of picture.bodies) this.add(body.solids, -1, -1, -1, ++owner);
    picture.frames.forEach((frame, index) => this.add(frame.solids, index, -1, frame.arm, ++owner));
    picture.things.forEach((thing, index) => this.add(thing.solids, -1, index, -1, ++owner));
  }

  get faceCount(): number {
    return this.parts.reduce((sum, { faces }) => sum + faces.faces.length, 0);
  }

  // What a view of the cell has to show: all but things, which stand on it or are held.
  outline(places: Place[]): Vector[] {
    const solids = this.parts.filter(({ thing }) => thing < 0).flatMap(({ faces, frame }) => faces.points.map((point) => moved(places[frame] ?? STILL, point)));
    return [...solids, ...this.picture.arms.flatMap(({ way }) => way.map(({ at }) => at))];
  }

  // `pixels`: of the raster for one of `orbit`.
  draw(raster: Raster, orbit: Orbit, pixels: number, places: Place[], things: ThingPlace[], palette: Palette): void {
    raster.clear(pixelOf(...palette.background));
    for (const part of this.parts) {
      const thing = things[part.thing];
      const place = thing ? thing.place : (places[part.frame] ?? STILL);
      const colour = thing ? (thing.holder >= 0 ? palette.held : palette.thing) : (palette.arms[part.arm] ?? palette.fixed);
      this.project(part.faces.points, place, orbit, pixels, raster);
      for (const face of part.faces.faces) this.face(raster, face, pixels * orbit.scale, colour, part.owner);
    }
    raster.outline(pixelOf(...palette.edge));
  }

  private add(solids: Parameters<typeof facesOf>[0][], frame: number, thing: number, arm: number, owner: number): void {
    for (const solid of solids) this.parts.push({ faces: facesOf(solid), frame, thing, arm, owner });
  }

  private project(points: Vector[], place: Place, orbit: Orbit, pixels: number, raster: Raster): void {
    if (points.length > this.xs.length) [this.xs, this.ys, this.zs] = [0, 1, 2].map(() => new Float64Array(points.length)) as [Float64Array, Float64Array, Float64Array];
    const { xs, ys, zs } = this;
    const { right, up, towards } = axesOf(orbit);
    const scale = orbit.scale * pixels;
    // The view's axes in the part's own frame.
    const back = (axis: Vector) => turned([place.rows[0]!, place.rows[3]!, place.rows[6]!, place.rows[1]!, place.rows[4]!, place.rows[7]!, place.rows[2]!, place.rows[5]!, place.rows[8]!], axis);
    const [r, u, t] = [back(right), back(up), back(towards)];
    const off: Vector = [place.at[0] - orbit.centre[0], place.at[1] - orbit.centre[1], place.at[2] - orbit.centre[2]];
    const [x0, y0, z0] = [raster.width / 2 + scale * dot(right, off), raster.height / 2 - scale * dot(up, off), dot(towards, off)];
    for (let k = 0; k < points.length; k++) {
      const [x, y, z] = points[k]!;
      xs[k] = x0 + scale * (r[0] * x + r[1] * y + r[2] * z);
      ys[k] = y0 - scale * (u[0] * x + u[1] * y + u[2] * z);
      zs[k] = z0 + t[0] * x + t[1] * y + t[2] * z;
    }
  }

  // `scale`: pixels for a metre.
  private face(raster: Raster, face: number[], scale: number, colour: Colour, owner: number): void {
    const { xs, ys, zs, faceX, faceY, faceZ } = this;
    const count = Math.min(face.length, MOST_CORNERS);
    // Newell's normal, in metres: to the right, up, towards who looks.
    let [nx, ny, nz] = [0, 0, 0];
    for (let k = 0, before = face[count - 1]!; k < count; before = face[k]!, k++) {
      const here = face[k]!;
      const [ax, ay, bx, by] = [xs[before]! / scale, -ys[before]! / scale, xs[here]! / scale, -ys[here]! / scale];
      nx += (ay - by) * (zs[before]! + zs[here]!);
      ny += (zs[before]! - zs[here]!) * (ax + bx);
      nz += (ax - bx) * (ay + by);
      faceX[k] = xs[here]!;
      faceY[k] = ys[here]!;
      faceZ[k] = zs[here]!;
    }
    if (nz <= 1e-12) return;
    const length = Math.hypot(nx, ny, nz);
    const light = Math.max(0, (nx * LIGHT[0] + ny * LIGHT[1] + nz * LIGHT[2]) / length);
    const bright = DARKEST + (1.08 - DARKEST) * light;
    const part = (value: number) => Math.min(255, Math.round(value * bright));
    raster.face(faceX, faceY, faceZ, count, [-nx / nz / scale, ny / nz / scale], pixelOf(part(colour[0]), part(colour[1]), part(colour[2])), owner);
  }
}
