#pragma once

// A relaxed plan along the cheapest supporters of the additive heuristic (Keyder, Geffner 2008, "Heuristics
// for planning with action costs revisited"). A comparison of numbers is reached by repeating one unit that
// moves it (Scala, Haslum, Thiebaux 2016, "Heuristics for numeric planning via subgoaling").
//
// Thread rule: one search, one object: it reuses its memory.
//
//   AdditiveHeuristic heuristic(relaxed, weights);
//   if (heuristic.evaluate(state)) use(heuristic.estimate(), heuristic.helpful());

#include <vector>

#include "supervisor/pddl/search/bucket_queue.h"
#include "supervisor/pddl/search/relaxed_task.h"

namespace stepwright::pddl {

class AdditiveHeuristic {
 public:
  // `weights`: what one application of each operator counts, at least 0.
  AdditiveHeuristic(const RelaxedTask& task, std::vector<int> weights);

  // False if no plan exists from the state (proved).
  bool evaluate(const Word* state) { return evaluate(state, task_.goal()); }
  // The same towards other atoms.
  bool evaluate(const Word* state, const std::vector<int>& goal);

  // Of the last evaluation. The relaxed plan: operators with how often each is applied, those with cheaper
  // needs first; its weight and its number of steps; its operators that are applicable at once.
  struct Use {
    int op;
    int times;
    int needs_cost;
  };
  const std::vector<Use>& plan() const { return plan_; }
  int estimate() const { return estimate_; }
  int steps() const { return steps_; }
  const std::vector<int>& helpful() const { return helpful_; }

 private:
  static constexpr int kFar = 1'000'000'000;

  void start(const Word* state, const std::vector<int>& goal);
  bool propagate(std::size_t goals);
  void reach(int atom, int cost, int unit, int times);
  void fire(int unit);
  void move(const Mover& mover);
  void extract(const std::vector<int>& goal);
  void want(int atom);

  const RelaxedTask& task_;
  std::vector<int> weights_;
  const Word* state_ = nullptr;
  // Per unit: needs that are not reached yet, the sum of the costs of those that are, what it weighs itself.
  struct UnitEntry {
    int lacking;
    int needs_cost;
    int weight;
  };
  std::vector<UnitEntry> fresh_units_, units_;
  // Per atom: cost, the unit that reaches it and how often; closed once it has been expanded.
  struct AtomEntry {
    int cost;
    int unit;
    int times;
    bool closed;
  };
  std::vector<AtomEntry> atoms_;
  std::vector<bool> is_goal_;
  BucketQueue<int> queue_;
  std::vector<int> stack_;
  std::vector<int> wanted_, used_;  // evaluation in which an atom was wanted, a unit used
  std::vector<int> place_;          // of a used unit in plan_
  int evaluation_ = 0;
  std::vector<Use> plan_;
  std::vector<int> helpful_, helpful_mark_;
  int estimate_ = 0, steps_ = 0;
};

// Every operator counts one.
std::vector<int> unit_weights(const GroundTask& task);

// Operators count by their least cost, scaled so that a plan's sum stays small, plus one.
std::vector<int> cost_weights(const GroundTask& task);

// What a cost of one weighs; 0 if weights do not tell costs.
double weight_scale(const GroundTask& task, const std::vector<int>& weights);

}  // namespace stepwright::pddl
