#include "ladder/lowering/diagram_to_ladder.h"

#include "ladder/lowering/network_lowering.h"

namespace stepwright::lowering {

graphic::LadderProgram diagram_to_ladder(const graphic::Diagram& diagram, DiagramScope& scope) {
  const DiagramGraph graph(diagram, scope);
  NetworkLowering lowering(graph, scope);
  for (const Network& network : graph.networks()) lowering.lower(network);
  return lowering.take();
}

}  // namespace stepwright::lowering
