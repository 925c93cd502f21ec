#include "supervisor/pddl/search/portfolio/proof.h"

#include <algorithm>

namespace stepwright::pddl {
namespace {

// So many states prove small tasks with cheap bounds.
constexpr std::uint64_t kCheapStates = 500;
// How many times as much as the cheap bounds a dearer one must promise, and the linear program as much as
// operator sets alone: a state takes about as long with either.
constexpr double kCutOverCheap = 1.15, kProgramOverCheap = 1.25, kProgramOverCut = 1.03;
// At the root the program may take its time.
constexpr int kRootRounds = 50;
// At most so many states of the best plan are asked.
constexpr std::size_t kSamples = 8;
// Of larger tasks a linear program takes longer than it helps.
constexpr std::size_t kMostOperators = 20'000;

}  // namespace

Proof::Proof(const RelaxedTask& task, SearchControl& control, const LowerBounds& bounds)
    : task_(task),
      space_(task.space()),
      control_(control),
      bounds_(bounds),
      memory_(control),
      search_(std::make_unique<AStarSearch>(space_, control, bounds_, DearBounds{})),
      cheap_left_(kCheapStates) {
  const auto& operators = space_.task().operators;
  const bool falling = std::any_of(operators.begin(), operators.end(),
                                   [](const GroundOperator& op) { return !(op.cost.low >= 0.0); });
  if (falling) cheap_left_ = UINT64_MAX;
}

bool Proof::promise(LandmarkCut& cut, LpBound* lp, Promise& sum) {
  const std::vector<int> plan = control_.best().operators;
  const std::size_t stride = std::max<std::size_t>(1, plan.size() / kSamples);
  std::vector<Word> state = space_.initial(), next(space_.words());
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (i % stride == 0) {
      if (control_.check() != StopReason::None) return false;
      sum.cheap += bounds_(state.data()).cost;
      sum.cut += cut(state.data());
      if (lp != nullptr) sum.lp += lp->cost(state.data(), {.rounds = 1});
    }
    double cost = 0.0;
    space_.apply(plan[i], state.data(), next.data(), cost);
    state.swap(next);
  }
  return true;
}

// The bound of every plan; infinite only if there is none, and then there would be no plan to improve.
void Proof::tell_root(LpBound& lp) {
  const double root = lp.cost(space_.initial().data(), {.rounds = kRootRounds});
  const double least_potential = evaluate_interval(space_.task().potential, space_.task().bounds).low;
  if (root < kInfinity) control_.raise_bound(comparable(root + least_potential));
}

void Proof::choose() {
  cheap_left_ = UINT64_MAX;
  const auto stop = [this] { return control_.check() != StopReason::None; };
  auto cut = std::make_unique<LandmarkCut>(task_, stop);
  std::unique_ptr<LpBound> lp;
  if (space_.task().operators.size() <= kMostOperators) {
    lp = std::make_unique<LpBound>(task_, stop);
    memory_.set(lp->memory());
    tell_root(*lp);
  }
  Promise sum;
  if (!promise(*cut, lp.get(), sum)) return;
  const bool program = sum.lp > kProgramOverCheap * sum.cheap && sum.lp > kProgramOverCut * sum.cut;
  if (!program && !(sum.cut > kCutOverCheap * sum.cheap)) return memory_.set(0);
  lp_ = std::move(lp);
  if (!program) cut_ = std::move(cut);
  const DearBounds dear{cut_.get(), program ? lp_.get() : nullptr, lp_.get()};
  search_ = std::make_unique<AStarSearch>(space_, control_, bounds_, dear);
}

SearchStatus Proof::run(std::uint64_t expansions, StopReason& reason) {
  if (cheap_left_ == UINT64_MAX) return search_->run(expansions, reason);
  const std::uint64_t cheap = std::min(expansions, cheap_left_);
  const SearchStatus status = search_->run(cheap, reason);
  cheap_left_ -= cheap;
  if (status != SearchStatus::Running || cheap_left_ > 0) return status;
  choose();
  return status;
}

}  // namespace stepwright::pddl
