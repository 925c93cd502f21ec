// Which part of the floor is seen: metres to pixels. y runs upwards on the floor and downwards on the screen.

import type { Pair } from './document';

export interface Bounds {
  low: Pair;
  high: Pair;
}

export interface View {
  scale: number; // pixels a metre
  x: number; // where the origin of the floor is, px
  y: number;
}

const MARGIN_PX = 10;
const CLOSEST = 120; // pixels a metre
const FARTHEST = 0.6; // of the scale at which everything is seen

export function fit(bounds: Bounds, width: number, height: number): View {
  const wide = Math.max(bounds.high[0] - bounds.low[0], 1);
  const tall = Math.max(bounds.high[1] - bounds.low[1], 1);
  const scale = Math.max(
    Math.min((width - 2 * MARGIN_PX) / wide, (height - 2 * MARGIN_PX) / tall, CLOSEST),
    0.01,
  );
  return {
    scale,
    x: (width - wide * scale) / 2 - bounds.low[0] * scale,
    y: (height + tall * scale) / 2 + bounds.low[1] * scale,
  };
}

// What is under the pixel (x, y) stays there. `whole` is the view of everything.
export function zoomAt(view: View, whole: View, factor: number, x: number, y: number): View {
  const scale = Math.min(Math.max(view.scale * factor, whole.scale * FARTHEST), Math.max(CLOSEST, whole.scale));
  const ratio = scale / view.scale;
  return { scale, x: x - (x - view.x) * ratio, y: y - (y - view.y) * ratio };
}

export function pan(view: View, dx: number, dy: number): View {
  return { ...view, x: view.x + dx, y: view.y + dy };
}

// Moved as little as it takes to keep a part of the floor in sight.
export function keepInSight(view: View, bounds: Bounds, width: number, height: number): View {
  const rest = Math.min(60, width / 3, height / 3);
  const left = view.x + bounds.low[0] * view.scale;
  const right = view.x + bounds.high[0] * view.scale;
  const top = view.y - bounds.high[1] * view.scale;
  const bottom = view.y - bounds.low[1] * view.scale;
  const dx = right < rest ? rest - right : left > width - rest ? width - rest - left : 0;
  const dy = bottom < rest ? rest - bottom : top > height - rest ? height - rest - top : 0;
  return pan(view, dx, dy);
}

// With the place (x, y) of the floor in the middle.
export function centre(view: View, x: number, y: number, width: number, height: number): View {
  return { ...view, x: width / 2 - x * view.scale, y: height / 2 + y * view.scale };
}

// A round length that is about 100 px wide.
export function scaleBar(view: View): number {
  const rough = 110 / view.scale;
  const ten = 10 ** Math.floor(Math.log10(rough));
  return [5, 2, 1].map((digit) => digit * ten).find((length) => length <= rough) ?? ten;
}

export function boundsOf(places: Iterable<Pair>): Bounds | null {
  let bounds: Bounds | null = null;
  for (const [x, y] of places) {
    bounds ??= { low: [x, y], high: [x, y] };
    bounds.low = [Math.min(bounds.low[0], x), Math.min(bounds.low[1], y)];
    bounds.high = [Math.max(bounds.high[0], x), Math.max(bounds.high[1], y)];
  }
  return bounds;
}
