#include "supervisor/pddl/grounding/balance.h"

#include <algorithm>

namespace stepwright::pddl {
namespace {

// More effects than this on one set are taken as a failure rather than compared pair by pair.
constexpr std::size_t kMostChanges = 64;

bool contains(const std::vector<int>& list, int value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

void add_once(std::vector<int>& list, int value) {
  if (!contains(list, value)) list.push_back(value);
}

}  // namespace

void BalanceCheck::collect(const GroundOperator& op) {
  op_ = &op;
  adds_.clear();
  deletes_.clear();
  for (const GroundEffect& effect : op.effects) {
    for (const int fact : effect.adds) {
      if (set_of(fact) >= 0) adds_.push_back({set_of(fact), fact, &effect});
    }
    for (const int fact : effect.deletes) {
      if (set_of(fact) >= 0) deletes_.push_back({set_of(fact), fact, &effect});
    }
  }
  const auto by_set = [](const Change& a, const Change& b) { return a.set < b.set; };
  std::stable_sort(adds_.begin(), adds_.end(), by_set);
  std::stable_sort(deletes_.begin(), deletes_.end(), by_set);
}

BalanceCheck::Changes BalanceCheck::part_of(const std::vector<Change>& changes, int set) {
  const auto first = std::partition_point(changes.begin(), changes.end(),
                                          [&](const Change& change) { return change.set < set; });
  const auto last =
      std::partition_point(first, changes.end(), [&](const Change& change) { return change.set == set; });
  return {first, last};
}

// Does `other` fire whenever `effect` does and the fact `holding` holds before? A sufficient test.
bool BalanceCheck::happens_with(const GroundEffect& other, const GroundEffect& effect, int holding) const {
  if (&other == &effect || other.when.always()) return true;
  const Condition& when = other.when;
  if (when.impossible || !when.comparisons.empty() || !when.choices.empty()) return false;
  return std::all_of(when.literals.begin(), when.literals.end(), [&](int literal) {
    return literal == 2 * holding || contains(op_->precondition.literals, literal) ||
           contains(effect.when.literals, literal);
  });
}

// The facts of the set that hold before, if the operator is applied and the effects fire.
std::vector<int> BalanceCheck::known(int set, const GroundEffect& effect, const GroundEffect* second) const {
  std::vector<int> facts;
  const auto look = [&](const std::vector<int>& literals) {
    for (const int literal : literals) {
      if (literal % 2 == 0 && set_of(literal / 2) == set) add_once(facts, literal / 2);
    }
  };
  look(op_->precondition.literals);
  look(effect.when.literals);
  if (second != nullptr) look(second->when.literals);
  return facts;
}

// Can the two effects fire together, so that two facts of the set are added?
bool BalanceCheck::clash(const Change& a, const Change& b) const {
  if (a.fact == b.fact) return false;
  // At most one fact of the set holds, so effects that need two different ones exclude each other.
  if (known(a.set, *a.effect, b.effect).size() > 1) return false;
  const auto denied = [](const Condition& one, const Condition& other) {
    return std::any_of(one.literals.begin(), one.literals.end(),
                       [&](int literal) { return contains(other.literals, literal ^ 1); });
  };
  return !denied(a.effect->when, b.effect->when) && !denied(op_->precondition, a.effect->when) &&
         !denied(op_->precondition, b.effect->when);
}

Weight BalanceCheck::judge_add(const Change& change) const {
  const std::vector<int> holding = known(change.set, *change.effect);
  if (holding.size() > 1) return Weight::Kept;  // it never fires
  std::vector<int> gone;  // other facts of the set that do not hold afterwards, whether they held or not
  for (const Change& other : part_of(deletes_, change.set)) {
    if (other.fact != change.fact && happens_with(*other.effect, *change.effect, other.fact)) {
      add_once(gone, other.fact);
    }
  }
  if (!holding.empty()) {
    const bool kept = holding.front() == change.fact || contains(gone, holding.front());
    return kept ? Weight::Kept : Weight::Heavy;
  }
  const auto deny = [&](const std::vector<int>& literals) {
    for (const int literal : literals) {
      const int fact = literal / 2;
      if (literal % 2 != 0 && fact != change.fact && set_of(fact) == change.set) add_once(gone, fact);
    }
  };
  deny(op_->precondition.literals);
  deny(change.effect->when.literals);
  // A single fact excludes itself; it is reported all the same, for the sets that it can be joined to.
  const int size = sets_.sizes[static_cast<std::size_t>(change.set)];
  const bool rest_is_gone = size > 1 && static_cast<int>(gone.size()) + 1 >= size;
  return rest_is_gone ? Weight::Kept : Weight::Unbalanced;
}

std::vector<int> BalanceCheck::deleted_with(const Verdict& verdict) const {
  std::vector<int> deleted;
  for (const GroundEffect& effect : op_->effects) {
    for (const int fact : effect.deletes) {
      if (!happens_with(effect, *verdict.effect, fact)) continue;
      const bool holds =
          contains(op_->precondition.literals, 2 * fact) || contains(verdict.effect->when.literals, 2 * fact);
      if (holds && set_of(fact) != verdict.set) add_once(deleted, fact);
    }
  }
  return deleted;
}

// Can the delete take away the fact that holds, with nothing added for it?
bool BalanceCheck::may_lose(const Change& change) const {
  const std::vector<int> holding = known(change.set, *change.effect);
  if (holding.size() > 1) return false;
  if (!holding.empty() && holding.front() != change.fact) return false;
  const Changes adds = part_of(adds_, change.set);
  return std::none_of(adds.begin(), adds.end(), [&](const Change& add) {
    return happens_with(*add.effect, *change.effect, change.fact);
  });
}

Verdict BalanceCheck::judge_adds(int set) const {
  Verdict verdict;
  verdict.set = set;
  const Changes adds = part_of(adds_, set);
  bool heavy = adds.size() > kMostChanges;
  for (std::size_t i = 0; i < adds.size() && !heavy; ++i) {
    for (std::size_t j = 0; j < i && !heavy; ++j) heavy = clash(adds[i], adds[j]);
    if (heavy) break;
    const Weight weight = judge_add(adds[i]);
    heavy = weight == Weight::Heavy;
    if (weight != Weight::Unbalanced) continue;
    verdict.weight = weight;
    verdict.effect = adds[i].effect;
  }
  if (heavy) verdict.weight = Weight::Heavy;
  return verdict;
}

void BalanceCheck::judge_set(int set, const std::function<void(const Verdict&)>& report) {
  Verdict verdict = judge_adds(set);
  const Changes deletes = part_of(deletes_, set);
  verdict.may_lose =
      deletes.size() > kMostChanges ||
      std::any_of(deletes.begin(), deletes.end(), [&](const Change& change) { return may_lose(change); });
  if (verdict.weight != Weight::Kept || verdict.may_lose) report(verdict);
}

void BalanceCheck::check(const GroundOperator& op, const std::function<void(const Verdict&)>& report) {
  collect(op);
  int last = -1;
  for (const Change& change : adds_) {
    if (change.set != last) judge_set(change.set, report);
    last = change.set;
  }
  // What only loses facts.
  last = -1;
  for (const Change& change : deletes_) {
    if (change.set != last && part_of(adds_, change.set).empty()) judge_set(change.set, report);
    last = change.set;
  }
}

}  // namespace stepwright::pddl
