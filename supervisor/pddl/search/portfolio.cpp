#include "supervisor/pddl/search/portfolio.h"

#include <algorithm>
#include <thread>

namespace stepwright::pddl {

Portfolio::Portfolio(const RelaxedTask& task, SearchControl& control, const PortfolioOptions& options)
    : task_(task), space_(task.space()), control_(control), options_(options), bounds_(space_, [&control] {
        return control.check() != StopReason::None;
      }) {
  const auto& operators = space_.task().operators;
  falling_costs_ = std::any_of(operators.begin(), operators.end(),
                               [](const GroundOperator& op) { return !(op.cost.low >= 0.0); });
  if (falling_costs_ || control.check() != StopReason::None) return;
  cut_ = std::make_unique<LandmarkCut>(task);
  if (!cut_pays()) cut_.reset();
}

// Compares the bounds along the best plan known: the dearer one must promise clearly more.
bool Portfolio::cut_pays() {
  constexpr double kClearly = 1.15;
  const std::vector<int> plan = control_.best().operators;
  const std::size_t stride = std::max<std::size_t>(1, plan.size() / 8);
  std::vector<Word> state = space_.initial(), next(space_.words());
  double cheap = 0.0, dear = 0.0;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (i % stride == 0) {
      if (control_.check() != StopReason::None) return false;
      cheap += bounds_(state.data()).cost;
      dear += (*cut_)(state.data());
    }
    double cost = 0.0;
    space_.apply(plan[i], state.data(), next.data(), cost);
    state.swap(next);
  }
  return dear > kClearly * cheap;
}

bool Portfolio::take_turns(StopReason& reason) {
  AStarSearch proof(space_, control_, bounds_, cut_.get());
  const Landmarks landmarks(task_, [this] { return control_.check() != StopReason::None; });
  Improvement improvement(task_, control_, bounds_, landmarks);
  const bool improve = !options_.prove_first && !falling_costs_;
  // The first turn alone proves small tasks. A second bound makes states dearer.
  std::uint64_t turn = !improve ? UINT64_MAX : cut_ ? 100 : 20'000;
  for (;; turn *= 2) {
    SearchStatus status = proof.run(turn, reason);
    unbounded_ = proof.unbounded();
    if (status != SearchStatus::Running) return status == SearchStatus::Exhausted;
    status = improvement.run(turn / 4, reason);
    if (status == SearchStatus::Exhausted) return true;
    if (status == SearchStatus::Stopped) return false;
  }
}

bool Portfolio::side_by_side(StopReason& reason) {
  SearchStatus proved = SearchStatus::Running, improved = SearchStatus::Running;
  StopReason proof_reason = StopReason::None;
  // The proof has a thread and bounds of its own; the callbacks for the clock stay on this one.
  const LowerBounds own_bounds = bounds_;
  AStarSearch proof(space_, control_, own_bounds, cut_.get());
  std::thread prover([&] {
    proved = proof.run(UINT64_MAX, proof_reason);
    if (proved == SearchStatus::Exhausted || proof.unbounded()) control_.finish();
  });
  const Landmarks landmarks(task_, [this] { return control_.check() != StopReason::None; });
  Improvement improvement(task_, control_, bounds_, landmarks);
  while (improved == SearchStatus::Running) improved = improvement.run(2'000, reason);
  if (improved == SearchStatus::Exhausted) control_.finish();
  prover.join();
  unbounded_ = proof.unbounded();
  const bool done = proved == SearchStatus::Exhausted || improved == SearchStatus::Exhausted;
  if (!done && (reason == StopReason::None || reason == StopReason::Finished)) reason = proof_reason;
  return done;
}

bool Portfolio::run(StopReason& reason) {
  if ((reason = control_.check()) != StopReason::None) return false;
  return options_.threads < 2 || falling_costs_ ? take_turns(reason) : side_by_side(reason);
}

}  // namespace stepwright::pddl
