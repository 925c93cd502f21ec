#include "supervisor/htn/task/external.h"

#include "supervisor/lisp/name_hints.h"

namespace stepwright::htn {

void mark_external(const std::vector<std::string>& external, Place domain, const Names& names,
                   PlanningTask& task, lisp::Reporter& reporter) {
  for (const std::string& name : external) {
    const auto found = names.predicates.find(name);
    if (found != names.predicates.end()) {
      task.predicates[static_cast<std::size_t>(found->second)].external = true;
      continue;
    }
    reporter.error("P0607", domain,
                   "'" + name + "' is to be evaluated outside, but the domain has no such predicate",
                   lisp::did_you_mean(name, lisp::names_of(names.predicates)));
  }
}

}  // namespace stepwright::htn
