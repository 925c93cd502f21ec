#pragma once

// An admissible bound: disjoint sets of operators of which every plan applies one, each counting what the
// cheapest of the set still costs (Helmert, Domshlak 2009, "Landmarks, critical paths and abstractions"). The
// units of one operator share its cost.
//
// A comparison of numbers may need its movers several times (Kuroiwa, Shleyfman, Piacentini, Castro, Beck
// 2022, "The LM-cut heuristic family for optimal numeric planning with simple conditions"): a mover that
// gains a third of what is missing counts a third.
//
// Thread rule: one search, one object: it reuses its memory.
//
//   LandmarkCut bound(relaxed);
//   if (bound(state) == kInfinity) ...   // no plan from here

#include <functional>
#include <vector>

#include "supervisor/pddl/search/bounds/cost_unit.h"
#include "supervisor/pddl/search/relaxation/relaxed_task.h"

namespace stepwright::pddl {

// In every plan the sum of weight x applications over these operators is at least 1.
struct OperatorLandmark {
  std::vector<int> operators;
  std::vector<double> weights;  // above 0, at most 1
};

class LandmarkCut {
 public:
  // When `stop` says so, which is asked after every set, a bound is what has been counted so far.
  explicit LandmarkCut(const RelaxedTask& task, std::function<bool()> stop = {});

  // The cost of every plan from the state is at least this.
  double operator()(const Word* state) {
    total_ = bound(state, costs_, nullptr);
    return rounded_up(total_, unit_);
  }

  // Of the state that was asked about last: every plan from it that applies the operator costs at least this.
  double cost_through(int op) const { return rounded_up(total_ + rest(op), unit_); }

  // The same under other costs, one per operator, none negative; `found` hears of every set.
  double operator()(const Word* state, std::span<const double> costs,
                    const std::function<void(const OperatorLandmark&)>& found) {
    return bound(state, costs, &found);
  }

  // Remaining cost of an operator after the sets of the last bound. A plan from that state that applies the
  // operator costs at least the bound and this.
  double rest(int op) const { return remaining_[static_cast<std::size_t>(op)]; }

  // The least that every operator costs in any reachable state.
  std::span<const double> costs() const { return costs_; }

 private:
  // A comparison that a unit may bring about, by its atom, and by how much all units of the unit's operator
  // bring it nearer at most.
  struct Reach {
    int atom;
    double up, down;
  };
  struct Unit {
    int op;  // index into remaining_; the last one is free
    int lacking;
    double supporter_cost;
  };
  struct Entry {
    double cost;
    int atom;
    bool operator>(const Entry& other) const { return cost > other.cost; }
  };

  void connect(const RelaxedTask& task);
  double bound(const Word* state, std::span<const double> costs,
               const std::function<void(const OperatorLandmark&)>* found);
  void measure_gaps(const Word* state);
  double applications(const Reach& reach) const;
  void spread(std::size_t unit);
  void explore(const Word* state);
  void explore_again();
  void improve(int atom, double cost);
  bool pop(int& atom);
  void find_supporter(std::size_t unit);
  double cost_of(const Unit& unit) const { return remaining_[static_cast<std::size_t>(unit.op)]; }
  double cost_of(const Unit& unit, const Reach& reach) const;
  void mark_goal_zone(int atom);
  bool leads(int unit, int atom) const;
  void find_cut(const Word* state);
  void enter(std::size_t unit);
  void enter_operator(int op, double weight);
  void enter_before(int atom);
  double pay_cut();

  const RelaxedTask& task_;
  std::function<bool()> stop_;  // may be empty
  std::vector<double> costs_;   // by operator
  double unit_ = 0.0;           // of which all of them are multiples; 0: none
  double total_ = 0.0;          // of the last bound under these
  // By unit: atoms that it reaches by itself; comparisons.
  PackedLists<int> reached_atoms_;
  PackedLists<Reach> reached_numbers_;
  PackedLists<int> reached_by_, needed_by_, units_of_;
  // By comparison: what all its movers gain alike, upwards and downwards; 0 if they differ. Is its difference
  // always an integer?
  std::vector<double> alike_up_, alike_down_;
  std::vector<bool> integer_;
  std::vector<Gap> gaps_;  // by comparison, in the state
  std::vector<int> goal_;
  int goal_atom_;
  std::vector<double> remaining_, cost_;  // by operator; by atom
  std::vector<Unit> units_;
  std::vector<int> supporter_;  // by unit: the dearest of its needs
  std::vector<Entry> heap_;
  std::vector<char> zone_;  // by atom: 0 unknown, 1 leads to the goal for nothing, 2 before that
  std::vector<int> stack_;
  OperatorLandmark cut_;
  std::vector<double> weight_;  // by operator: in the cut; 0: not in it
};

}  // namespace stepwright::pddl
