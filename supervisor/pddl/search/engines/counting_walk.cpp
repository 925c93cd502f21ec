#include "supervisor/pddl/search/engines/counting_walk.h"

#include <algorithm>
#include <cmath>

#include "supervisor/pddl/search/control/plan_runner.h"

namespace stepwright::pddl {
namespace {

constexpr int kIterations = 20'000;  // of the simplex method

}  // namespace

CountingWalk::CountingWalk(const RelaxedTask& task, SearchControl& control)
    : task_(task),
      space_(task.space()),
      control_(control),
      lookahead_(task, control),
      state_(space_.initial()) {}

// How often each operator is to be applied from the state. False if the program has no answer.
bool CountingWalk::count() {
  const auto stop = [this] { return control_.check() != StopReason::None; };
  if (!program_) {
    rows_.emplace(task_, stop);
    std::vector<double> costs;
    // Free operators count a little: of solutions that cost as much the shorter.
    for (const GroundOperator& op : space_.task().operators) {
      costs.push_back(std::isfinite(op.cost.low) ? std::max(op.cost.low, 0.0) + 1e-3 : 1e-3);
    }
    program_.emplace(std::move(costs), rows_->rows());
  }
  for (std::size_t r = 0; r < rows_->rows().size(); ++r) program_->set_low(r, rows_->low(r, state_.data()));
  const LpSolution solution = program_->minimize(stop, kIterations);
  control_.count_expanded(1);
  if (!solution.finished || solution.bound == kInfinity) return false;
  uses_.clear();
  const std::span<const double> values = program_->values();
  for (std::size_t op = 0; op < values.size(); ++op) {
    const int times = static_cast<int>(std::ceil(std::min(values[op], 1e6) - 1e-6));
    if (times > 0) uses_.push_back({static_cast<int>(op), times, 0});
  }
  return true;
}

// False if it leads nowhere.
bool CountingWalk::step() {
  if (!count()) return false;
  before_ = state_;
  lookahead_.follow(state_, uses_, [this](int op, double, const std::vector<Word>& next) {
    if (next == state_) return false;
    plan_.push_back(op);
    return true;
  });
  if (space_.goal(state_.data())) {
    found_ = offer_plan(space_, control_, plan_);
    return false;
  }
  return state_ != before_;
}

SearchStatus CountingWalk::run(std::uint64_t programs, StopReason& reason) {
  for (std::uint64_t done = 0; done < programs; ++done) {
    if ((reason = control_.check()) != StopReason::None) return SearchStatus::Stopped;
    if (step()) continue;
    if ((reason = control_.check()) != StopReason::None) return SearchStatus::Stopped;
    return found_ ? SearchStatus::Found : SearchStatus::Exhausted;
  }
  return SearchStatus::Running;
}

}  // namespace stepwright::pddl
