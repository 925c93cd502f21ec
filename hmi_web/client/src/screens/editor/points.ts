// Lines and pipes: rows of points, kept in a symbol's parameters and counted from its corner. Pure.

export interface Point {
  x: number;
  y: number;
}

const round = (value: number) => Number(value.toFixed(1));

// "0,0 120,0"; what is no number is left out.
export function pointsOf(text: string | undefined): Point[] {
  return (text ?? '')
    .trim()
    .split(/\s+/)
    .map((each) => each.split(',').map(Number))
    .filter((each): each is [number, number] => each.length === 2 && each.every(Number.isFinite))
    .map(([x, y]) => ({ x, y }));
}

export const pointsText = (points: readonly Point[]): string => points.map(({ x, y }) => `${round(x)},${round(y)}`).join(' ');

// Place and size of the symbol that goes through points of the drawing, and the points counted from its corner.
export function boxThrough(points: readonly Point[]): { x: number; y: number; w: number; h: number; points: string } {
  const [x, y] = [Math.min(...points.map((point) => point.x)), Math.min(...points.map((point) => point.y))];
  const w = Math.max(1, ...points.map((point) => point.x - x));
  const h = Math.max(1, ...points.map((point) => point.y - y));
  return { x, y, w, h, points: pointsText(points.map((point) => ({ x: point.x - x, y: point.y - y }))) };
}

export const stretched = (text: string, acrossBy: number, downBy: number): string =>
  pointsText(pointsOf(text).map(({ x, y }) => ({ x: x * acrossBy, y: y * downBy })));

// A quarter turn clockwise of what is `h` high.
export const turnedPoints = (text: string, h: number): string => pointsText(pointsOf(text).map(({ x, y }) => ({ x: h - y, y: x })));

// A triangle whose tip is at `tip` and which points away from `from`.
export function arrowHead(from: Point, tip: Point, length: number): string {
  const angle = Math.atan2(tip.y - from.y, tip.x - from.x);
  const back = (turn: number) => `${round(tip.x - length * Math.cos(angle + turn))} ${round(tip.y - length * Math.sin(angle + turn))}`;
  return `M${round(tip.x)} ${round(tip.y)}L${back(0.45)}L${back(-0.45)}Z`;
}

// Between two points, and so much further towards the second that an arrow of that length is in the middle.
export function middleTip(from: Point, to: Point, length: number): Point {
  const distance = Math.hypot(to.x - from.x, to.y - from.y) || 1;
  const share = 0.5 + length / 2 / distance;
  return { x: from.x + (to.x - from.x) * share, y: from.y + (to.y - from.y) * share };
}
