#include "supervisor/htn/search/binding_walk.h"

#include <algorithm>

namespace stepwright::htn {

bool BindingWalk::start(const Method& method, const MethodTests& tests, std::span<const int> objects,
                        State& state, const Evaluation& in) {
  tests_ = &tests;
  binding_.assign(static_cast<std::size_t>(method.slots), -1);
  depth_ = 0;
  const auto holds_here = [&](const Condition& test) { return holds(test, binding_, in); };
  over_ = !bind_task(method, objects, in) || !std::ranges::all_of(tests.first, holds_here);
  if (over_) return false;
  if (levels_.size() < tests.open.size()) levels_.resize(tests.open.size());
  if (!tests.open.empty()) fill(0, state, in);
  return true;
}

bool BindingWalk::bind_task(const Method& method, std::span<const int> objects, const Evaluation& in) {
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Term term = method.task_terms[i];
    if (term < 0 || binding_[static_cast<std::size_t>(term)] >= 0) {
      if (object_of(term, binding_) != objects[i]) return false;
      continue;
    }
    const int type = method.parameters[static_cast<std::size_t>(term)].type;
    if (!in.task.is_of_type(objects[i], type)) return false;
    binding_[static_cast<std::size_t>(term)] = objects[i];
  }
  return true;
}

bool BindingWalk::matches(const OpenVariable& variable, std::span<const int> row) const {
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (variable.bound[i] && object_of(variable.terms[i], binding_) != row[i]) return false;
    if (variable.terms[i] == variable.slot && row[i] != row[variable.column]) return false;
  }
  return true;
}

void BindingWalk::fill(std::size_t depth, State& state, const Evaluation& in) {
  const OpenVariable& variable = tests_->open[depth];
  Level& level = levels_[depth];
  level.next = 0;
  level.of_type = variable.predicate < 0;
  level.own.clear();
  if (level.of_type) return;
  key_.clear();
  for (std::size_t i = 0; i < variable.terms.size() && i < 64; ++i)
    if (variable.bound[i]) key_.push_back(object_of(variable.terms[i], binding_));
  for (const int fact : state.candidates(variable.predicate, variable.columns, key_)) {
    if (in.interrupt.poll()) return;
    const std::span<const int> row = state.objects(fact);
    if (!state.holds(fact) || !matches(variable, row)) continue;
    if (in.task.is_of_type(row[variable.column], variable.type)) level.own.push_back(row[variable.column]);
  }
  std::ranges::sort(level.own);
  const auto again = std::ranges::unique(level.own);
  level.own.erase(again.begin(), again.end());
}

bool BindingWalk::next(State& state, const Evaluation& in) {
  if (over_) return false;
  const std::size_t count = tests_->open.size();
  if (count == 0) return over_ = true;
  if (depth_ == count) --depth_;
  while (!in.interrupt.poll()) {
    const OpenVariable& variable = tests_->open[depth_];
    Level& level = levels_[depth_];
    const std::vector<int>& objects =
        level.of_type ? in.task.types[static_cast<std::size_t>(variable.type)].objects : level.own;
    if (level.next == objects.size()) {
      if (depth_ == 0) break;
      --depth_;
      continue;
    }
    binding_[static_cast<std::size_t>(variable.slot)] = objects[level.next++];
    const auto holds_here = [&](const Condition& test) { return holds(test, binding_, in); };
    if (!std::ranges::all_of(variable.tests, holds_here)) continue;
    if (++depth_ == count) return true;
    fill(depth_, state, in);
  }
  over_ = true;
  return false;
}

}  // namespace stepwright::htn
