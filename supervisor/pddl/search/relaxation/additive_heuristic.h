#pragma once

// A relaxed plan along the cheapest supporters of the additive heuristic (Keyder, Geffner 2008, "Heuristics
// for planning with action costs revisited"). A comparison of numbers is reached by repeating one unit that
// moves it (Scala, Haslum, Thiebaux 2016, "Heuristics for numeric planning via subgoaling").
//
// Thread rule: one search, one object: it reuses its memory.
//
// An operator's cost may depend on the state: its cost in the evaluated state counts, so that relaxed plans
// do not choose an operator that is cheap only elsewhere.
//
//   AdditiveHeuristic heuristic(relaxed, cost_weights(task));
//   if (heuristic.evaluate(state)) use(heuristic.estimate(), heuristic.helpful());

#include <vector>

#include "supervisor/pddl/search/relaxation/bucket_queue.h"
#include "supervisor/pddl/search/relaxation/relaxed_task.h"

namespace stepwright::pddl {

// Weight of one application of each operator.
struct OperatorWeights {
  std::vector<int> of;  // at least 0; of its least cost, if the cost depends on the state
  double scale = 0.0;   // what a cost of one counts; 0: costs count nothing

  int weight(double cost) const;  // of one application that costs so much
};

class AdditiveHeuristic {
 public:
  AdditiveHeuristic(const RelaxedTask& task, OperatorWeights weights);

  // False if no plan exists from the state (proved). `without`: facts that other ones make needless
  // (exchange_pruning.h), by word; null: none.
  bool evaluate(const Word* state, const Word* without = nullptr);

  // From now on towards these atoms and comparisons instead of the task's goal.
  void aim(std::vector<int> atoms, std::vector<Comparison> comparisons);

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

  struct Varying {
    int op;
    std::vector<int> units;
  };

  void find_varying();
  void weigh();
  void start(const Word* without);
  bool propagate();
  void reach(int atom, int cost, int unit, int times);
  void fire(int unit);
  void move(const Mover& mover);
  void extract();
  void want(int atom);
  const Comparison& comparison(int atom) const;

  const RelaxedTask& task_;
  OperatorWeights weights_;
  std::vector<Varying> varying_;  // operators whose costs depend on the state
  std::vector<int> goal_;
  std::vector<Comparison> targets_;  // their atoms come behind those of the task
  PackedLists<Mover> towards_;       // by unit; empty without targets
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
OperatorWeights unit_weights(const GroundTask& task);

// Operators count by their cost, scaled so that a plan's sum stays small, plus one.
OperatorWeights cost_weights(const GroundTask& task);

}  // namespace stepwright::pddl
