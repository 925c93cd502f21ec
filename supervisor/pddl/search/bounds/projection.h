#pragma once

// The task seen through a few of its facts and variables only: what the others would forbid is allowed. Its
// state space is small enough to be searched completely, so that exact distances there bound the distances of
// the task from below (pattern databases, Edelkamp 2001, "Planning with pattern databases", here with numeric
// variables).
//
// Thread rule: `build` once, then immutable, except for the scratch of `find`.

#include <functional>
#include <optional>
#include <vector>

#include "supervisor/pddl/ground_task/relaxed_bounds.h"
#include "supervisor/pddl/search/space/node_store.h"
#include "supervisor/pddl/search/space/state_space.h"

namespace stepwright::pddl {

struct Pattern {
  std::vector<int> facts;      // ascending
  std::vector<int> variables;  // ascending
  friend bool operator==(const Pattern&, const Pattern&) = default;
};

class Projection {
 public:
  // Nothing if the projected space has more states than `most_states`, costs more than `most_work` operator
  // checks, or if an effect on the pattern depends on what it leaves out.
  static std::optional<Projection> build(const StateSpace& space, Pattern pattern, std::size_t most_states,
                                         std::size_t most_work);

  const Pattern& pattern() const { return pattern_; }
  std::size_t states() const { return nodes_.size(); }

  // The operators that change the pattern.
  const std::vector<int>& operators() const { return operators_; }

  // Least sum of weights from every projected state to a projected goal; kInfinity without a way. `weight` is
  // asked with an operator and the least that it costs there, and must not be negative.
  std::vector<double> distances(const std::function<double(int op, double cost)>& weight) const;

  // The number of the projected state; kNoNode if it is not known.
  std::uint32_t find(const Word* state) const;

 private:
  struct Transition {
    std::uint32_t from, to;
    std::int32_t op;
    double cost;
  };

  Projection(const StateSpace& space, Pattern pattern);
  bool explore(std::size_t most_states, std::size_t most_work);
  bool expand(std::uint32_t node);
  bool branch(const GroundOperator& op, std::size_t effect, std::vector<Word> state, double cost,
              std::uint32_t from, std::int32_t index);
  bool apply(const GroundEffect& effect, std::vector<Word>& state) const;
  void add_facts(std::vector<Word>& state) const;
  bool certain(const Condition& condition) const;
  bool relevant(const GroundOperator& op) const;
  void unpack(const Word* projected);
  double value_of(const Word* projected, std::size_t place) const;

  const StateSpace* space_;
  Pattern pattern_;
  std::size_t fact_words_;
  std::vector<int> fact_place_, variable_place_;  // -1 = not in the pattern
  std::vector<int> operators_;
  NodeStore nodes_;
  std::vector<Transition> transitions_;
  std::vector<std::uint32_t> goals_;
  std::vector<const GroundEffect*> fired_;  // of the operator that is being applied
  RelaxedState relaxed_;  // the projected state being expanded, as a relaxed state of the task
  mutable std::vector<Word> key_;
};

}  // namespace stepwright::pddl
