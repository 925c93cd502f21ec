#pragma once

// From schemas and a binding to numbered conditions, expressions and operators. What no action changes is
// decided here.
//
// Thread rule: one grounding, one compiler. The numbering is in the order of first use, so it is the same in
// every run.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "supervisor/pddl/definition/atom_table.h"
#include "supervisor/pddl/definition/text.h"
#include "supervisor/pddl/ground_task/ground_task.h"

namespace stepwright::pddl {

class Compiler {
 public:
  // `stop` is asked now and then while quantifiers are multiplied out; it must outlive the compiler.
  Compiler(const Definition& definition, const std::function<bool()>& stop);

  // Since `stop` said so nothing is complete any more, and nothing that is returned means anything.
  bool stopped() const { return stopped_; }

  // Nothing if static facts or fluents forbid the action for these objects.
  std::optional<GroundOperator> compile(int action, Binding& binding);

  // The axiom with these conjuncts as its body. Nothing if what never changes forbids it.
  std::optional<GroundAxiom> compile(const Axiom& axiom, const std::vector<const Formula*>& conjuncts,
                                     Binding& binding);

  Condition condition(const Formula& formula, Binding& binding);
  GroundExpression expression(const Expression& expression, const Binding& binding);

  // The number of a dynamic fact or fluent, given at its first use.
  int fact(const Atom& atom) { return facts_.intern(atom); }
  int variable(const Atom& atom) { return variables_.intern(atom); }

  const std::vector<Atom>& facts() const { return facts_.atoms(); }
  const std::vector<Atom>& variables() const { return variables_.atoms(); }

  bool holds_initially(const Atom& fact) const { return initial_.find(fact) >= 0; }

 private:
  void add(const Formula& formula, Binding& binding, bool positive, Condition& condition);
  void add_atom(const Formula& formula, const Binding& binding, bool positive, Condition& condition);
  void add_comparison(const Formula& formula, const Binding& binding, bool positive, Condition& condition);
  void add_choice(std::vector<Condition> options, Condition& condition);
  void add_parts(const Formula& formula, Binding& binding, bool positive, Condition& condition);
  std::vector<Condition> options(const Formula& formula, Binding& binding, bool positive);
  void effects(const Effect& effect, Binding& binding, std::size_t target, GroundOperator& op);
  void conditional(const Effect& effect, Binding& binding, std::size_t target, GroundOperator& op);

  // The objects of the call's arguments, valid until the next call.
  std::span<const int> objects(const Call& call, const Binding& binding);

  bool time_to_stop();

  const Definition& definition_;
  const std::function<bool()>& stop_;
  std::uint64_t bindings_ = 0;
  bool stopped_ = false;
  AtomTable facts_, variables_;
  AtomTable initial_;  // facts
  AtomTable fluents_;  // with an initial value ...
  std::vector<double> values_;
  std::vector<int> objects_;
};

}  // namespace stepwright::pddl
