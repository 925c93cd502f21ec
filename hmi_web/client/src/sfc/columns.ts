// Where in its row each node stands: first the order that makes lines cross least (repeated barycentres),
// then places that keep the order, the distances and, as far as they allow, straight lines.

import type { Graph, GraphNode } from './graph';

// How far a node reaches to the left and to the right of its line.
export interface Extent {
  left: number;
  right: number;
}

export type ExtentOf = (node: GraphNode) => Extent;

const GAP = 22;
const SWEEPS = 8;

export function placeColumns(graph: Graph, rows: GraphNode[][], extentOf: ExtentOf): Map<GraphNode, number> {
  const position = new Map<GraphNode, number>();
  const neighbours = (ids: number[]) => ids.map((id) => graph.nodes[id]!);
  const setOrder = (row: GraphNode[]) => row.forEach((node, index) => position.set(node, index));
  rows.forEach(setOrder);

  for (let sweep = 0; sweep < SWEEPS; sweep++) {
    const down = sweep % 2 === 0;
    for (const row of down ? rows : [...rows].reverse()) {
      const key = new Map(
        row.map((node) => [node, mean(neighbours(down ? node.above : node.below), position) ?? position.get(node)!]),
      );
      row.sort((a, b) => key.get(a)! - key.get(b)!);
      setOrder(row);
    }
  }

  for (const row of rows) spread(row, extentOf, position, () => 0);
  for (let sweep = 0; sweep < SWEEPS; sweep++) {
    const down = sweep % 2 === 0;
    for (const row of down ? rows : [...rows].reverse()) {
      const wish = (node: GraphNode) =>
        mean(neighbours(down ? node.above : node.below), position) ??
        mean(neighbours(down ? node.below : node.above), position) ??
        position.get(node)!;
      spread(row, extentOf, position, wish);
    }
  }
  return position;
}

function mean(nodes: GraphNode[], position: Map<GraphNode, number>): number | null {
  if (nodes.length === 0) return null;
  return nodes.reduce((sum, node) => sum + position.get(node)!, 0) / nodes.length;
}

// Puts a row as near to its wishes as the distances allow. Neighbours that collide form a block that stands
// where its members wish on average (isotonic regression by pooling).
function spread(
  row: GraphNode[],
  extentOf: ExtentOf,
  position: Map<GraphNode, number>,
  wish: (node: GraphNode) => number,
): void {
  interface Block {
    sum: number;
    count: number;
    members: { node: GraphNode; offset: number }[];
  }
  const offsets: number[] = [];
  row.forEach((node, index) => {
    const before = row[index - 1];
    const distance = before ? extentOf(before).right + GAP + extentOf(node).left : 0;
    offsets.push((offsets[index - 1] ?? 0) + distance);
  });
  const blocks: Block[] = [];
  row.forEach((node, index) => {
    const offset = offsets[index]!;
    blocks.push({ sum: wish(node) - offset, count: 1, members: [{ node, offset }] });
    while (blocks.length > 1) {
      const last = blocks[blocks.length - 1]!;
      const before = blocks[blocks.length - 2]!;
      if (before.sum / before.count <= last.sum / last.count) break;
      before.sum += last.sum;
      before.count += last.count;
      before.members.push(...last.members);
      blocks.pop();
    }
  });
  for (const block of blocks) {
    for (const { node, offset } of block.members) position.set(node, block.sum / block.count + offset);
  }
}
