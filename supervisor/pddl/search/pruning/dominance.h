#pragma once

// States that another one makes needless: the same facts, at least as much of everything that is only ever
// good to have (fuel, memory, free seats), reached at no more cost in no more steps. Whatever a plan does
// from such a state it can do from the other one too (resource dominance; Torralba 2017, "From qualitative to
// quantitative dominance pruning for optimal planning", has the idea in general).
//
// More of a fluent is good if every condition that reads it asks for more, if no amount, cost, axiom or
// condition of an effect reads it, and if it only grows, shrinks or gets constants. One exception: filling
// up, an operator that only sets the fluent to a constant, may ask for less than that: whoever has as much
// leaves it out.
//
// The other state may have interchangeable objects in other places: both are compared with these arranged.
//
// Thread rule: one search, one object. Costs of operators must not be negative.
//
//   Dominance dominance(space);
//   if (dominance.prunes(node, state, nodes)) ...   // no better plan through it than through another state

#include <unordered_map>
#include <vector>

#include "supervisor/pddl/search/pruning/interchangeable.h"
#include "supervisor/pddl/search/space/state_table.h"

namespace stepwright::pddl {

enum class Preference : std::int8_t { Less = -1, Exact = 0, More = 1 };

// Of every variable: is more or less of it never worse?
std::vector<Preference> preferences(const GroundTask& task);

class Dominance {
 public:
  explicit Dominance(const StateSpace& space);

  // False if no fluent is preferred more or less and no objects can change places: then nothing is ever
  // pruned.
  bool useful() const { return !resources_.empty() || symmetric_; }

  // Is the node of `nodes` needless beside those that were asked about before and that are not? `state` is
  // its state.
  bool prunes(std::uint32_t node, const Word* state, const StateTable& nodes);

  // Bytes held.
  std::size_t memory() const;

 private:
  struct Resource {
    std::size_t word;
    double sign;  // 1: more is better
  };
  struct Entry {
    std::uint32_t node;
    std::uint32_t next;  // with the same hash
  };

  std::uint64_t hash_of_rest(const Word* state) const;
  bool same_rest(const Word* a, const Word* b) const;
  bool enough(std::size_t entry, const Word* state) const;
  bool as_much(std::size_t entry, const Word* state) const;

  const Interchangeable objects_;
  bool symmetric_;
  std::vector<Resource> resources_;
  std::vector<bool> is_resource_;  // by word
  std::unordered_map<std::uint64_t, std::uint32_t> heads_;
  std::vector<Entry> entries_;
  std::vector<double> amounts_;  // by entry, all resources, the more the better
  std::vector<Word> asked_, other_;
};

}  // namespace stepwright::pddl
