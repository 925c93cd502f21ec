#pragma once

// Follows the lines of a drawn chart. Internal to this folder.

#include <set>
#include <unordered_map>
#include <vector>

#include "ladder/graphic/diagram.h"
#include "ladder/lowering/diagram_scope.h"

namespace stepwright::lowering {

class ChartTracer {
 public:
  ChartTracer(const graphic::Diagram& diagram, DiagramScope& scope);

  // Steps that a transition leaves.
  std::vector<const graphic::Element*> steps_above(const graphic::Element& transition);
  // Transitions that enter a step or jump.
  std::vector<const graphic::Element*> transitions_above(const graphic::Element& step);
  // The step that an action block belongs to; null if there is none.
  const graphic::Element* owner_of(const graphic::Element& action_block) const;

 private:
  void climb(const graphic::Element& element, graphic::ElementKind wanted, bool through_simultaneous,
             const graphic::Element& start, std::vector<const graphic::Element*>& found);
  std::vector<const graphic::Element*> parents(const graphic::Element& element) const;

  DiagramScope& scope_;
  std::unordered_map<std::uint64_t, const graphic::Element*> index_;
  std::set<const graphic::Element*> seen_;
};

}  // namespace stepwright::lowering
