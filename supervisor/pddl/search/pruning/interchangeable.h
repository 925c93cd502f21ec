#pragma once

// Objects that can change places: exchanging two of them everywhere turns the task into itself, whatever the
// state says of them (two trucks of the same size, papers that go to the same room). What can be done from a
// state can be done, for the same cost, from every state in which they have changed places (symmetry
// reduction; Pochter, Zohar, Rosenschein 2011, "Exploiting problem symmetries in state-based planners").
//
// Objects that operators tell apart change places from where on these can never be applied any more
// (object_sets.h).
//
// Thread rule: immutable, except for the scratch of `arrange` and `find_twins`: one copy for each thread.
//
//   Interchangeable objects(space);
//   objects.arrange(state);   // the same for all states that differ by exchanges within one set

#include <vector>

#include "supervisor/pddl/search/pruning/object_sets.h"

namespace stepwright::pddl {

// Two objects of a set of which the state says the same.
struct Twin {
  int object = 0;
  int first = 0;                            // the first one like it
  const std::vector<int>* facts = nullptr;  // that mention the object, if the first one is enough to
                                            // see what can be reached; null otherwise
};

class Interchangeable {
 public:
  explicit Interchangeable(const StateSpace& space, const SetLimits& limits = {});

  bool none() const { return sets_.empty(); }
  const std::vector<ExchangeSet>& sets() const { return sets_; }

  // Variables of which one takes the other's place.
  std::vector<std::pair<int, int>> exchanged_variables() const;

  // Exchanges objects until those of every set are in the order of what the state says of them.
  void arrange(Word* state) const;

  // All objects that have an earlier twin.
  void find_twins(const Word* state, std::vector<Twin>& twins) const;

 private:
  void choose_members(const ExchangeSet& set, const Word* state) const;
  bool parted(const ExchangeMember& member, const Word* state) const;
  void read_profiles(const Word* state) const;
  void arrange(const ExchangeSet& set, Word* state) const;

  const StateSpace& space_;
  ValueOrder order_;
  std::vector<ExchangeSet> sets_;
  // Of the set that is looked at: members that can change places in the state, what it says of each.
  mutable std::vector<const ExchangeMember*> members_;
  mutable std::vector<std::vector<Word>> profiles_;
  mutable std::vector<std::size_t> ranks_;
};

}  // namespace stepwright::pddl
