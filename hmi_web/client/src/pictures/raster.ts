// Flat convex faces into pixels, the nearest in front: a depth buffer in plain memory, which needs no graphics processor. Solids that
// reach into each other, as the parts of a joint do, come out right, which no order of whole faces can do.

export class Raster {
  readonly colours: Uint32Array;
  private readonly depths: Float32Array;
  private readonly owners: Uint16Array;
  private readonly left: Float32Array;
  private readonly right: Float32Array;

  // `bytes`: of an image, four for each pixel.
  constructor(readonly width: number, readonly height: number, bytes: ArrayBufferLike = new ArrayBuffer(4 * width * height)) {
    this.colours = new Uint32Array(bytes);
    this.depths = new Float32Array(width * height);
    this.owners = new Uint16Array(width * height);
    this.left = new Float32Array(height);
    this.right = new Float32Array(height);
  }

  clear(colour: number): void {
    this.colours.fill(colour);
    this.depths.fill(-Infinity);
    this.owners.fill(0);
  }

  // Corners in pixels, y downwards; depth grows towards who looks. `slope`: how the depth changes by a pixel to the right and down.
  // A face belongs to `owner`, of which the outline is drawn.
  face(xs: Float64Array, ys: Float64Array, zs: Float64Array, count: number, slope: readonly [number, number], colour: number, owner: number): void {
    const { width, left, right, depths, colours, owners } = this;
    let [top, bottom] = [Infinity, -Infinity];
    for (let k = 0; k < count; k++) {
      top = Math.min(top, ys[k]!);
      bottom = Math.max(bottom, ys[k]!);
    }
    const first = Math.max(0, Math.ceil(top - 0.5));
    const last = Math.min(this.height - 1, Math.ceil(bottom - 0.5) - 1);
    if (!(first <= last)) return;
    left.fill(Infinity, first, last + 1);
    right.fill(-Infinity, first, last + 1);
    for (let k = 0; k < count; k++) this.edge(xs[k]!, ys[k]!, xs[(k + 1) % count]!, ys[(k + 1) % count]!, first, last);
    const [dx, dy] = slope;
    for (let row = first; row <= last; row++) {
      const start = Math.max(0, Math.ceil(left[row]! - 0.5));
      const end = Math.min(width, Math.ceil(right[row]! - 0.5));
      let z = zs[0]! + (start + 0.5 - xs[0]!) * dx + (row + 0.5 - ys[0]!) * dy;
      for (let pixel = row * width + start, stop = row * width + end; pixel < stop; pixel++, z += dx) {
        if (z <= depths[pixel]!) continue;
        depths[pixel] = z;
        colours[pixel] = colour;
        owners[pixel] = owner;
      }
    }
  }

  // Where owners meet.
  outline(colour: number): void {
    const { width, height, owners, colours } = this;
    for (let row = 0; row < height - 1; row++) {
      for (let pixel = row * width, stop = pixel + width - 1; pixel < stop; pixel++) {
        const owner = owners[pixel]!;
        if (owner !== owners[pixel + 1] || owner !== owners[pixel + width]) colours[pixel] = colour;
      }
    }
  }

  // Something is in front of this point, by more than `slack`.
  hides(x: number, y: number, z: number, slack: number): boolean {
    const [column, row] = [Math.floor(x), Math.floor(y)];
    if (column < 0 || row < 0 || column >= this.width || row >= this.height) return false;
    return this.depths[row * this.width + column]! > z + slack;
  }

  private edge(x0: number, y0: number, x1: number, y1: number, first: number, last: number): void {
    if (y0 === y1) return;
    const [ax, ay, bx, by] = y0 < y1 ? [x0, y0, x1, y1] : [x1, y1, x0, y0];
    const step = (bx - ax) / (by - ay);
    const begin = Math.max(first, Math.ceil(ay - 0.5));
    const end = Math.min(last, Math.ceil(by - 0.5) - 1);
    let x = ax + (begin + 0.5 - ay) * step;
    for (let row = begin; row <= end; row++, x += step) {
      if (x < this.left[row]!) this.left[row] = x;
      if (x > this.right[row]!) this.right[row] = x;
    }
  }
}

// As a picture's pixel in memory.
export const pixelOf = (red: number, green: number, blue: number): number => ((255 << 24) | (blue << 16) | (green << 8) | red) >>> 0;
