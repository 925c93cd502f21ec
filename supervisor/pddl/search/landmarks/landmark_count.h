#pragma once

// Count of the landmarks that are still to be reached: those not reached yet, those that were reached, do not
// hold and are needed again, and those that were reached too early: they hold but will have to be given up
// for another (Richter, Westphal 2010, "The LAMA planner", section 4). Which landmarks a way has reached
// belongs to the way: a search keeps it as a bit set per node.
//
// Thread rule: one search, one object.

#include <vector>

#include "supervisor/pddl/search/landmarks/landmarks.h"

namespace stepwright::pddl {

class LandmarkCount {
 public:
  // `weights`: of the operators; a landmark counts what its cheapest achiever does.
  LandmarkCount(const RelaxedTask& task, const Landmarks& landmarks, const std::vector<int>& weights);

  // Words of a bit set.
  std::size_t words() const { return words_; }

  // Adds the landmarks that hold in the state to those reached on the way to it.
  void progress(const Word* state, Word* reached) const;

  int estimate(const Word* state, const Word* reached) const;

  // Does the operator reach a landmark that is not in the set, and not too early?
  bool reaches_another(int op, const Word* reached) const;

 private:
  static bool all_reached(std::span<const int> landmarks, const Word* reached);
  bool holds(std::size_t landmark, const Word* state) const;

  const RelaxedTask& task_;
  const Landmarks& landmarks_;
  std::size_t words_;
  std::vector<int> weights_;     // by landmark
  PackedLists<int> reached_by_;  // landmarks by operator
};

}  // namespace stepwright::pddl
