#pragma once

// Objects that can change places: exchanging two of them everywhere turns the task into itself, whatever the
// initial state says of them (two trucks of the same size, papers that go to the same room). What can be
// done from a state can be done, for the same cost, from every state in which they have changed places
// (symmetry reduction; Pochter, Zohar, Rosenschein 2011, "Exploiting problem symmetries in state-based
// planners").
//
// Only sets of which no fact and no fluent mentions two are looked for. Large tasks are not looked into.
//
// Thread rule: immutable, except for the scratch of `arrange`.
//
//   Interchangeable objects(space);
//   objects.arrange(state);   // the same for all states that differ by exchanges within one set

#include <vector>

#include "supervisor/pddl/search/state_space.h"

namespace stepwright::pddl {

class Interchangeable {
 public:
  explicit Interchangeable(const StateSpace& space);

  bool none() const { return sets_.empty(); }

  // Objects by set, as indices into the definition's objects.
  const std::vector<std::vector<int>>& objects() const { return objects_; }

  // Variables of which one takes the other's place.
  std::vector<std::pair<int, int>> exchanged_variables() const;

  // Exchanges objects until those of every set are in the order of what the state says of them.
  void arrange(Word* state) const;

 private:
  // What mentions an object, in the same order for all objects of a set.
  struct Mentions {
    std::vector<int> facts, variables;
  };
  using Set = std::vector<Mentions>;

  void arrange(const Set& set, Word* state) const;

  std::size_t fact_words_;
  std::vector<std::vector<int>> objects_;
  std::vector<Set> sets_;
  mutable std::vector<std::vector<Word>> profiles_;
};

}  // namespace stepwright::pddl
