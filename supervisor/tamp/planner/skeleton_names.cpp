#include "supervisor/tamp/planner/skeleton_names.h"

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "supervisor/lisp/name_hints.h"
#include "supervisor/tamp/predicates/name_places.h"

namespace stepwright::tamp::planner {

result::Result<void> check_names(const pddl::OutsideTask& task, const scene::RobotCell& cell,
                                 const pddl::Source& domain, const pddl::Source& problem) {
  const predicates::NamePlaces places(domain, problem);
  result::Diagnostics wrong;
  std::set<std::string> told;
  const auto missing = [&](const std::string& name, const char* what, const std::vector<std::string>& known) {
    if (!told.insert(name).second) return;
    wrong.push_back({"G0104", result::Severity::Error, places.of(name),
                     std::string("the cell has no ") + what + " '" + name + "'",
                     lisp::did_you_mean(name, known)});
  };
  for (const char* predicate : {"can-move-pick", "can-move-place"}) {
    const auto found = task.objects.find(predicate);
    if (found == task.objects.end() || found->second.size() < 2) continue;
    for (const std::string& name : found->second.front())
      if (cell.arm(name) < 0) missing(name, "arm", predicates::names_of(cell.arms));
    for (const std::string& name : found->second.back())
      if (cell.thing(name) < 0) missing(name, "thing", predicates::names_of(cell.things));
  }
  if (!wrong.empty()) return tl::unexpected(std::move(wrong));
  return {};
}

}  // namespace stepwright::tamp::planner
