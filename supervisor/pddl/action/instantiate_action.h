#pragma once

// From schemas to the readable ground form of GroundActionInfo: quantifiers expanded, negations pushed
// inwards, what never changes decided. Quantifiers can have very many instances: `stop` is asked now and
// then.
//
// Thread rule: one object per use; it only reads the definition.

#include <functional>
#include <utility>
#include <vector>

#include "supervisor/pddl/action/ground_action.h"
#include "supervisor/pddl/lifted/executor.h"

namespace stepwright::pddl {

class ActionInstantiator {
 public:
  explicit ActionInstantiator(const Definition& definition, std::function<bool()> stop = {})
      : definition_(definition), initial_(initial_state(definition)), stop_(std::move(stop)) {}

  // Counts one step of work and asks `stop` every so often. Since it said so nothing is complete any more,
  // and nothing that is appended means anything.
  bool time_to_stop();

  // Appends what the formula requires; an impossible formula gives an Any without parts.
  void conjuncts(const Formula& formula, Binding& binding, std::vector<Requirement>& list);

  // Appends the changes that the effect makes under the conditions `when`.
  void changes(const Effect& effect, Binding& binding, const std::vector<Requirement>& when,
               std::vector<Change>& list);

 private:
  bool instances(const Formula& formula, std::size_t next, Binding& binding, bool needless,
                 const std::function<bool()>& visit);
  NumericNode number(const Expression& expression, const Binding& binding) const;
  Requirement any(const Formula& formula, Binding& binding, bool positive);
  void collect(const Formula& formula, Binding& binding, bool positive, std::vector<Requirement>& list);
  void collect_parts(const Formula& formula, Binding& binding, bool positive, std::vector<Requirement>& list);
  void atom(const Formula& formula, const Binding& binding, bool positive, std::vector<Requirement>& list);
  void comparison(const Formula& formula, Binding& binding, bool positive, std::vector<Requirement>& list);

  const Definition& definition_;
  LiftedState initial_;
  std::function<bool()> stop_;  // may be empty
  std::uint64_t steps_ = 0;
  bool stopped_ = false;
};

}  // namespace stepwright::pddl
