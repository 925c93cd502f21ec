#include "supervisor/translate/schedule.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include "supervisor/translate/change.h"
#include "supervisor/translate/plan_graph.h"
#include "supervisor/translate/stn.h"

namespace stepwright::translate {

namespace {

using Names = std::set<std::string>;

// Nodes of the search for the shortest order.
constexpr std::size_t kMostNodes = 20'000;

double seconds(milliseconds time) {
  return std::chrono::duration<double>(time).count();
}

// Event 0 is the chart's start, 2 i + 1 and 2 i + 2 start and finish of action i, the last one DONE.
std::size_t start_of(std::size_t action) {
  return 2 * action + 1;
}
std::size_t finish_of(std::size_t action) {
  return 2 * action + 2;
}

result::Result<Stn> network(const model::PlannedRun& run, const Binding& binding) {
  const std::size_t done = 2 * run.actions.size() + 1;
  Stn stn(done + 1);
  stn.at_least(0, done, seconds(binding.start) + seconds(binding.settle));
  for (std::size_t i = 0; i < run.actions.size(); ++i) {
    auto duration = nominal_duration(run.actions[i], binding);
    if (!duration) return result::forward(duration);
    stn.at_least(0, start_of(i), seconds(binding.start));
    stn.at_least(start_of(i), finish_of(i), *duration);
    stn.at_most(start_of(i), finish_of(i), *duration);
    stn.at_least(finish_of(i), done, seconds(binding.settle));
  }
  return stn;
}

void wait_for(Stn& stn, std::size_t before, std::size_t after) {
  stn.at_least(finish_of(before), start_of(after), 0.0);
}

void read(const model::Expression& expression, Names& names) {
  if (expression.kind == model::ExpressionKind::Fluent) names.insert(expression.fluent);
  for (const model::Expression& operand : expression.operands) read(operand, names);
}

void read(const model::Condition& condition, Names& names) {
  if (condition.kind == model::ConditionKind::Fact) names.insert(condition.fact);
  if (condition.kind == model::ConditionKind::Compare) {
    read(condition.left, names);
    read(condition.right, names);
  }
  for (const model::Condition& child : condition.children) read(child, names);
}

std::vector<std::string> common(const Names& a, const Names& b) {
  std::vector<std::string> names;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(names));
  return names;
}

ScheduleLink reason(const model::PlannedRun& run, const std::vector<Exclusion>& pairs,
                    const model::Ordering& edge) {
  ScheduleLink link{edge.before, edge.after, LinkKind::Causal, {}};
  for (const Exclusion& pair : pairs) {
    if (pair.first != edge.before || pair.second != edge.after) continue;
    link.kind = LinkKind::Resource;
    link.what = pair.outputs;
    return link;
  }
  Names needs_before, needs_after;
  read(run.actions[edge.before].precondition, needs_before);
  read(run.actions[edge.after].precondition, needs_after);
  const Names makes = changed_atoms(run.actions[edge.before]);
  link.what = common(makes, needs_after);
  if (!link.what.empty()) return link;
  const Names undoes = changed_atoms(run.actions[edge.after]);
  link.kind = LinkKind::Threat;
  link.what = common(undoes, needs_before);
  if (link.what.empty()) link.what = common(undoes, makes);
  if (link.what.empty()) link.kind = LinkKind::Listed;
  return link;
}

// The times of a network without contradictions, which a graph of actions always gives.
void fill_times(const Stn& stn, Schedule& schedule) {
  const auto earliest = stn.earliest();
  const auto latest = stn.latest(stn.size() - 1, earliest->back());
  schedule.makespan_s = earliest->back();
  for (std::size_t i = 0; finish_of(i) + 1 < stn.size(); ++i) {
    schedule.actions.push_back({(*earliest)[start_of(i)], (*earliest)[finish_of(i)], (*latest)[start_of(i)],
                                (*latest)[finish_of(i)]});
  }
}

// Branches on which of two actions that exclude each other comes first.
class OrderSearch {
 public:
  OrderSearch(Stn stn, std::vector<Exclusion> pairs, double makespan_s)
      : stn_(std::move(stn)), pairs_(std::move(pairs)), best_s_(makespan_s) {}

  // The start times of a schedule that is shorter than the makespan given, if there is one.
  std::optional<std::vector<double>> run() {
    descend();
    return std::move(best_);
  }

 private:
  void descend() {
    if (++nodes_ > kMostNodes) return;
    const auto times = stn_.earliest();
    if (!times || times->back() >= best_s_ - 1e-6) return;
    const Exclusion* open = overlapping(*times);
    if (open == nullptr) {
      best_ = *times;
      best_s_ = times->back();
      return;
    }
    std::array order = {std::pair(open->first, open->second), std::pair(open->second, open->first)};
    if ((*times)[start_of(open->second)] < (*times)[start_of(open->first)]) std::swap(order[0], order[1]);
    for (const auto& [before, after] : order) {
      wait_for(stn_, before, after);
      descend();
      stn_.pop();
    }
  }

  // The pair that overlaps earliest.
  const Exclusion* overlapping(const std::vector<double>& times) const {
    const Exclusion* found = nullptr;
    double at = std::numeric_limits<double>::infinity();
    for (const Exclusion& pair : pairs_) {
      const double begin = std::max(times[start_of(pair.first)], times[start_of(pair.second)]);
      const double end = std::min(times[finish_of(pair.first)], times[finish_of(pair.second)]);
      if (begin >= end - 1e-6 || begin >= at) continue;
      found = &pair;
      at = begin;
    }
    return found;
  }

  Stn stn_;
  std::vector<Exclusion> pairs_;
  double best_s_;
  std::optional<std::vector<double>> best_;
  std::size_t nodes_ = 0;
};

}  // namespace

result::Result<double> nominal_duration(const model::PlannedAction& planned, const Binding& binding) {
  Assignment assignment;
  const ActionBinding& entry = *binding.action_for(planned.action, assignment);
  double duration = entry.duration.fixed_s + seconds(entry.rest);
  if (!entry.duration.of) return duration;
  const std::string fluent = instantiate(*entry.duration.of, assignment);
  const auto before = planned.before.fluents.find(fluent);
  const auto after = planned.after.fluents.find(fluent);
  if (before == planned.before.fluents.end() || after == planned.after.fluents.end()) {
    return result::fail("T0003", entry.where,
                        "the duration of " + to_string(planned.action) + " counts " + fluent +
                            ", which the plan's states lack");
  }
  const double change = std::abs(after->second - before->second);
  duration += entry.duration.per_unit_s * (change != 0.0 ? change : std::abs(after->second));
  return duration;
}

const char* to_string(LinkKind kind) {
  static constexpr std::array kNames = {"causal", "threat", "resource", "listed"};
  return kNames[static_cast<std::size_t>(kind)];
}

result::Result<Schedule> schedule(const model::PlannedRun& run, const Binding& binding, bool sequential) {
  auto graph = plan_graph(run, binding, sequential);
  if (!graph) return result::forward(graph);
  auto stn = network(run, binding);
  if (!stn) return result::forward(stn);
  Schedule schedule;
  const auto pairs = sequential ? std::vector<Exclusion>() : exclusions(run, binding);
  for (const model::Ordering& edge : graph->orderings()) {
    wait_for(*stn, edge.before, edge.after);
    schedule.links.push_back(reason(run, pairs, edge));
  }
  fill_times(*stn, schedule);
  return schedule;
}

Schedule unit_schedule(const model::PlannedRun& run) {
  const std::size_t size = run.actions.size();
  std::vector<model::Ordering> listed;
  for (std::size_t i = 1; i < size; ++i) listed.push_back({i - 1, i});
  Stn stn(2 * size + 2);
  for (std::size_t i = 0; i < size; ++i) {
    stn.at_least(start_of(i), finish_of(i), 1.0);
    stn.at_most(start_of(i), finish_of(i), 1.0);
    stn.at_least(finish_of(i), 2 * size + 1, 0.0);
  }
  Schedule schedule;
  for (const model::Ordering& edge : reduced_graph(size, run.orderings.value_or(listed)).orderings()) {
    wait_for(stn, edge.before, edge.after);
    schedule.links.push_back(reason(run, {}, edge));
  }
  fill_times(stn, schedule);
  return schedule;
}

result::Result<std::vector<std::size_t>> makespan_order(const model::PlannedRun& run,
                                                        const Binding& binding) {
  auto listed = schedule(run, binding, false);
  if (!listed) return result::forward(listed);
  std::vector<std::size_t> order(run.actions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (!run.orderings) return order;
  auto pairs = exclusions(run, binding);
  auto stn = network(run, binding);
  if (!stn) return result::forward(stn);
  for (const model::Ordering& edge : *run.orderings) wait_for(*stn, edge.before, edge.after);
  const auto times = OrderSearch(std::move(*stn), std::move(pairs), listed->makespan_s).run();
  if (times) {
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return (*times)[start_of(a)] < (*times)[start_of(b)];
    });
  }
  return order;
}

}  // namespace stepwright::translate
