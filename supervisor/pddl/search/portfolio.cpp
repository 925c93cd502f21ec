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
}

// Improvement comes first: its first turns bring most. A turn of the proof takes about as long: per state of
// its own it has a few for every evaluation with cheap bounds, one for many with dear ones.
bool Portfolio::take_turns(StopReason& reason) {
  constexpr std::uint64_t kSmallTask = 400, kFirstTurn = 1000, kLongestTurn = 32'000;
  Proof proof(task_, control_, bounds_);
  const bool improve = !options_.prove_first && !falling_costs_;
  // Its first turn alone proves small tasks.
  SearchStatus status = proof.run(improve ? kSmallTask : UINT64_MAX, reason);
  const Landmarks landmarks(task_, [this] { return control_.check() != StopReason::None; });
  Improvement improvement(task_, control_, bounds_, landmarks);
  for (std::uint64_t turn = kFirstTurn;; turn = std::min(2 * turn, kLongestTurn)) {
    unbounded_ = proof.unbounded();
    if (status != SearchStatus::Running) return status == SearchStatus::Exhausted;
    if (improve) {
      status = improvement.run(turn, reason);
      if (status == SearchStatus::Exhausted) return true;
      if (status == SearchStatus::Stopped) return false;
    }
    status = proof.run(!improve ? UINT64_MAX : proof.dear() ? turn / 20 : 4 * turn, reason);
  }
}

bool Portfolio::side_by_side(StopReason& reason) {
  SearchStatus proved = SearchStatus::Running, improved = SearchStatus::Running;
  StopReason proof_reason = StopReason::None;
  // The proof has a thread and bounds of its own; the callbacks for the clock stay on this one.
  Proof proof(task_, control_, bounds_);
  std::thread prover([&] {
    while (proved == SearchStatus::Running) proved = proof.run(UINT64_MAX, proof_reason);
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
