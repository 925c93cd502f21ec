// Which row each node stands in: as high as its longest way from the top allows. Edges over several rows get
// a bend in each row between, so that they keep a lane of their own.

import type { Graph, GraphNode } from './graph';

export function rank(graph: Graph): GraphNode[][] {
  longestPaths(graph);
  addBends(graph);
  const rows: GraphNode[][] = [];
  for (const node of graph.nodes) if (!node.hidden) (rows[node.rank] ??= []).push(node);
  return rows;
}

function longestPaths(graph: Graph): void {
  const missing = graph.nodes.map((node) => node.above.length);
  const ready = graph.nodes.flatMap((_, id) => (missing[id] === 0 ? [id] : []));
  while (ready.length > 0) {
    const id = ready.pop()!;
    const node = graph.nodes[id]!;
    for (const below of node.below) {
      const target = graph.nodes[below]!;
      target.rank = Math.max(target.rank, node.rank + 1);
      missing[below]! -= 1;
      if (missing[below] === 0) ready.push(below);
    }
  }
}

function addBends(graph: Graph): void {
  const originals = graph.nodes.length;
  for (let id = 0; id < originals; id++) {
    const node = graph.nodes[id]!;
    node.below = node.below.map((below) => chain(graph, id, below));
  }
}

// Replaces the edge by a chain of bends; returns its first member.
function chain(graph: Graph, from: number, to: number): number {
  const target = graph.nodes[to]!;
  let first = to;
  let previous = from;
  for (let row = graph.nodes[from]!.rank + 1; row < target.rank; row++) {
    const id = graph.nodes.length;
    graph.nodes.push({ kind: 'bend', index: -1, hidden: false, rank: row, above: [previous], below: [] });
    if (previous === from) first = id;
    else graph.nodes[previous]!.below.push(id);
    previous = id;
  }
  if (previous !== from) {
    graph.nodes[previous]!.below.push(to);
    target.above[target.above.indexOf(from)] = previous;
  }
  return first;
}
