// The chart as a graph without cycles. A transition that leads back up (to a step from which it was reached)
// is drawn as a jump, as IEC 61131-3 allows, so that the rest has a top and a bottom.

import type { ProgramMessage } from '../lib/protocol';

export interface GraphNode {
  kind: 'step' | 'transition' | 'bend';
  // Of the step or transition in the program; of a bend: none.
  index: number;
  // Not drawn, and without edges.
  hidden: boolean;
  rank: number;
  above: number[];
  below: number[];
}

export interface Jump {
  transition: number;
  step: number;
}

export interface Graph {
  // Steps first, then transitions, each by its index in the program; bends are added by `ranked`.
  nodes: GraphNode[];
  stepCount: number;
  jumps: Jump[];
}

// Without the `hidden` steps and the transitions that lead to them alone.
export function graphOf(program: ProgramMessage, hidden: ReadonlySet<number>): Graph {
  const stepCount = program.steps.length;
  const nodes: GraphNode[] = [
    ...program.steps.map((_, index) => node('step', index, hidden.has(index))),
    ...program.transitions.map((transition, index) =>
      node('transition', index, transition.to.length > 0 && transition.to.every((step) => hidden.has(step))),
    ),
  ];
  const graph: Graph = { nodes, stepCount, jumps: [] };
  const targets = nodes.map((): number[] => []);
  program.transitions.forEach((transition, index) => {
    if (nodes[stepCount + index]?.hidden) return;
    for (const step of transition.from) targets[step]?.push(stepCount + index);
    targets[stepCount + index]?.push(...transition.to.filter((step) => step < stepCount && !hidden.has(step)));
  });
  const starts = program.steps.flatMap((step, index) => (step.initial ? [index] : []));
  connectForward(graph, targets, [...starts, ...nodes.keys()]);
  return graph;
}

function node(kind: GraphNode['kind'], index: number, hidden: boolean): GraphNode {
  return { kind, index, hidden, rank: 0, above: [], below: [] };
}

// Depth first from `starts`, on a stack of its own: charts may be longer than the call stack is deep.
function connectForward(graph: Graph, targets: number[][], starts: number[]): void {
  const state = new Uint8Array(graph.nodes.length); // 0 new, 1 on the path, 2 done
  for (const start of starts) {
    if (state[start] !== 0) continue;
    const path = [{ id: start, next: 0 }];
    state[start] = 1;
    while (path.length > 0) {
      const top = path[path.length - 1]!;
      const target = targets[top.id]?.[top.next++];
      if (target === undefined) {
        state[top.id] = 2;
        path.pop();
      } else if (state[target] === 1) {
        addBackEdge(graph, top.id, target);
      } else {
        graph.nodes[top.id]!.below.push(target);
        graph.nodes[target]!.above.push(top.id);
        if (state[target] === 0) {
          state[target] = 1;
          path.push({ id: target, next: 0 });
        }
      }
    }
  }
}

function addBackEdge(graph: Graph, from: number, to: number): void {
  if (from >= graph.stepCount) {
    graph.jumps.push({ transition: from - graph.stepCount, step: to });
  } else {
    // Found from the middle of a loop: the step below is where the drawing begins, its jump is at the transition.
    graph.jumps.push({ transition: to - graph.stepCount, step: from });
  }
}
