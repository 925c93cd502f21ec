// Where in its row each node stands: first the order in which lines cross least (repeated barycentres), then
// the places. A run of nodes that follow each other one to one is a column: it moves as a whole, so that
// its line is straight.

import { columnsOf, type Column } from './column_blocks';
import type { Graph, GraphNode } from './graph';

// How far a node reaches to the left and to the right of its line.
export interface Extent {
  left: number;
  right: number;
}

export type ExtentOf = (node: GraphNode) => Extent;

const GAP = 22;
const ORDER_SWEEPS = 12;
const PLACE_SWEEPS = 40;

export function placeColumns(graph: Graph, rows: GraphNode[][], extentOf: ExtentOf): Map<GraphNode, number> {
  orderRows(graph, rows);
  const distance = (left: GraphNode, right: GraphNode) => extentOf(left).right + GAP + extentOf(right).left;
  const columns = columnsOf(graph, rows, distance);
  for (let sweep = 0; sweep < PLACE_SWEEPS; sweep++) {
    for (const column of sweep % 2 === 0 ? columns : [...columns].reverse()) moveToNeighbours(column);
  }
  return new Map(columns.flatMap((column) => column.nodes.map((node) => [node, column.x] as const)));
}

function orderRows(graph: Graph, rows: GraphNode[][]): void {
  const place = new Map<GraphNode, number>();
  const remember = (row: GraphNode[]) => row.forEach((node, index) => place.set(node, index));
  rows.forEach(remember);
  for (let sweep = 0; sweep < ORDER_SWEEPS; sweep++) {
    const down = sweep % 2 === 0;
    for (const row of down ? rows : [...rows].reverse()) {
      const key = new Map(
        row.map((node) => {
          const ids = down ? node.above : node.below;
          const sum = ids.reduce((total, id) => total + place.get(graph.nodes[id]!)!, 0);
          return [node, ids.length > 0 ? sum / ids.length : place.get(node)!];
        }),
      );
      row.sort((a, b) => key.get(a)! - key.get(b)!);
      remember(row);
    }
  }
}

// Towards the mean of the columns that it is joined to, as far as those beside it allow.
function moveToNeighbours(column: Column): void {
  if (column.joined.length === 0) return;
  const wish = column.joined.reduce((sum, other) => sum + other.x, 0) / column.joined.length;
  const least = Math.max(...column.leftOf.map(({ column: other, distance }) => other.x + distance), -Infinity);
  const most = Math.min(...column.rightOf.map(({ column: other, distance }) => other.x - distance), Infinity);
  column.x = Math.min(Math.max(wish, least), most);
}
