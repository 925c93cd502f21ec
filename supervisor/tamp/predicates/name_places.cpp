#include "supervisor/tamp/predicates/name_places.h"

#include "supervisor/lisp/reporter.h"

namespace stepwright::tamp::predicates {

NamePlaces::NamePlaces(const lisp::Source& domain, const lisp::Source& problem)
    : files_{domain.file, problem.file} {
  lisp::Reporter reporter({domain.file, problem.file});
  problem_ = lisp::tokens_of(problem.text, 1, reporter);
  domain_ = lisp::tokens_of(domain.text, 0, reporter);
  (void)reporter.take();  // said when the task was read
}

result::Location NamePlaces::location(const lisp::Place& at) const {
  return {files_[at.file], at.line, at.column};
}

result::Location NamePlaces::of(const std::string& name) const {
  for (const auto* tokens : {&problem_, &domain_})
    for (const lisp::Token& each : *tokens)
      if (each.text == name) return location(each.at);
  return {files_[1], 1, 1};
}

result::Location NamePlaces::of(const std::vector<std::string>& fact) const {
  for (std::size_t k = 0; k + fact.size() <= problem_.size(); ++k) {
    bool same = true;
    for (std::size_t n = 0; n < fact.size() && same; ++n) same = problem_[k + n].text == fact[n];
    if (same) return location(problem_[k].at);
  }
  return of(fact.front());
}

}  // namespace stepwright::tamp::predicates
