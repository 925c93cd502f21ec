#pragma once

// An admissible bound: disjoint sets of operators of which every plan applies one, each counting what the
// cheapest of the set still costs (Helmert, Domshlak 2009, "Landmarks, critical paths and abstractions"). The
// units of one operator share its cost. A comparison counts as reached by one application of a mover.
//
// Thread rule: one search, one object: it reuses its memory.
//
//   LandmarkCut bound(relaxed);
//   if (bound(state) == kInfinity) ...   // no plan from here

#include <vector>

#include "supervisor/pddl/search/relaxed_task.h"

namespace stepwright::pddl {

class LandmarkCut {
 public:
  explicit LandmarkCut(const RelaxedTask& task);

  // The cost of every plan from the state is at least this.
  double operator()(const Word* state);

 private:
  struct Unit {
    int op;  // index into remaining_; the last one is free
    int lacking;
    int supporter;  // the dearest of its needs
    double supporter_cost;
  };
  struct Entry {
    double cost;
    int atom;
    bool operator>(const Entry& other) const { return cost > other.cost; }
  };

  void explore(const Word* state);
  void explore_again();
  void improve(int atom, double cost);
  bool pop(int& atom);
  void find_supporter(Unit& unit, std::size_t index);
  double cost_of(const Unit& unit) const { return remaining_[static_cast<std::size_t>(unit.op)]; }
  void mark_goal_zone(int atom);
  double find_cut(const Word* state);

  const RelaxedTask& task_;
  std::vector<double> costs_;  // by operator, and 0 for free units
  PackedLists<int> reaches_, reached_by_, needed_by_, units_of_;
  std::vector<int> goal_;
  int goal_atom_;
  std::vector<double> remaining_, cost_;  // by operator; by atom
  std::vector<Unit> units_;
  std::vector<Entry> heap_;
  std::vector<char> zone_;  // by atom: 0 unknown, 1 leads to the goal for nothing, 2 before that
  std::vector<int> stack_, cut_;
  std::vector<char> in_cut_;  // by operator
};

}  // namespace stepwright::pddl
