#pragma once

// The baseline of grounding: the bindings that the static part of a condition allows, parameter by parameter.
// Facts that actions make true are not joined, so that it also meets combinations that can never be reached.
//
// Thread rule: one grounding, one object per schema.

#include <functional>
#include <map>
#include <vector>

#include "supervisor/pddl/lifted/evaluate.h"

namespace stepwright::pddl {

class BindingEnumerator {
 public:
  BindingEnumerator(const Definition& definition, const Action& action, const LiftedState& initial);
  BindingEnumerator(const Definition& definition, const Axiom& axiom, const LiftedState& initial);

  // Calls `visit` for every allowed binding until it answers false. False if stopped.
  bool run(const std::function<bool(Binding&)>& visit);

 private:
  // A static fact of the precondition that proposes objects for one parameter, given the others: the objects
  // by the values of the other arguments.
  struct Index {
    std::vector<const Term*> keys;
    std::map<std::vector<int>, std::vector<int>> objects;
  };
  struct Level {
    std::size_t parameter = 0;
    std::vector<const Formula*> checks;  // decided once this parameter is bound
    std::vector<Index> indexes;
  };

  BindingEnumerator(const Definition& definition, const std::vector<Typed>& parameters, int slots,
                    const Formula& condition, const LiftedState& initial);
  void collect_static(const Formula& formula);
  void order_parameters();
  std::size_t next_parameter(const std::vector<bool>& bound) const;
  void fill(Level& level, const std::vector<bool>& bound);
  void index_fact(Level& level, const Call& call);
  const std::vector<int>& candidates(const Level& level) const;
  bool descend(std::size_t depth, const std::function<bool(Binding&)>& visit);

  const Definition& definition_;
  const std::vector<Typed>& parameters_;
  const LiftedState& initial_;
  std::vector<const Formula*> static_conjuncts_;
  std::vector<Level> levels_;
  Binding binding_;
};

}  // namespace stepwright::pddl
