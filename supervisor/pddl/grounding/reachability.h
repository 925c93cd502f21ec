#pragma once

// Relaxed reachability while the operators are being found: which literals can ever hold, between which ends
// every variable stays, which operators can ever be applied. Deletes are ignored and variables are intervals,
// so what is unreachable here is unreachable. Whoever waits, waits for one thing that is missing and is
// looked at again when it comes.
//
// Thread rule: one grounding, one object.
//
//   Reachability reach(raw, compiler);
//   while (reach.next(fact)) join(fact);      // the join calls add_operator and add_axiom

#include <cstdint>
#include <string>
#include <unordered_set>
#include <vector>

#include "supervisor/pddl/grounding/compiler.h"
#include "supervisor/pddl/grounding/raw_task.h"

namespace stepwright::pddl {

class Reachability {
 public:
  // Fills raw.operators, raw.axioms and raw.reachable.
  Reachability(RawTask& raw, const Compiler& compiler);

  void add_operator(GroundOperator op);
  void add_axiom(GroundAxiom axiom);

  // The next fact that has become reachable, once each; false when nothing more happens. Ends because
  // intervals that grow for long are widened to the end that the preconditions imply, or to kInfinity.
  bool next(int& fact);

  // Facts and variables that were named since: their initial values.
  void grow_tables();

 private:
  // An operator's precondition (effect == -1), one of its effects, or an axiom (op == -1, effect = which).
  struct Unit {
    int op = 0;
    int effect = 0;
  };

  // A unit in a list of those that wait for something. It counts only while the unit's stamp is this one, so
  // that a unit that waits in several lists is called once, whichever comes first.
  struct Waiting {
    Unit unit;
    std::uint32_t stamp = 0;
  };

  // A numeric change of an effect that has fired. Changes that say the same are one: in most tasks many
  // operators fill the same tank in the same way.
  struct Growth {
    int variable = 0;
    BoundedExpression result;
    bool due = true;
  };

  const Condition& condition(Unit unit) const;
  bool possible_now(const Condition& condition, Unit unit);
  void look_at(Unit unit);
  void call(std::vector<Waiting>& list);
  std::uint32_t& stamp(Unit unit);
  bool has_fired(Unit unit) const;
  void fire(Unit unit);
  void fire_effect(Unit unit);
  void add_sums(Unit unit, int variable);
  void add_growth(int variable, BoundedExpression result);
  void reach(int literal);
  void round();
  bool grow(const Growth& growth);
  void watch(const GroundExpression& expression, Unit unit);
  RelaxedState& state() { return raw_.reachable.state; }
  const RelaxedState& state() const { return raw_.reachable.state; }

  RawTask& raw_;
  const Compiler& compiler_;
  std::vector<std::vector<Waiting>> waiting_;          // by literal
  std::vector<std::vector<Waiting>> waiting_numbers_;  // by variable
  std::vector<std::vector<std::size_t>> dependents_;   // by variable: growths that read it
  std::vector<Growth> growths_;
  std::unordered_set<std::string> known_growths_;
  std::vector<std::size_t> due_;
  std::vector<Unit> ready_;
  std::vector<std::uint32_t> operator_stamps_, effect_stamps_, axiom_stamps_;
  std::vector<std::size_t> first_effect_;  // of every operator in fired_
  std::vector<bool> fired_;                // effects
  std::vector<int> arrived_;               // facts, from next_
  std::size_t next_ = 0;
  int round_ = 0;
};

}  // namespace stepwright::pddl
