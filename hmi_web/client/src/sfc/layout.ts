// A drawing of a sequential function chart: boxes, bars and lines in pixels, computed from its structure
// alone. Layered: ranks, then columns, then lines with right angles.

import type { ProgramMessage } from '../lib/protocol';
import { placeColumns, type Extent } from './columns';
import { graphOf, type Graph, type GraphNode } from './graph';
import { rank } from './ranks';

export interface StepBox {
  index: number;
  x: number; // of its middle
  y: number; // of its top
}

export interface TransitionBar {
  index: number;
  x: number;
  y: number; // of the bar
  jumpTo: number | null; // step, for a transition that leads back
}

export interface DoubleLine {
  x1: number;
  x2: number;
  y: number;
}

export interface SfcDrawing {
  width: number;
  height: number;
  steps: StepBox[];
  transitions: TransitionBar[];
  doubles: DoubleLine[];
  lines: string[]; // SVG path data
}

export const STEP_WIDTH = 190;
export const STEP_HEIGHT = 42;
export const LABEL_WIDTH = 150;
const LABEL_GAP = 16;
const BAR_HEIGHT = 10;
const ROW_GAP = 22;
const MARGIN = 14;

export function layOut(program: ProgramMessage, hidden: ReadonlySet<number>): SfcDrawing {
  const graph = graphOf(program, hidden);
  const shown = () => graph.nodes.filter((node) => !node.hidden);
  const rows = rank(graph);
  const x = placeColumns(graph, rows, extentOf);
  const tops = rowTops(rows);
  const leftmost = Math.min(...shown().map((node) => x.get(node)! - extentOf(node).left));
  const rightmost = Math.max(...shown().map((node) => x.get(node)! + extentOf(node).right));
  const shift = MARGIN - leftmost;
  const at = (node: GraphNode) => x.get(node)! + shift;

  const drawing: SfcDrawing = {
    width: rightmost - leftmost + 2 * MARGIN,
    height: (tops[rows.length] ?? 0) + MARGIN,
    steps: [],
    transitions: [],
    doubles: [],
    lines: [],
  };
  for (const node of shown()) {
    const y = tops[node.rank]!;
    if (node.kind === 'step') drawing.steps.push({ index: node.index, x: at(node), y });
    if (node.kind === 'transition') addTransition(drawing, graph, node, at(node), y, at);
    addLines(drawing, graph, node, at, tops);
  }
  return drawing;
}

function extentOf(node: GraphNode): Extent {
  if (node.kind === 'step') return { left: STEP_WIDTH / 2, right: STEP_WIDTH / 2 };
  if (node.kind === 'transition') return { left: 14, right: LABEL_GAP + LABEL_WIDTH };
  return { left: 6, right: 6 };
}

function heightOf(node: GraphNode): number {
  return node.kind === 'step' ? STEP_HEIGHT : BAR_HEIGHT;
}

// The top of every row, and the end behind the last.
function rowTops(rows: GraphNode[][]): number[] {
  const tops = [MARGIN];
  for (const row of rows) {
    tops.push(tops[tops.length - 1]! + Math.max(...row.map(heightOf)) + ROW_GAP);
  }
  return tops;
}

function addTransition(
  drawing: SfcDrawing,
  graph: Graph,
  node: GraphNode,
  x: number,
  top: number,
  at: (node: GraphNode) => number,
): void {
  const jump = graph.jumps.find((candidate) => candidate.transition === node.index);
  drawing.transitions.push({ index: node.index, x, y: top + BAR_HEIGHT / 2, jumpTo: jump ? jump.step : null });
  // Simultaneous sequences begin and end at a double line (IEC 61131-3, table 44).
  const span = (ids: number[], y: number) => {
    if (ids.length < 2) return;
    const places = [...ids.map((id) => at(graph.nodes[id]!)), x];
    drawing.doubles.push({ x1: Math.min(...places) - 14, x2: Math.max(...places) + 14, y });
  };
  span(node.above, top - ROW_GAP / 2);
  span(node.below, top + BAR_HEIGHT + ROW_GAP / 2);
}

// From each node down to those below it: straight, or across in the middle of the gap between the rows.
function addLines(
  drawing: SfcDrawing,
  graph: Graph,
  node: GraphNode,
  at: (node: GraphNode) => number,
  tops: number[],
): void {
  const x = at(node);
  const bottom = tops[node.rank]! + (node.kind === 'bend' ? 0 : heightOf(node));
  const nextTop = tops[node.rank + 1]!;
  const middle = nextTop - ROW_GAP / 2;
  for (const id of node.below) {
    const below = at(graph.nodes[id]!);
    const across = Math.abs(below - x) < 0.5 ? '' : `V${round(middle)}H${round(below)}`;
    drawing.lines.push(`M${round(x)} ${round(bottom)}${across}V${round(nextTop)}`);
  }
}

function round(value: number): number {
  return Math.round(value * 10) / 10;
}
