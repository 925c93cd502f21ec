#include "cell/import/named_bodies.h"

#include <algorithm>
#include <variant>

namespace stepwright::cell_import {

bool takes_named_bodies(const graphic::DrawnBody& drawn) {
  return std::ranges::any_of(drawn.body.diagram.elements, [](const graphic::Element& each) {
    return each.kind == graphic::ElementKind::Step;
  });
}

void tell_named_bodies(const graphic::Project& project, std::vector<std::string>& left) {
  for (const graphic::Pou& pou : project.pous) {
    const auto* const drawn = std::get_if<graphic::DrawnBody>(&pou.body);
    if (drawn == nullptr || takes_named_bodies(*drawn)) continue;
    const auto tell = [&](const char* kind, const std::vector<graphic::NamedBody>& bodies) {
      for (const graphic::NamedBody& each : bodies)
        left.push_back(pou.name + "." + each.name + ": " + kind +
                       " outside of a chart, which nothing runs or calls here: write it into the body of " +
                       pou.name + ", or as a function block");
    };
    tell("an action", drawn->actions);
    tell("a transition", drawn->transitions);
  }
}

}  // namespace stepwright::cell_import
