#pragma once

// The facts of a task as finite-domain variables: a group of facts of which at most one holds is one
// variable, every other fact has one of its own. States are smaller that way, and one look at a variable
// decides about all its facts.
//
// Thread rule: immutable.
// Invariant: the facts of a variable are numbered one after the other, those of groups first
// (`arrange_by_groups` sees to that; a group that is not numbered so is not used).

#include <vector>

#include "supervisor/pddl/ground_task/ground_task.h"
#include "supervisor/pddl/search/space/packed_bits.h"

namespace stepwright::pddl {

// The variable's values are 0 .. count - 1 for its facts and `count` for "none of them".
struct DomainVariable {
  int first = 0;  // fact
  int count = 1;
  bool may_be_none = true;

  int values() const { return count + (may_be_none ? 1 : 0); }
};

class FiniteDomains {
 public:
  explicit FiniteDomains(const GroundTask& task);

  std::size_t size() const { return variables_.size(); }
  const DomainVariable& operator[](std::size_t variable) const { return variables_[variable]; }
  int variable_of(int fact) const { return variable_of_[static_cast<std::size_t>(fact)]; }
  int value(const Word* state, std::size_t variable) const {
    return first_bit(state, variables_[variable].first, variables_[variable].count);
  }

 private:
  std::vector<DomainVariable> variables_;
  std::vector<int> variable_of_;
};

// Renumbers the facts so that groups, larger ones first, are ranges. Requires that every fact is in one group
// at most. Derived facts stay behind all others.
void arrange_by_groups(GroundTask& task);

}  // namespace stepwright::pddl
