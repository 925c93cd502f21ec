#pragma once

// Check whether one operator keeps "at most one of these facts holds", and "at least one does". The induction
// step of invariants: it is assumed that at most one holds before.
//
// Thread rule: one synthesis, one object.

#include <functional>
#include <span>
#include <vector>

#include "supervisor/pddl/ground_task/ground_task.h"

namespace stepwright::pddl {

// The sets that are judged together: the set of every fact (-1: none) and how many facts each has.
struct FactSets {
  std::vector<int> set_of;
  std::vector<int> sizes;
};

enum class Weight : std::uint8_t {
  Kept,        // at most one still holds
  Unbalanced,  // a fact is added, and none of the set is known to hold and to be taken away
  Heavy        // two are added, or the one that holds stays
};

// Effect of the operator on one set.
struct Verdict {
  int set = 0;
  Weight weight = Weight::Kept;
  const GroundEffect* effect = nullptr;  // Unbalanced: the one that adds
  bool may_lose = false;                 // the fact that holds may go without another taking its place
};

class BalanceCheck {
 public:
  explicit BalanceCheck(const FactSets& sets) : sets_(sets) {}

  // Tells `report` of every set that the operator may not keep, as to weight or as to at least one.
  void check(const GroundOperator& op, const std::function<void(const Verdict&)>& report);

  // The facts outside the set that are known to hold before the effect and not after it: a set with one of
  // them might be balanced. For the operator checked last.
  std::vector<int> deleted_with(const Verdict& verdict) const;

 private:
  struct Change {
    int set = 0;
    int fact = 0;
    const GroundEffect* effect = nullptr;
  };

  int set_of(int fact) const { return sets_.set_of[static_cast<std::size_t>(fact)]; }
  void collect(const GroundOperator& op);
  using Changes = std::span<const Change>;
  static Changes part_of(const std::vector<Change>& changes, int set);
  void judge_set(int set, const std::function<void(const Verdict&)>& report);
  Verdict judge_adds(int set) const;
  Weight judge_add(const Change& change) const;
  bool clash(const Change& a, const Change& b) const;
  bool may_lose(const Change& change) const;
  bool happens_with(const GroundEffect& other, const GroundEffect& effect, int holding) const;
  std::vector<int> known(int set, const GroundEffect& effect, const GroundEffect* second = nullptr) const;

  const FactSets& sets_;
  const GroundOperator* op_ = nullptr;
  std::vector<Change> adds_, deletes_;  // by set
};

}  // namespace stepwright::pddl
