// Groups the nodes of a layered graph into columns and gives each a first place, as far to the left as the
// columns beside it allow.

import type { Graph, GraphNode } from './graph';

export interface Column {
  nodes: GraphNode[];
  x: number;
  joined: Column[]; // above and below, by an edge
  leftOf: { column: Column; distance: number }[]; // the columns at its left, and how far they must stay
  rightOf: { column: Column; distance: number }[];
}

export type Distance = (left: GraphNode, right: GraphNode) => number;

export function columnsOf(graph: Graph, rows: GraphNode[][], distance: Distance): Column[] {
  const together = build(graph, rows, distance, true);
  // Columns that change sides from row to row cannot be placed: then every node stands for itself.
  return packLeft(together) ?? packLeft(build(graph, rows, distance, false)) ?? [];
}

function build(graph: Graph, rows: GraphNode[][], distance: Distance, group: boolean): Column[] {
  const columns: Column[] = [];
  const columnOf = new Map<GraphNode, Column>();
  for (const row of rows) {
    for (const node of row) {
      const above = node.above.length === 1 ? graph.nodes[node.above[0]!] : undefined;
      const column = group && above && above.below.length === 1 ? columnOf.get(above)! : newColumn(columns);
      column.nodes.push(node);
      columnOf.set(node, column);
    }
  }
  for (const node of graph.nodes) {
    for (const id of node.below) {
      const from = columnOf.get(node)!;
      const to = columnOf.get(graph.nodes[id]!)!;
      if (from === to) continue;
      from.joined.push(to);
      to.joined.push(from);
    }
  }
  for (const row of rows) {
    for (let i = 1; i < row.length; i++) {
      const left = columnOf.get(row[i - 1]!)!;
      const right = columnOf.get(row[i]!)!;
      const apart = distance(row[i - 1]!, row[i]!);
      right.leftOf.push({ column: left, distance: apart });
      left.rightOf.push({ column: right, distance: apart });
    }
  }
  return columns;
}

function newColumn(columns: Column[]): Column {
  const column: Column = { nodes: [], x: 0, joined: [], leftOf: [], rightOf: [] };
  columns.push(column);
  return column;
}

// The columns from left to right, placed; null if some are at each other's left.
function packLeft(columns: Column[]): Column[] | null {
  const missing = new Map(columns.map((column) => [column, column.leftOf.length]));
  const ready = columns.filter((column) => column.leftOf.length === 0);
  const order: Column[] = [];
  for (let column = ready.shift(); column; column = ready.shift()) {
    column.x = Math.max(0, ...column.leftOf.map(({ column: left, distance }) => left.x + distance));
    order.push(column);
    for (const { column: right } of column.rightOf) {
      const left = missing.get(right)! - 1;
      missing.set(right, left);
      if (left === 0) ready.push(right);
    }
  }
  return order.length === columns.length ? order : null;
}
