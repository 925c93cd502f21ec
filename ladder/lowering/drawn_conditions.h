#pragma once

// The conditions of a drawn chart that are networks, and which transitions share them. Internal to this
// folder; one object per chart.

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "ladder/graphic/project.h"
#include "ladder/lowering/condition_network.h"
#include "ladder/lowering/diagram_graph.h"
#include "ladder/lowering/drawn_body_text.h"
#include "ladder/lowering/network_lowering.h"

namespace stepwright::lowering {

class DrawnConditions {
 public:
  // All must outlive this.
  DrawnConditions(const graphic::DrawnBody& body, const DiagramGraph& graph, NetworkLowering& networks,
                  DrawnBodyText& texts);

  // Whether a network beside the chart is nothing but the condition of the transitions that read it: it calls
  // no function block and writes no variable.
  bool is_condition(const Network& network) const;

  // The condition of a transition that is connected to networks beside the chart ...
  graphic::Condition connected(const graphic::Element& transition);
  // ... that has a body of its own ...
  graphic::Condition inline_body(const graphic::Element& transition);
  // ... or names one; null if there is none of that name.
  const graphic::Condition* named(const graphic::Element& transition);

  // The networks that are guarded, with the transitions in the order of the chart.
  std::vector<ConditionNetwork> take(const std::vector<const graphic::Element*>& transitions) const;

 private:
  struct Shared {
    std::string statements;
    std::vector<const graphic::Element*> users;
  };
  struct Named {
    graphic::Condition value;
    std::size_t network = 0;  // index into networks_, where it is one
    bool is_network = false;
  };

  std::size_t joined(const std::vector<std::size_t>& touched);

  const graphic::DrawnBody& body_;
  const DiagramGraph& graph_;
  NetworkLowering& lowering_;
  DrawnBodyText& texts_;
  std::map<const graphic::Element*, std::size_t> network_of_;  // elements of condition networks
  std::map<std::size_t, std::size_t> shared_of_;               // by number of the network
  std::map<const graphic::NamedBody*, Named> named_;
  std::vector<Shared> shared_;
};

}  // namespace stepwright::lowering
