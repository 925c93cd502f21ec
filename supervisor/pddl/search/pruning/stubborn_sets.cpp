#include "supervisor/pddl/search/pruning/stubborn_sets.h"

#include <algorithm>

namespace stepwright::pddl {
namespace {

// After so many states what is pruned must be worth the work: a share of the applicable operators.
constexpr std::uint64_t kTrial = 1000;
constexpr double kWorthwhile = 0.1;
// So many things that the goal lacks are tried to begin with.
constexpr std::size_t kMostSeeds = 8;
// Of larger tasks the lists of interfering operators take too long.
constexpr std::size_t kMostOperators = 20'000;

}  // namespace

StubbornSets::StubbornSets(const StateSpace& space)
    : space_(space),
      footprints_(space),
      useful_(space.task().axioms.empty() && space.task().operators.size() <= kMostOperators),
      applicable_(space.task().operators.size(), 0),
      included_(space.task().operators.size(), 0) {}

void StubbornSets::include(const Achievers& operators) {
  for (const int op : operators) {
    std::uint32_t& included = included_[static_cast<std::size_t>(op)];
    if (included == set_) continue;
    included = set_;
    queue_.push_back(op);
    if (applicable_[static_cast<std::size_t>(op)] == call_) ++included_applicable_;
  }
}

// How many of them the set does not have yet.
std::size_t StubbornSets::missing(const Achievers& operators) const {
  return static_cast<std::size_t>(std::count_if(operators.begin(), operators.end(), [this](int op) {
    return included_[static_cast<std::size_t>(op)] != set_;
  }));
}

// Writes the achievers of every part of the condition that does not hold to `lacking_`.
void StubbornSets::list_lacking(const Condition& condition, const Word* state) {
  lacking_.clear();
  for (const int literal : condition.literals) {
    if (!space_.literal(state, literal)) lacking_.push_back(&footprints_.achievers(literal));
  }
  std::size_t used = 0;
  const auto collect = [&](const auto& part) {
    Achievers& list = collected_[used++];
    list.clear();
    footprints_.add_achievers(part, list);
    lacking_.push_back(&list);
  };
  const std::size_t most = condition.comparisons.size() + condition.choices.size();
  if (collected_.size() < most) collected_.resize(most);
  for (const Comparison& comparison : condition.comparisons) {
    if (!space_.holds(comparison, state)) collect(comparison);
  }
  for (const auto& options : condition.choices) {
    const bool held = std::any_of(options.begin(), options.end(),
                                  [&](const Condition& option) { return space_.holds(option, state); });
    if (!held) collect(options);
  }
}

// Makes the set that begins with these operators. False once it has too many applicable ones.
bool StubbornSets::close(const Word* state, const Achievers& seed, std::size_t most_applicable) {
  ++set_;
  queue_.clear();
  included_applicable_ = 0;
  include(seed);
  while (!queue_.empty()) {
    if (included_applicable_ > most_applicable) return false;
    const int op = queue_.back();
    queue_.pop_back();
    if (applicable_[static_cast<std::size_t>(op)] == call_) {
      include(footprints_.interfering(op));
      continue;
    }
    const Condition& precondition = space_.task().operators[static_cast<std::size_t>(op)].precondition;
    if (precondition.impossible) continue;
    list_lacking(precondition, state);
    const Achievers* fewest = nullptr;
    std::size_t least = SIZE_MAX;
    for (const Achievers* achievers : lacking_) {
      const std::size_t count = missing(*achievers);
      if (count >= least) continue;
      least = count;
      fewest = achievers;
    }
    if (least > 0 && fewest != nullptr) include(*fewest);
  }
  return included_applicable_ <= most_applicable;
}

void StubbornSets::judge_usefulness() {
  if (++states_ % kTrial != 0) return;
  useful_ = static_cast<double>(kept_) < (1.0 - kWorthwhile) * static_cast<double>(met_);
  kept_ = met_ = 0;
}

void StubbornSets::prune(const Word* state, std::vector<int>& applicable) {
  if (!useful_ || applicable.size() < 2 || space_.goal(state)) return;
  ++call_;
  for (const int op : applicable) applicable_[static_cast<std::size_t>(op)] = call_;
  met_ += applicable.size();
  list_lacking(space_.task().goal, state);
  // `close` uses the lists as well.
  std::vector<Achievers> seeds;
  for (const Achievers* achievers : lacking_) {
    if (seeds.size() < kMostSeeds) seeds.push_back(*achievers);
  }
  kept_operators_ = applicable;
  for (const Achievers& seed : seeds) {
    if (kept_operators_.size() <= 1) break;
    if (!close(state, seed, kept_operators_.size() - 1)) continue;
    kept_operators_.clear();
    for (const int op : applicable) {
      if (included_[static_cast<std::size_t>(op)] == set_) kept_operators_.push_back(op);
    }
  }
  applicable.swap(kept_operators_);
  kept_ += applicable.size();
  judge_usefulness();
}

}  // namespace stepwright::pddl
