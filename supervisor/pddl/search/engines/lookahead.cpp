#include "supervisor/pddl/search/engines/lookahead.h"

#include <algorithm>

namespace stepwright::pddl {
namespace {

// Steps between two looks at the control: a plan of numbers can have millions.
constexpr std::uint32_t kBetweenLooks = 64;

}  // namespace

Lookahead::Lookahead(const RelaxedTask& task, SearchControl& control)
    : task_(task), space_(task.space()), control_(control), next_(space_.words()) {
  std::vector<std::vector<int>> units(space_.task().operators.size());
  for (std::size_t u = 0; u < task.units(); ++u) {
    const int op = task.operator_of(u);
    if (op >= 0) units[static_cast<std::size_t>(op)].push_back(static_cast<int>(u));
  }
  units_of_ = PackedLists<int>(units);
}

bool Lookahead::apply(std::vector<Word>& state, int op, const Enter& enter) {
  if (stopped_) return false;
  const GroundOperator& whole = space_.task().operators[static_cast<std::size_t>(op)];
  if (!space_.holds(whole.precondition, state.data())) return false;
  double cost = 0.0;
  if (!space_.apply(op, state.data(), next_.data(), cost) || !enter(op, cost, next_)) return false;
  state.swap(next_);
  if (++steps_ % kBetweenLooks == 0) stopped_ = control_.check() != StopReason::None;
  return true;
}

bool Lookahead::pass(std::vector<Word>& state, const Enter& enter) {
  bool any = false;
  std::size_t kept = 0;
  for (AdditiveHeuristic::Use use : rest_) {
    while (use.times > 0 && apply(state, use.op, enter)) {
      --use.times;
      any = true;
    }
    if (use.times > 0) rest_[kept++] = use;
  }
  rest_.resize(kept);
  return any;
}

// An applicable operator that supplies an atom which `user` needs and `supplier` was to reach.
int Lookahead::substitute(const std::vector<Word>& state, int supplier, int user) {
  for (const int u : units_of_[static_cast<std::size_t>(supplier)]) {
    for (const int atom : task_.adds(static_cast<std::size_t>(u))) {
      --patience_;
      const auto needed = [&](int unit) {
        const std::span<const int> needs = task_.needs(static_cast<std::size_t>(unit));
        return std::binary_search(needs.begin(), needs.end(), atom);
      };
      const std::span<const int> users = units_of_[static_cast<std::size_t>(user)];
      if (std::none_of(users.begin(), users.end(), needed)) continue;
      for (const int other : task_.added_by(static_cast<std::size_t>(atom))) {
        --patience_;
        const int op = task_.operator_of(static_cast<std::size_t>(other));
        if (op < 0 || op == supplier) continue;
        if (space_.holds(space_.task().operators[static_cast<std::size_t>(op)].precondition, state.data())) {
          return op;
        }
      }
    }
  }
  return -1;
}

bool Lookahead::replace(const std::vector<Word>& state) {
  for (std::size_t i = 0; i < rest_.size(); ++i) {
    for (std::size_t j = 0; j < rest_.size(); ++j) {
      if (i == j || patience_ <= 0) continue;
      const int op = substitute(state, rest_[i].op, rest_[j].op);
      if (op < 0) continue;
      rest_[i] = {op, 1, 0};
      return true;
    }
  }
  return false;
}

void Lookahead::follow(std::vector<Word>& state, const std::vector<AdditiveHeuristic::Use>& plan,
                       const Enter& enter) {
  rest_ = plan;
  std::stable_sort(rest_.begin(), rest_.end(),
                   [](const auto& a, const auto& b) { return a.needs_cost < b.needs_cost; });
  // Replacements could go round in circles: each operator of the relaxed plan pays for one.
  std::size_t replacements = rest_.size();
  patience_ = 2000;
  stopped_ = false;
  while (!rest_.empty() && !stopped_) {
    if (pass(state, enter)) continue;
    if (replacements-- == 0 || !replace(state)) break;
  }
}

}  // namespace stepwright::pddl
