#pragma once

// Semi-naive evaluation of join rules: every fact that arrives is joined with those that came before it, so
// that each binding is found once, by the last of the facts that it needs. At every step of a join the atom
// with the fewest matching facts comes next.
//
// Thread rule: one grounding, one joiner.
//
//   Joiner joiner(definition, rules, [&](const JoinRule& rule, Binding& binding) { ...; return true; });
//   joiner.start();
//   joiner.arrive(fact);

#include <functional>
#include <vector>

#include "supervisor/pddl/definition/fact_relation.h"
#include "supervisor/pddl/definition/text.h"
#include "supervisor/pddl/grounding/join_rule.h"
#include "supervisor/pddl/lifted/lifted_state.h"

namespace stepwright::pddl {

class Joiner {
 public:
  // Called for every binding whose atoms have arrived and whose filters hold; false stops everything.
  using Visit = std::function<bool(const JoinRule&, Binding&)>;

  Joiner(const Definition& definition, const std::vector<JoinRule>& rules, Visit visit);

  // The bindings of rules without dynamic atoms. False if stopped.
  bool start();

  // A dynamic fact, once. False if stopped.
  bool arrive(const Atom& fact);

 private:
  struct Trigger {
    std::size_t rule = 0;
    std::size_t atom = 0;
  };
  // The join under way.
  struct Frame {
    const JoinRule* rule = nullptr;
    const std::vector<int>* types = nullptr;
    std::size_t trigger = 0;    // the atom that the newest fact matches
    std::vector<bool> done;     // atoms
    std::vector<bool> checked;  // filters
    Binding binding;
  };

  void begin(const JoinRule& rule);
  bool extend();
  bool try_row(std::size_t atom, std::size_t row);
  bool enumerate();
  bool unify(std::size_t atom, std::size_t row, std::vector<int>& bound);
  bool bind(int slot, int object, std::vector<int>& bound);
  void undo(const std::vector<int>& bound, const std::vector<std::size_t>& checked);
  bool filters_hold(std::vector<std::size_t>& checked);
  bool decided(const JoinFilter& filter) const;
  bool holds_now(const Formula& formula);
  std::uint64_t bound_columns(const JoinAtom& atom);
  std::size_t matches(std::size_t atom);
  bool is_excluded(std::size_t atom, std::size_t row);
  FactRelation& relation(int predicate) { return relations_[static_cast<std::size_t>(predicate)]; }

  const Definition& definition_;
  const std::vector<JoinRule>& rules_;
  Visit visit_;
  LiftedState initial_;
  std::vector<FactRelation> relations_;          // by predicate
  std::vector<std::vector<Trigger>> triggers_;   // by predicate
  std::vector<std::vector<int>> types_of_slot_;  // by rule: the type of every slot, -1 for none
  std::vector<std::vector<bool>> fits_;          // by type and object
  Frame frame_;
  std::vector<int> key_;
};

}  // namespace stepwright::pddl
