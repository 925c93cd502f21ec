#pragma once

// The facts that the axioms of one layer derive, semi-naively: every new fact is joined once with those that
// there are. At every step of a join the atom with the fewest facts comes next.
//
// Thread rule: one derivation, one thread. Shares nothing with the planner's grounder but the table of facts.
//
//   FactTables tables(definition, state);
//   Derivation(definition, rules, tables, state).run();

#include <deque>
#include <vector>

#include "supervisor/pddl/definition/fact_relation.h"
#include "supervisor/pddl/definition/text.h"
#include "supervisor/pddl/lifted/axiom_rule.h"
#include "supervisor/pddl/lifted/lifted_state.h"

namespace stepwright::pddl {

// The facts of a state by predicate.
class FactTables {
 public:
  FactTables(const Definition& definition, const LiftedState& state);

  void add(const Atom& fact) { of(fact.symbol).add(fact.arguments); }
  FactRelation& of(int predicate) { return tables_[static_cast<std::size_t>(predicate)]; }

 private:
  std::vector<FactRelation> tables_;
};

class Derivation {
 public:
  // `tables` has the facts of `state`; both get the derived ones.
  Derivation(const Definition& definition, const std::vector<AxiomRule>& rules, FactTables& tables,
             LiftedState& state);

  void run();

 private:
  void begin(const AxiomRule& rule);
  void join_all(const AxiomRule& rule);
  void join_newest(const AxiomRule& rule, std::size_t atom);
  void spread();
  void extend();
  void try_row(std::size_t atom, std::size_t row);
  void enumerate();
  void conclude();
  bool bind(int slot, int object, std::vector<int>& bound);
  bool unify(const Call& atom, std::size_t row, std::vector<int>& bound);
  bool tests_hold(std::vector<std::size_t>& judged);
  void undo(const std::vector<int>& bound, const std::vector<std::size_t>& judged);
  std::uint64_t bound_columns(const Call& atom);
  std::size_t matches(const Call& atom);

  const Definition& definition_;
  const std::vector<AxiomRule>& rules_;
  FactTables& tables_;
  LiftedState& state_;
  std::deque<Atom> new_;
  // The join under way.
  const AxiomRule* rule_ = nullptr;
  Binding binding_;
  std::vector<int> type_of_slot_;
  std::vector<bool> done_;    // atoms
  std::vector<bool> judged_;  // tests
  std::vector<int> key_;
};

}  // namespace stepwright::pddl
