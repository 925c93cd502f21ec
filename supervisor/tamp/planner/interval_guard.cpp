#include "supervisor/tamp/planner/interval_guard.h"

namespace stepwright::tamp::planner {

void IntervalGuard::push(const htn::ExternalCall& action) {
  pushed_.push_back(false);
  htn::Fingerprint print = followed_by(prints_.back(), static_cast<std::uint64_t>(action.symbol));
  for (const int object : action.objects) print = followed_by(print, static_cast<std::uint64_t>(object));
  prints_.push_back(print);
}

void IntervalGuard::pop() {
  if (pushed_.back()) network_.pop();
  pushed_.pop_back();
  prints_.pop_back();
}

std::optional<htn::Refusal> IntervalGuard::require(const htn::ExternalCall& atom, bool wanted) {
  const std::size_t before = pushed_.empty() ? 0 : pushed_.size() - 1;
  const auto action = grounding_->action_of(atom);
  if (!action) return htn::Refusal{before, true, "the cell has no such arm, thing or region"};
  if (!wanted || pushed_.empty() || pushed_.back())
    return htn::Refusal{before, false, "geometry is asked once for each action, and not negated"};
  if (action->on >= 0 && is_held(static_cast<std::size_t>(action->on)))
    return htn::Refusal{before, true, "nothing is put on what a hand holds"};
  pushed_.back() = true;
  const Action asked = model_->action_of(*action);
  if (network_.push(asked)) return std::nullopt;
  ++refuted_;
  if (first_refuted_.empty()) first_refuted_.assign(network_.actions().begin(), network_.actions().end());
  return htn::Refusal{before, true, text_of(model_->cell(), asked) + ": refuted by its intervals"};
}

bool IntervalGuard::is_held(std::size_t object) const {
  const auto actions = network_.actions();
  for (std::size_t k = actions.size(); k-- > 0;)
    if (actions[k].kind != tamp::ActionKind::MoveAway && actions[k].object == object)
      return actions[k].kind == tamp::ActionKind::Pick;
  return false;
}

std::optional<htn::Refusal> IntervalGuard::change(const htn::ExternalCall&, bool value) {
  if (value && !pushed_.empty() && pushed_.back()) return std::nullopt;
  return htn::Refusal{pushed_.empty() ? 0 : pushed_.size() - 1, false, "an effect without its condition"};
}

}  // namespace stepwright::tamp::planner
