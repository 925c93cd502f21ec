// Where the states of a task and the arrows between them are drawn: columns from left to right, or downwards where the panel is
// narrow, and what may happen next.

import type { AutomatonPicture, TaskEdge, TaskState, Verdict } from './document';

export const RADIUS_PX = 17;

const SIDE_PX = 34; // from the middle of the outermost states to the edge
const TOP_PX = 40;
const LEAST_ACROSS_PX = 86; // between two columns: a short name fits between
const MOST_ACROSS_PX = 210;
const ROW_PX = 62;
const DOWN_PX = 84;
const LEAST_BESIDE_PX = 44; // between two rows that stand beside each other
const MOST_BESIDE_PX = 110;
const HEAD_PX = 8;
const LETTER_PX = 7;
const MOST_LETTERS = 24;

export interface DrawnState extends TaskState {
  x: number;
  y: number;
}

export interface DrawnEdge extends TaskEdge {
  path: string;
  head: string;
  x: number; // where its letters stand
  y: number;
}

export interface Drawing {
  width: number;
  height: number;
  downwards: boolean;
  letters: number; // so many fit beside an arrow
  states: DrawnState[];
  edges: DrawnEdge[];
}

type Point = readonly [u: number, v: number]; // along the columns, along the rows

const short = (value: number) => Math.round(value * 10) / 10;

export function drawingOf(picture: AutomatonPicture, room: number): Drawing {
  const columns = Math.max(0, ...picture.states.map(({ column }) => column));
  const rows = Math.max(0, ...picture.states.map(({ row }) => row));
  const across = columns > 0 ? (room - 2 * SIDE_PX) / columns : MOST_ACROSS_PX;
  const downwards = across < LEAST_ACROSS_PX;
  const column = downwards ? DOWN_PX : Math.min(across, MOST_ACROSS_PX);
  const beside = rows > 0 ? Math.max(LEAST_BESIDE_PX, Math.min((room - 2 * SIDE_PX) / rows, MOST_BESIDE_PX)) : 0;
  const row = downwards ? beside : ROW_PX;
  const origin: Point = downwards ? [TOP_PX, SIDE_PX] : [SIDE_PX, TOP_PX];
  const at = new Map(picture.states.map((state): [number, Point] => [state.state, [origin[0] + state.column * column, origin[1] + state.row * row]]));
  const xy = ([u, v]: Point): Point => (downwards ? [v, u] : [u, v]);
  const states = picture.states.map((state) => {
    const [x, y] = xy(at.get(state.state)!);
    return { ...state, x, y };
  });
  const edges = picture.edges.map((edge): DrawnEdge => {
    const curve = curveOf(at.get(edge.from)!, at.get(edge.to)!, column, row || ROW_PX).map(xy);
    const [from, first, second, to] = curve as [Point, Point, Point, Point];
    const text = (point: Point) => `${short(point[0])} ${short(point[1])}`;
    const middle = (k: 0 | 1) => (from[k] + 3 * first[k] + 3 * second[k] + to[k]) / 8;
    return { ...edge, path: `M${text(from)}C${text(first)} ${text(second)} ${text(to)}`, head: headOf(second, to), x: short(middle(0)), y: short(middle(1)) };
  });
  const [width, height] = xy([2 * origin[0] + columns * column, 2 * origin[1] + rows * row]);
  const letters = downwards ? MOST_LETTERS : Math.min(MOST_LETTERS, Math.floor((column - 2 * RADIUS_PX) / LETTER_PX) + 2);
  return { width, height, downwards, letters, states, edges };
}

// From edge to edge of the two circles. Past the columns between it goes round, back it goes below.
function curveOf([fromU, fromV]: Point, [toU, toV]: Point, column: number, row: number): Point[] {
  const steps = Math.round((toU - fromU) / column);
  if (steps < 1) {
    const below = Math.max(fromV, toV) + RADIUS_PX + 0.7 * row;
    return [[fromU, fromV + RADIUS_PX], [fromU, below], [toU, below], [toU, toV + RADIUS_PX]];
  }
  const [start, end] = [fromU + RADIUS_PX, toU - RADIUS_PX];
  const reach = 0.45 * (end - start);
  const aside = steps > 1 && fromV === toV ? -0.55 * row : 0;
  return [[start, fromV], [start + reach, fromV + aside], [end - reach, toV + aside], [end, toV]];
}

function headOf(before: Point, tip: Point): string {
  const length = Math.hypot(tip[0] - before[0], tip[1] - before[1]) || 1;
  const [dx, dy] = [(HEAD_PX * (tip[0] - before[0])) / length, (HEAD_PX * (tip[1] - before[1])) / length];
  const corner = (side: number) => `${short(tip[0] - dx - 0.45 * side * dy)} ${short(tip[1] - dy + 0.45 * side * dx)}`;
  return `M${short(tip[0])} ${short(tip[1])}L${corner(1)}L${corner(-1)}Z`;
}

// "press + rack / wash"; `nowhere`: what stands for no place at all.
export function lettersText(letters: string[][], nowhere: string): string {
  return letters.map((names) => (names.length > 0 ? names.join(' + ') : nowhere)).join(' / ');
}

export function shortened(text: string, most: number): string {
  return text.length > most ? `${text.slice(0, most - 1)}…` : text;
}

// The one behind the current state on the plan; null: the plan does not go through it, or ends there.
export function plannedNext(picture: AutomatonPicture, current: number | null): number | null {
  const index = current === null ? -1 : picture.planned.indexOf(current);
  return index < 0 ? null : (picture.planned[index + 1] ?? null);
}

// Those of the plan that lie behind the current one.
export function passedStates(picture: AutomatonPicture, current: number | null): Set<number> {
  const index = current === null ? -1 : picture.planned.indexOf(current);
  return new Set(picture.planned.slice(0, Math.max(0, index)));
}

export interface NextRow {
  to: number;
  letters: string[][];
  verdict: Verdict;
  planned: boolean;
}

// What leads on from a state: first what the plan has.
export function nextRows(picture: AutomatonPicture, current: number | null): NextRow[] {
  const planned = plannedNext(picture, current);
  const rows = picture.edges
    .filter(({ from }) => from === current)
    .map(({ to, letters }) => ({ to, letters, verdict: picture.states.find(({ state }) => state === to)?.verdict ?? 'undecided', planned: to === planned }));
  return [...rows.filter((row) => row.planned), ...rows.filter((row) => !row.planned)];
}

// On the plan's way through the states.
export function isPlanned(picture: AutomatonPicture, edge: TaskEdge): boolean {
  return picture.planned.some((state, index) => state === edge.from && picture.planned[index + 1] === edge.to);
}
