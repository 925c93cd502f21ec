#pragma once

// Footprints of operators: what they read and write, and so which of them get in each other's way. Of two
// operators that do not, either can be applied after the other wherever both can, and both orders lead to the
// same state for the same cost.
//
// Thread rule: one owner: interference is worked out when it is asked for, and kept.
//
//   OperatorFootprints footprints(space);
//   for (const int other : footprints.interfering(op)) ...

#include <vector>

#include "supervisor/pddl/search/space/state_space.h"

namespace stepwright::pddl {

class OperatorFootprints {
 public:
  explicit OperatorFootprints(const StateSpace& space);

  // The operators that may disable the operator, that it may disable, or with which the order matters. Those
  // whose preconditions exclude each other are not among them: they never meet.
  const std::vector<int>& interfering(int op);

  // The operators that may make the literal true.
  const std::vector<int>& achievers(int literal) const {
    return (literal % 2 == 0 ? adders_ : deleters_)[static_cast<std::size_t>(literal / 2)];
  }

  // Those that may bring the comparison nearer to holding, or any option of the choice: in no order, some
  // perhaps twice.
  void add_achievers(const Comparison& comparison, std::vector<int>& operators) const;
  void add_achievers(const std::vector<Condition>& choice, std::vector<int>& operators) const;

  // Bytes held by the lists of interfering operators.
  std::size_t memory() const { return interfering_entries_ * sizeof(int); }

 private:
  struct Write {
    int variable;
    bool additive;
    Interval change;  // by one application; of no meaning if not additive
  };
  struct Footprint {
    std::vector<int> adds, deletes;               // facts that it may make true, may make false
    std::vector<int> read_facts, read_variables;  // any change of them matters
    std::vector<Write> writes;
    std::vector<std::pair<int, int>> values;  // finite-domain variable and fact that it asks for, ascending
    std::vector<int> interfering;
    bool known = false;
  };

  void collect(const GroundOperator& op, Footprint& print) const;
  void read(const Condition& condition, Footprint& print) const;
  void read(const GroundExpression& expression, Footprint& print) const;
  void enter(int op);
  void find_interfering(int op);
  void find_disturbed(int op);
  void find_disturbing(int op);
  void add(int op, int other);
  void add(int op, const std::vector<int>& others);
  bool never_meet(const Footprint& a, const Footprint& b) const;
  bool hurts(int writer, const Comparison& comparison) const;
  bool helps(int writer, const Comparison& comparison) const;
  const GroundOperator& ground(int op) const { return task_.operators[static_cast<std::size_t>(op)]; }
  Footprint& print(int op) { return prints_[static_cast<std::size_t>(op)]; }
  const Footprint& print(int op) const { return prints_[static_cast<std::size_t>(op)]; }

  const GroundTask& task_;
  const FiniteDomains& domains_;
  std::vector<Footprint> prints_;
  // Operators by fact: ...
  std::vector<std::vector<int>> adders_, deleters_, fact_readers_;
  std::vector<std::vector<int>> askers_;  // ... by literal of the precondition
  // ... by variable: that write it, read it, compare it in the precondition
  std::vector<std::vector<int>> writers_, readers_, comparers_;
  std::vector<std::uint32_t> seen_;  // by operator: the last call of find_interfering that met it
  std::uint32_t call_ = 0;
  std::size_t interfering_entries_ = 0;
};

}  // namespace stepwright::pddl
