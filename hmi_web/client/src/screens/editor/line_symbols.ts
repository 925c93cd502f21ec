// Symbols that are drawn point by point. After ISA-101 they are grey, the way of the product thicker than a signal, with a small
// arrow where somebody has to know which way it flows. Pure.

import { arrowHead, middleTip, pointsOf, pointsText, type Point } from './points';
import { alive, escaped, type Params, type SymbolTemplate } from './template';

export const ARROWS = ['', 'end', 'start', 'both'] as const;

const HEAD = 12;
const USUAL: Point[] = [{ x: 0, y: 0 }, { x: 120, y: 0 }];

const through = (p: Params): Point[] => {
  const points = pointsOf(p.points);
  return points.length > 1 ? points : USUAL;
};

// The last two points at each end that has an arrow, the outer one second.
function ends(p: Params, points: readonly Point[]): [Point, Point][] {
  const [first, second] = [points[0] as Point, points[1] as Point];
  const [last, before] = [points.at(-1) as Point, points.at(-2) as Point];
  const wanted = p.arrow ?? '';
  return [...(wanted === 'end' || wanted === 'both' ? [[before, last] as [Point, Point]] : []), ...(wanted === 'start' || wanted === 'both' ? [[second, first] as [Point, Point]] : [])];
}

const heads = (paths: readonly string[]): string => paths.map((path) => `<path d="${path}" fill="var(--line-strong)" stroke="var(--panel)"/>`).join('');

// A label above the middle of the first piece.
function labelled(p: Params, [from, to]: readonly Point[]): string {
  if (!p.label || !from || !to) return '';
  return `<text x="${(from.x + to.x) / 2}" y="${(from.y + to.y) / 2 - 10}" text-anchor="middle" font-size="13">${escaped(p.label)}</text>`;
}

const row = (points: readonly Point[], width: number, colour: string): string =>
  `<polyline points="${pointsText(points)}" fill="none" stroke="${colour}" stroke-width="${width}" stroke-linejoin="round"/>`;

const byPoints = (kind: string, draw: (p: Params, points: readonly Point[]) => string): SymbolTemplate => ({
  kind,
  family: 'equipment',
  width: 120,
  height: 1,
  fields: ['label', 'on', 'warn', 'alarm', 'arrow', 'points'],
  byPoints: true,
  turns: true,
  draw: (p) => alive(p, draw(p, through(p))),
  beside: (p) => labelled(p, through(p)),
});

export const LINE_SYMBOLS: readonly SymbolTemplate[] = [
  byPoints('pipeline', (p, points) => row(points, 12, 'var(--line)') + row(points, 9, 'var(--equipment-dark)') + heads(ends(p, points).map(([from, to]) => arrowHead(from, middleTip(from, to, HEAD), HEAD)))),
  byPoints('line', (p, points) => row(points, 2, 'var(--line-strong)') + heads(ends(p, points).map(([from, to]) => arrowHead(from, to, HEAD)))),
];
