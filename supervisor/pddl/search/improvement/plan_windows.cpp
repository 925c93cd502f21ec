#include "supervisor/pddl/search/improvement/plan_windows.h"

#include <algorithm>

#include "supervisor/pddl/search/control/plan_runner.h"
#include "supervisor/pddl/search/improvement/cluster_plan.h"

namespace stepwright::pddl {
namespace {

constexpr std::size_t kShortest = 8;
constexpr std::int64_t kLeastEffort = 300;
constexpr std::size_t kLongestGathered = 40;
constexpr std::size_t kLongestOrdered = 3000;  // operators of a plan whose order is worked out

}  // namespace

// False if the plan cannot be executed.
bool PlanWindows::follow(std::vector<int> plan, Trace& trace) const {
  trace.plan = std::move(plan);
  trace.states.assign(1, space_.initial());
  trace.costs.assign(1, 0.0);
  std::vector<Word> next(space_.words());
  for (const int op : trace.plan) {
    double cost = trace.costs.back();
    const Word* state = trace.states.back().data();
    if (!space_.holds(space_.task().operators[static_cast<std::size_t>(op)].precondition, state))
      return false;
    if (!space_.apply(op, state, next.data(), cost)) return false;
    trace.states.push_back(next);
    trace.costs.push_back(snap(cost));
  }
  return true;
}

// Takes the best plan known. False if nothing can be made of it.
bool PlanWindows::start() {
  version_ = control_.version();
  order_.reset();
  first_ = 0;
  length_ = kShortest;
  effort_ = kLeastEffort;
  if (follow(cluster_plan(space_, control_.best().operators), trace_)) return true;
  trace_.plan.clear();
  return false;
}

// Overlapping by two thirds. After the last window, longer ones follow; after the longest, more effort.
void PlanWindows::slide(std::int64_t& evaluations) {
  improve(trace_, first_, std::min(trace_.plan.size(), first_ + length_), evaluations);
  if (first_ + length_ < trace_.plan.size()) {
    first_ += std::max<std::size_t>(1, length_ / 3);
    return;
  }
  first_ = 0;
  length_ *= 2;
  if (length_ < 2 * trace_.plan.size()) return;
  length_ = kShortest;
  effort_ *= 4;
}

// An operator that the one at the position depends on or shares an object with.
std::size_t PlanWindows::companion(std::size_t position) {
  const auto& neighbours = order_->neighbours(position);
  const auto& arguments = space_.task().operators[static_cast<std::size_t>(trace_.plan[position])].arguments;
  if (!neighbours.empty() && (arguments.empty() || random_() % 2 == 0)) {
    return neighbours[random_() % neighbours.size()];
  }
  if (arguments.empty()) return position;
  const auto& sharing = by_object_[static_cast<std::size_t>(arguments[random_() % arguments.size()])];
  return sharing[random_() % sharing.size()];
}

// Positions that have something to do with each other; `closed`: with all that must stay between them.
std::vector<std::size_t> PlanWindows::related(std::size_t size, bool closed) {
  std::vector<std::size_t> chosen = {random_() % trace_.plan.size()}, set = chosen;
  for (std::size_t attempts = 3 * size; attempts > 0 && set.size() < size; --attempts) {
    const std::size_t next = companion(set[random_() % set.size()]);
    if (std::find(set.begin(), set.end(), next) != set.end()) continue;
    chosen.push_back(next);
    std::vector<std::size_t> grown = closed ? order_->closure(chosen) : chosen;
    if (grown.size() > size + size / 2) {
      chosen.pop_back();
    } else {
      set = std::move(grown);
    }
  }
  return set;
}

// False if the order of the plan is not to be had.
bool PlanWindows::know_order() {
  if (!space_.task().axioms.empty() || trace_.plan.size() > kLongestOrdered) return false;
  if (order_) return true;
  order_.emplace(space_.task(), trace_.plan);
  by_object_.clear();
  for (std::size_t i = 0; i < trace_.plan.size(); ++i) {
    for (const int object : space_.task().operators[static_cast<std::size_t>(trace_.plan[i])].arguments) {
      if (by_object_.size() <= static_cast<std::size_t>(object)) {
        by_object_.resize(static_cast<std::size_t>(object) + 1);
      }
      by_object_[static_cast<std::size_t>(object)].push_back(i);
    }
  }
  return true;
}

void PlanWindows::gather(std::int64_t& evaluations) {
  if (!know_order()) return;
  const std::size_t longest = std::min({2 * length_, kLongestGathered, trace_.plan.size()});
  const GatheredPlan gathered = order_->gather(trace_.plan, related(3 + random_() % longest, true));
  Trace trace;
  if (!follow(gathered.plan, trace) || trace.costs.back() > trace_.costs.back()) return;
  improve(trace, gathered.first, gathered.last, evaluations);
}

// All positions of one object's operators.
std::vector<std::size_t> PlanWindows::with_object() {
  const auto& arguments =
      space_.task()
          .operators[static_cast<std::size_t>(trace_.plan[random_() % trace_.plan.size()])]
          .arguments;
  if (arguments.empty()) return {};
  return by_object_[static_cast<std::size_t>(arguments[random_() % arguments.size()])];
}

// Takes operators out, lets those go that then cannot be applied, and mends the end.
void PlanWindows::drop(std::int64_t& evaluations) {
  if (!know_order()) return;
  std::vector<bool> out(trace_.plan.size(), false);
  const std::size_t longest = std::min<std::size_t>(length_, 12);
  for (const std::size_t i : random_() % 4 == 0 ? with_object() : related(1 + random_() % longest, false)) {
    out[i] = true;
  }
  Trace kept;
  kept.states.assign(1, space_.initial());
  kept.costs.assign(1, 0.0);
  std::vector<Word> next(space_.words());
  for (std::size_t i = 0; i < trace_.plan.size(); ++i) {
    const Word* state = kept.states.back().data();
    double cost = kept.costs.back();
    const int op = trace_.plan[i];
    if (out[i]) continue;
    if (!space_.holds(space_.task().operators[static_cast<std::size_t>(op)].precondition, state)) continue;
    if (!space_.apply(op, state, next.data(), cost)) continue;
    kept.plan.push_back(op);
    kept.states.push_back(next);
    kept.costs.push_back(snap(cost));
  }
  const double room = trace_.costs.back() - kept.costs.back();
  const std::size_t steps = trace_.plan.size() - kept.plan.size();
  if (room < 0.0) return;
  const PlanNeeds needs(space_, trace_.states.back().data());
  const auto tail = search_.improve({kept.states.back().data(), trace_.states.back().data(), &needs, room,
                                     static_cast<std::uint32_t>(steps)},
                                    evaluations, evaluations - effort_);
  if (!tail) return;
  kept.plan.insert(kept.plan.end(), tail->begin(), tail->end());
  accept(std::move(kept.plan));
}

void PlanWindows::accept(std::vector<int> plan) {
  if (!offer_plan(space_, control_, plan)) return;
  version_ = control_.version();
  order_.reset();
  follow(std::move(plan), trace_);
}

void PlanWindows::improve(const Trace& trace, std::size_t first, std::size_t last,
                          std::int64_t& evaluations) {
  PlanNeeds needs(space_, trace.states.back().data());
  for (std::size_t i = trace.plan.size(); i > last; --i) {
    needs.prepend(trace.plan[i - 1], trace.states[i - 1].data());
  }
  const auto better =
      search_.improve({trace.states[first].data(), trace.states[last].data(), &needs,
                       trace.costs[last] - trace.costs[first], static_cast<std::uint32_t>(last - first)},
                      evaluations, evaluations - effort_);
  if (!better) return;
  const auto at = [&](std::size_t i) { return trace.plan.begin() + static_cast<std::ptrdiff_t>(i); };
  std::vector<int> whole(trace.plan.begin(), at(first));
  whole.insert(whole.end(), better->begin(), better->end());
  whole.insert(whole.end(), at(last), trace.plan.end());
  accept(std::move(whole));
}

bool PlanWindows::run(std::int64_t evaluations, StopReason& reason) {
  while (evaluations > 0) {
    if ((reason = control_.check()) != StopReason::None) return false;
    if (version_ != control_.version() && !start()) return true;
    if (trace_.plan.size() < 2) return true;
    slide(evaluations);
    if (trace_.plan.size() >= 2 && effort_ > kLeastEffort) gather(evaluations);
    if (trace_.plan.size() >= 2 && effort_ > kLeastEffort) drop(evaluations);
    // What a window takes besides its evaluations: the order, the needs, the states along the plan.
    evaluations -= 3 + static_cast<std::int64_t>(trace_.plan.size() / 4);
  }
  return true;
}

}  // namespace stepwright::pddl
