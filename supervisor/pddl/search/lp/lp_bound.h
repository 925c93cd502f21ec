#pragma once

// Admissible bounds by linear programming over numbers of operator applications: the balances of facts and
// numbers (lp_counting) and sets of operators of which the plan needs some (landmark_cut). Sets are looked
// for where the last solution still pays too little: each is one that the solution violates.
//
// Operators cost their least amount over all reachable states. Where all of these are multiples of one
// number, so is what a plan costs at least, and bounds are rounded up to it.
//
// Thread rule: one search, one object: it reuses its memory.
//
//   LpBound bound(relaxed, stop);
//   if (bound.cost(state, {.rounds = 4}) == kInfinity) ...   // no plan from here

#include <optional>

#include "supervisor/pddl/search/bounds/landmark_cut.h"
#include "supervisor/pddl/search/lp/lp_counting.h"

namespace stepwright::pddl {

struct LpEffort {
  int rounds = 0;             // of looking for sets of operators; 0: balances alone
  double enough = kInfinity;  // nobody asks for a higher bound
  int iterations = 20'000;    // of the simplex method for one program
};

class LpBound {
 public:
  // `stop` is asked again and again; when it says so, a bound is what has been proved so far.
  LpBound(const RelaxedTask& task, std::function<bool()> stop);

  // The cost of every plan from the state is at least this.
  double cost(const Word* state, const LpEffort& effort);

  // Of the state that `cost` was asked about last: every plan from it that applies the operator costs at
  // least this.
  double cost_through(int op) const;

  // Every plan from the state that costs at most `most_cost` has at least so many steps.
  double steps(const Word* state, double most_cost, const LpEffort& effort);

  // The least that every operator costs in any reachable state.
  std::span<const double> costs() const { return cut_.costs(); }

  // Simplex iterations and sets of operators since the beginning: what the work is measured by.
  std::uint64_t iterations() const { return iterations_; }
  std::uint64_t sets() const { return sets_; }
  std::size_t size() const { return columns_; }
  std::size_t memory() const;

 private:
  // The cost of every plan is at least `total` and the rests of the operators that it applies.
  struct Proved {
    double total = 0.0;
    std::vector<double> rest;
  };

  double minimize(LpProgram& program, const Word* state, const LpEffort& effort, double unit, Proved& proved);
  void lower_rows(LpProgram& program, const Word* state) const;
  LpProgram& steps_program();

  std::function<bool()> stop_;
  CountingRows rows_;
  LandmarkCut cut_;
  std::size_t columns_;
  double cost_unit_;  // of which all costs are multiples; 0: none
  std::optional<LpProgram> cost_program_, steps_program_;
  std::vector<LpRow> found_;
  Proved cost_, steps_;
  std::uint64_t iterations_ = 0, sets_ = 0;
};

}  // namespace stepwright::pddl
