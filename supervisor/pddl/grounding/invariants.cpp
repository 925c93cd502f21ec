#include "supervisor/pddl/grounding/invariants.h"

#include <algorithm>
#include <deque>
#include <set>

#include "supervisor/pddl/definition/atom_table.h"
#include "supervisor/pddl/grounding/balance.h"
#include "supervisor/pddl/grounding/invariant_candidate.h"

namespace stepwright::pddl {
namespace {

constexpr std::size_t kMostCandidates = 300;
constexpr std::size_t kMostChecks = 20'000'000;  // operators looked at, over all candidates
constexpr std::size_t kOperatorsBetweenStops = 4096;

// The instances of one candidate and what is known of them.
struct Instances {
  FactSets sets;
  std::vector<std::vector<int>> objects;  // of every set
  std::vector<int> held;                  // facts of it that hold initially
  std::vector<bool> broken, may_lose;
  std::size_t alive = 0;  // sets of two facts and more that are not broken

  bool matters(std::size_t set) const { return !broken[set] && sets.sizes[set] > 1; }

  void break_set(std::size_t set) {
    if (matters(set)) --alive;
    broken[set] = true;
  }
};

class Synthesis {
 public:
  Synthesis(const RawTask& raw, const std::function<bool()>& stop) : raw_(raw), stop_(stop) {
    for (const GroundOperator& op : raw.operators) note_effects(op);
  }

  std::vector<Invariant> run() {
    for (InvariantCandidate& candidate : simplest_candidates(*raw_.definition)) propose(std::move(candidate));
    while (!open_.empty() && !stopped_) {
      const InvariantCandidate candidate = std::move(open_.front());
      open_.pop_front();
      examine(candidate);
    }
    return std::move(invariants_);
  }

 private:
  void note_effects(const GroundOperator& op) {
    const auto action = static_cast<std::size_t>(op.action);
    if (action >= changed_by_.size())
      changed_by_.resize(action + 1, std::vector<bool>(raw_.definition->predicates.size()));
    const auto note = [&](int fact) {
      const int predicate = raw_.facts[static_cast<std::size_t>(fact)].symbol;
      changed_by_[action][static_cast<std::size_t>(predicate)] = true;
    };
    for (const GroundEffect& effect : op.effects) {
      std::ranges::for_each(effect.adds, note);
      std::ranges::for_each(effect.deletes, note);
    }
  }

  // Of each action: whether its operators can change a fact of the candidate.
  std::vector<bool> touching(const InvariantCandidate& candidate) const {
    std::vector<bool> found(changed_by_.size());
    for (std::size_t action = 0; action < found.size(); ++action)
      for (std::size_t predicate = 0; predicate < changed_by_[action].size() && !found[action]; ++predicate)
        found[action] =
            changed_by_[action][predicate] && candidate.part_of(static_cast<int>(predicate)) != nullptr;
    return found;
  }

  void propose(InvariantCandidate candidate) {
    if (seen_.size() >= kMostCandidates || !seen_.insert(candidate).second) return;
    open_.push_back(std::move(candidate));
  }

  bool may_hold(std::size_t fact) const { return raw_.reachable.state.literals[2 * fact]; }

  Instances instances(const InvariantCandidate& candidate) const {
    Instances found;
    AtomTable ids;
    found.sets.set_of.assign(raw_.facts.size(), -1);
    for (std::size_t f = 0; f < raw_.facts.size(); ++f) {
      const InvariantPart* part = candidate.part_of(raw_.facts[f].symbol);
      if (part == nullptr || !may_hold(f)) continue;
      std::vector<int> objects = instance_of(*part, raw_.facts[f]);
      const int id = ids.intern(0, objects);
      const auto set = static_cast<std::size_t>(id);
      if (set == found.held.size()) {
        found.objects.push_back(std::move(objects));
        found.sets.sizes.push_back(0);
        found.held.push_back(0);
      }
      found.sets.set_of[f] = id;
      ++found.sets.sizes[set];
      if (raw_.initial_facts[f]) ++found.held[set];
    }
    found.broken.assign(found.held.size(), false);
    found.may_lose.assign(found.held.size(), false);
    for (std::size_t set = 0; set < found.held.size(); ++set) {
      if (found.sets.sizes[set] > 1) ++found.alive;
      if (found.held[set] > 1) found.break_set(set);
    }
    return found;
  }

  void examine(const InvariantCandidate& candidate) {
    Instances instances = this->instances(candidate);
    BalanceCheck check(instances.sets);
    refined_actions_.clear();
    const std::vector<bool> touching = this->touching(candidate);
    for (std::size_t i = 0; i < raw_.operators.size(); ++i) {
      if (!raw_.reachable.operators[i]) continue;
      if (++checks_ % kOperatorsBetweenStops == 0 && (stop_() || checks_ > kMostChecks)) {
        stopped_ = true;
        return;
      }
      const GroundOperator& op = raw_.operators[i];
      if (!touching[static_cast<std::size_t>(op.action)]) continue;
      check.check(op, [&](const Verdict& verdict) { judge(candidate, op, check, verdict, instances); });
    }
    if (instances.alive > 0) keep(instances);
  }

  void judge(const InvariantCandidate& candidate, const GroundOperator& op, const BalanceCheck& check,
             const Verdict& verdict, Instances& instances) {
    const auto set = static_cast<std::size_t>(verdict.set);
    if (instances.broken[set]) return;
    if (verdict.may_lose) instances.may_lose[set] = true;
    if (verdict.weight == Weight::Kept) return;
    instances.break_set(set);
    // One failure per action shows what to add; a refinement has to mend it anyway.
    if (verdict.weight == Weight::Heavy || !refined_actions_.insert(op.action).second) return;
    for (const int fact : check.deleted_with(verdict)) {
      for (InvariantCandidate& larger :
           refine(candidate, instances.objects[set], raw_.facts[static_cast<std::size_t>(fact)])) {
        propose(std::move(larger));
      }
    }
  }

  void keep(const Instances& instances) {
    std::vector<Invariant> found(instances.held.size());
    for (std::size_t f = 0; f < raw_.facts.size(); ++f) {
      const int set = instances.sets.set_of[f];
      if (set >= 0) found[static_cast<std::size_t>(set)].facts.push_back(static_cast<int>(f));
    }
    for (std::size_t set = 0; set < found.size(); ++set) {
      if (!instances.matters(set)) continue;
      found[set].exactly_one = instances.held[set] == 1 && !instances.may_lose[set];
      invariants_.push_back(std::move(found[set]));
    }
  }

  const RawTask& raw_;
  const std::function<bool()>& stop_;
  std::deque<InvariantCandidate> open_;
  std::set<InvariantCandidate> seen_;
  std::set<int> refined_actions_;
  std::vector<std::vector<bool>> changed_by_;  // of each action: which predicates
  std::vector<Invariant> invariants_;
  std::size_t checks_ = 0;
  bool stopped_ = false;
};

}  // namespace

std::vector<Invariant> find_invariants(const RawTask& raw, const std::function<bool()>& stop) {
  return Synthesis(raw, stop).run();
}

}  // namespace stepwright::pddl
