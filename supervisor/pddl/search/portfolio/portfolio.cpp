#include "supervisor/pddl/search/portfolio/portfolio.h"

#include <algorithm>
#include <optional>
#include <thread>

namespace stepwright::pddl {
namespace {

constexpr std::uint64_t kSmallTask = 400;  // states of a proof that is worth no other's turn
// What the searches of fresh starts hold for each unit of the relaxed task before their first state.
constexpr std::size_t kStartsPerUnit = 256;

}  // namespace

Portfolio::Portfolio(const RelaxedTask& task, SearchControl& control, const PortfolioOptions& options)
    : task_(task), space_(task.space()), control_(control), options_(options), bounds_(space_, [&control] {
        return control.check() != StopReason::None;
      }) {
  const auto& operators = space_.task().operators;
  falling_costs_ = std::any_of(operators.begin(), operators.end(),
                               [](const GroundOperator& op) { return !(op.cost.low >= 0.0); });
}

// About as long as so many evaluations of relaxed plans take: a few states each with cheap bounds; with dear
// ones a part of a state, or an iteration of the simplex method.
SearchStatus Portfolio::prove_for(Proof& proof, std::uint64_t evaluations, StopReason& reason) {
  constexpr std::uint64_t kCheapStates = 4, kDearStates = 5, kPerDearState = 10;
  if (!proof.dear()) return proof.run(kCheapStates * evaluations, reason);
  SearchStatus status = SearchStatus::Running;
  for (std::uint64_t left = evaluations; left > 0 && status == SearchStatus::Running;) {
    const std::uint64_t before = proof.iterations();
    status = proof.run(kDearStates, reason);
    left -= std::min(left, kDearStates * kPerDearState + proof.iterations() - before);
  }
  return status;
}

// Improvement comes first: its first turns bring most.
bool Portfolio::take_turns(StopReason& reason) {
  constexpr std::uint64_t kFirstTurn = 1000, kLongestTurn = 32'000;
  Proof proof(task_, control_, bounds_);
  const bool improve = !options_.prove_first && !falling_costs_;
  SearchStatus status = proof.run(improve ? kSmallTask : UINT64_MAX, reason);
  const Landmarks landmarks = find_landmarks(task_, control_);
  Improvement improvement(task_, control_, bounds_, landmarks);
  std::optional<FreshStarts> starts;
  if (room_for_starts()) starts.emplace(task_, control_, landmarks);
  for (std::uint64_t turn = kFirstTurn;; turn = std::min(2 * turn, kLongestTurn)) {
    unbounded_ = proof.unbounded();
    if (status != SearchStatus::Running) return status == SearchStatus::Exhausted;
    if (improve) {
      status = improvement.run(turn, reason);
      if (status == SearchStatus::Exhausted) return true;
      if (status == SearchStatus::Stopped) return false;
      if (starts && !starts->run(starts->climbing_at_random() ? turn / 4 : turn, reason)) return false;
    }
    status = improve ? prove_for(proof, turn / 2, reason) : proof.run(UINT64_MAX, reason);
  }
}

// Searches for other plans share the thread of the proof, half of its time at first: where the proof is long,
// they take long, too.
SearchStatus Portfolio::prove_and_start(Proof& proof, const Landmarks& landmarks, StopReason& reason) {
  SearchStatus status = proof.run(options_.prove_first ? UINT64_MAX : kSmallTask, reason);
  if (status != SearchStatus::Running) return status;
  if (!room_for_starts()) return proof.run(UINT64_MAX, reason);
  FreshStarts starts(task_, control_, landmarks);
  while (status == SearchStatus::Running) {
    const double begin = control_.elapsed_ms();
    if (!starts.run(200, reason)) return SearchStatus::Stopped;
    const double middle = control_.elapsed_ms();
    const double until = middle + (starts.climbing_at_random() ? 3.0 : 1.0) * (middle - begin);
    do {
      status = prove_for(proof, 50, reason);
    } while (status == SearchStatus::Running && control_.elapsed_ms() < until);
  }
  return status;
}

bool Portfolio::room_for_starts() const {
  return control_.has_room_for(kStartsPerUnit * task_.units());
}

bool Portfolio::side_by_side(StopReason& reason) {
  SearchStatus proved = SearchStatus::Running, improved = SearchStatus::Running;
  StopReason proof_reason = StopReason::None;
  // The proof has a thread and bounds of its own; the callbacks for the clock stay on this one.
  Proof proof(task_, control_, bounds_);
  const Landmarks landmarks = find_landmarks(task_, control_);
  std::thread prover([&] {
    proved = prove_and_start(proof, landmarks, proof_reason);
    if (proved == SearchStatus::Exhausted || proof.unbounded()) control_.finish();
  });
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
