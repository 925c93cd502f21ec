#pragma once

// Comparisons, each once, by number; and those that read a variable.
//
// Thread rule: one owner.

#include <map>
#include <span>
#include <vector>

#include "supervisor/pddl/ground_task/ground_task.h"

namespace stepwright::pddl {

class ComparisonTable {
 public:
  explicit ComparisonTable(std::size_t variables) : by_variable_(variables) {}

  // The number of the comparison, which is taken in if it is new.
  int add(const Comparison& comparison);

  const std::vector<Comparison>& list() const { return list_; }
  std::span<const int> over(int variable) const { return by_variable_[static_cast<std::size_t>(variable)]; }

 private:
  std::vector<Comparison> list_;
  std::vector<std::vector<int>> by_variable_;
  std::map<std::vector<double>, int> known_;  // by what it says
};

}  // namespace stepwright::pddl
