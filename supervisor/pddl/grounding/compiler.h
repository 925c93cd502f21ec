#pragma once

// From schemas and a binding to numbered conditions, expressions and operators. What no action changes is
// decided here.
//
// Thread rule: one grounding, one compiler. The numbering is in the order of first use, so it is the same in
// every run.

#include <map>
#include <optional>
#include <vector>

#include "supervisor/pddl/grounding/ground_task.h"
#include "supervisor/pddl/syntax/text.h"

namespace stepwright::pddl {

class Compiler {
 public:
  explicit Compiler(const Definition& definition) : definition_(definition) {}

  // Nothing if static facts or fluents forbid the action for these objects.
  std::optional<GroundOperator> compile(int action, Binding& binding);

  // Nothing if what never changes forbids it.
  std::optional<GroundAxiom> compile(const Axiom& axiom, Binding& binding);

  Condition condition(const Formula& formula, Binding& binding);
  GroundExpression expression(const Expression& expression, const Binding& binding);

  // The number of a dynamic fact or fluent, given at its first use.
  int fact(const Atom& atom);
  int variable(const Atom& atom);

  const std::vector<Atom>& facts() const { return facts_; }
  const std::vector<Atom>& variables() const { return variables_; }

 private:
  void add(const Formula& formula, Binding& binding, bool positive, Condition& condition);
  void add_atom(const Formula& formula, const Binding& binding, bool positive, Condition& condition);
  void add_comparison(const Formula& formula, const Binding& binding, bool positive, Condition& condition);
  void add_choice(std::vector<Condition> options, Condition& condition);
  void add_parts(const Formula& formula, Binding& binding, bool positive, Condition& condition);
  std::vector<Condition> options(const Formula& formula, Binding& binding, bool positive);
  void effects(const Effect& effect, Binding& binding, std::size_t target, GroundOperator& op);
  void conditional(const Effect& effect, Binding& binding, std::size_t target, GroundOperator& op);

  const Definition& definition_;
  std::vector<Atom> facts_, variables_;
  std::map<Atom, int> fact_ids_, variable_ids_;
};

}  // namespace stepwright::pddl
