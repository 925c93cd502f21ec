#include "ladder/lowering/chart_tracer.h"

#include "ladder/source/codes.h"

namespace stepwright::lowering {

using graphic::Element;
using graphic::ElementKind;

ChartTracer::ChartTracer(const graphic::Diagram& diagram, DiagramScope& scope) : scope_(scope) {
  for (const Element& element : diagram.elements) index_.emplace(element.id, &element);
}

std::vector<const Element*> ChartTracer::parents(const Element& element) const {
  std::vector<const Element*> list;
  for (const graphic::Pin& pin : element.inputs) {
    for (const graphic::Connection& connection : pin.connections) {
      const auto found = index_.find(connection.from);
      if (found != index_.end()) list.push_back(found->second);
    }
  }
  return list;
}

std::vector<const Element*> ChartTracer::steps_above(const Element& transition) {
  std::vector<const Element*> found;
  seen_.clear();
  climb(transition, ElementKind::Step, true, transition, found);
  return found;
}

std::vector<const Element*> ChartTracer::transitions_above(const Element& step) {
  std::vector<const Element*> found;
  seen_.clear();
  climb(step, ElementKind::Transition, false, step, found);
  return found;
}

// A step is above a transition through divergences of selection and convergences of simultaneous branches; a
// transition is above a step through the two others.
void ChartTracer::climb(const Element& element, ElementKind wanted, bool to_steps, const Element& start,
                        std::vector<const Element*>& found) {
  for (const Element* parent : parents(element)) {
    if (!seen_.insert(parent).second) continue;
    if (parent->kind == wanted) {
      found.push_back(parent);
      continue;
    }
    const bool bar = to_steps ? parent->kind == ElementKind::SelectionDivergence ||
                                    parent->kind == ElementKind::SimultaneousConvergence
                              : parent->kind == ElementKind::SelectionConvergence ||
                                    parent->kind == ElementKind::SimultaneousDivergence;
    if (bar && seen_.size() < 1000) {
      climb(*parent, wanted, to_steps, start, found);
    } else if (parent->kind != ElementKind::MacroStep) {
      scope_.error(source::code::kBadDiagram, start.where,
                   std::string("a ") + graphic::to_string(parent->kind) + " leads to this " +
                       graphic::to_string(start.kind),
                   to_steps ? "a step stands above a transition" : "a transition stands above a step");
    }
  }
}

const Element* ChartTracer::owner_of(const Element& action_block) const {
  for (const Element* parent : parents(action_block))
    if (parent->kind == ElementKind::Step) return parent;
  return nullptr;
}

}  // namespace stepwright::lowering
