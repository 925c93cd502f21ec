#include "supervisor/pddl/search/relaxation/comparison_table.h"

namespace stepwright::pddl {
namespace {

// Everything that the comparison says, in one row of numbers.
std::vector<double> key_of(const Comparison& comparison) {
  std::vector<double> key{static_cast<double>(comparison.relation), comparison.difference.constant};
  for (const LinearTerm& term : comparison.difference.terms) {
    key.insert(key.end(), {static_cast<double>(term.variable), term.coefficient});
  }
  for (const NumericOperation& operation : comparison.difference.program) {
    key.insert(key.end(), {static_cast<double>(operation.kind), operation.constant + 0.0,
                           static_cast<double>(operation.variable)});
  }
  return key;
}

}  // namespace

int ComparisonTable::add(const Comparison& comparison) {
  const auto [place, added] = known_.emplace(key_of(comparison), static_cast<int>(list_.size()));
  const int number = place->second;
  if (!added) return number;
  for_each_variable(comparison.difference, [&](int v) {
    std::vector<int>& list = by_variable_[static_cast<std::size_t>(v)];
    if (list.empty() || list.back() != number) list.push_back(number);
  });
  list_.push_back(comparison);
  return number;
}

}  // namespace stepwright::pddl
