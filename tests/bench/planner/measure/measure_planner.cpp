#include <algorithm>
#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>
#include <sstream>

#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/planner/solve.h"
#include "tests/bench/planner/baseline/hill_climbing.h"
#include "tests/bench/planner/measure/child.h"
#include "tests/bench/planner/measure/judge.h"
#include "tests/bench/planner/measure/measurement.h"

namespace stepwright::bench {
namespace {

using Clock = std::chrono::steady_clock;
using nlohmann::json;

// What a planner may take beyond its budget before it is ended, and what its process holds beside its search.
constexpr std::chrono::seconds kGrace{10};
constexpr std::size_t kBesideMb = 512;

// Costs that differ by less, in relation, are the same: sums in another order.
constexpr double kSame = 1e-6;

struct Stopwatch {
  Clock::time_point start = Clock::now();

  double wall_ms() const { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }
  static double cpu_ms() { return 1000.0 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }
};

// The plan is one text with a line for each action: it can have millions.
json plan_line(const Stopwatch& watch, const std::vector<model::GroundAction>& actions) {
  json line = {{"wall_ms", watch.wall_ms()}, {"cpu_ms", Stopwatch::cpu_ms()}};
  std::string text;
  for (const model::GroundAction& action : actions) (text += model::to_string(action)) += '\n';
  line["plan"] = std::move(text);
  return line;
}

pddl::Task read(const Instance& instance) {
  return *pddl::parse_task({"domain", instance.domain}, {"problem", instance.problem});
}

ChildLimits child_limits(const Limits& limits) {
  return {limits.time + limits.time / 2 + kGrace, limits.memory_mb + limits.memory_mb / 4 + kBesideMb};
}

void run_planner(const Instance& instance, const Limits& limits, const Send& send) {
  const Stopwatch watch;
  const pddl::Task task = read(instance);
  pddl::Options options;
  options.first_only = limits.first_only;
  options.budget = {limits.time, limits.memory_mb};
  options.on_improvement = [&](const model::Plan& plan) {
    json line = plan_line(watch, plan.actions);
    line["cost"] = plan.cost;
    send(line.dump());
  };
  const model::Outcome outcome = pddl::solve(task, options);
  json line = {{"expanded", outcome.expanded},
               {"wall_ms", watch.wall_ms()},
               {"reason", outcome.reason},
               {"infeasible", outcome.kind == model::OutcomeKind::Infeasible}};
  if (outcome.plan) {
    line.update(plan_line(watch, outcome.plan->actions));
    line["cost"] = outcome.plan->cost;
    line["bound"] = outcome.plan->bound;
    line["proved"] = outcome.plan->proved_optimal;
  }
  send(line.dump());
}

void run_grounding(const Instance& instance, const Limits& limits, const Send& send) {
  const pddl::Task task = read(instance);
  const Stopwatch watch;
  const auto late = [&] { return watch.wall_ms() > static_cast<double>(limits.time.count()); };
  const pddl::GroundTask ground = pddl::ground_task(task.definition(), late);
  if (ground.cancelled) return;
  const json line = {{"ms", watch.wall_ms()},
                     {"operators", ground.operators.size()},
                     {"facts", ground.facts.size()},
                     {"variables", ground.variables.size()}};
  send(line.dump());
}

void run_baseline(const Instance& instance, const Limits& limits, const Send& send) {
  const Stopwatch watch;
  const pddl::Task task = read(instance);
  const Baseline result = hill_climbing(task, {limits.time, limits.memory_mb});
  json line = {{"expanded", result.evaluated}, {"wall_ms", watch.wall_ms()}, {"reason", result.reason}};
  if (result.found) line.update(plan_line(watch, result.actions));
  send(line.dump());
}

// Takes over a plan that is valid, and better than the last one.
void take_plan(const json& line, const pddl::Task& task, Measurement& to) {
  std::vector<model::GroundAction> actions;
  std::istringstream plan(line["plan"].get_ref<const std::string&>());
  for (std::string text; std::getline(plan, text);) actions.push_back(action_of(text));
  const std::size_t steps = actions.size();
  const Judgement judged = judge(task, std::move(actions));
  if (!judged.wrong.empty()) {
    to.wrong = judged.wrong;
    return;
  }
  if (line.contains("cost") &&
      std::abs(line["cost"].get<double>() - judged.cost) > kSame * std::max(1.0, std::abs(judged.cost))) {
    to.wrong = "the planner says that it costs " + line["cost"].dump() + ", the validator " +
               std::to_string(judged.cost);
    return;
  }
  const double slack = kSame * std::max(1.0, std::abs(judged.cost));
  const bool cheaper = !to.solved() || judged.cost < to.last().cost - slack;
  const bool shorter = !cheaper && judged.cost <= to.last().cost + slack && steps < to.last().steps;
  if (!cheaper && !shorter) return;
  to.profile.push_back({line["wall_ms"], line["cpu_ms"], judged.cost, steps});
}

}  // namespace

Measurement measurement_of(const ChildResult& child, const pddl::Task& task) {
  Measurement result;
  result.wall_ms = child.wall_ms;
  result.cpu_ms = child.cpu_ms;
  result.peak_mb = child.peak_mb;
  result.outcome = to_string(child.end);
  for (const std::string& text : child.lines) {
    const json line = json::parse(text);
    if (line.contains("plan")) take_plan(line, task, result);
    if (!line.contains("expanded")) continue;
    result.expanded = line["expanded"];
    result.wall_ms = line["wall_ms"];
    if (line.value("infeasible", false))
      result.wrong = "it says that there is no plan: " + line["reason"].dump();
    // A bound that is infinite, as long as nothing is proved, is null in JSON.
    if (line.contains("bound") && line["bound"].is_number()) result.bound = line["bound"].get<double>();
    result.proved = line.value("proved", false);
    if (child.end == ChildEnd::Done) result.outcome = line.value("reason", "");
  }
  if (result.solved()) result.outcome = result.proved ? "optimal" : "plan";
  return result;
}

Measurement measure_planner(const Instance& instance, const pddl::Task& task, const Limits& limits) {
  return measurement_of(
      run_child(child_limits(limits), [&](const Send& send) { run_planner(instance, limits, send); }), task);
}

GroundSize measure_grounding(const Instance& instance, const Limits& limits) {
  const ChildResult child =
      run_child(child_limits(limits), [&](const Send& send) { run_grounding(instance, limits, send); });
  if (child.lines.empty()) return {};
  const json line = json::parse(child.lines.back());
  return {line["ms"], line["operators"], line["facts"], line["variables"]};
}

Measurement measure_baseline(const Instance& instance, const pddl::Task& task, const Limits& limits) {
  return measurement_of(
      run_child(child_limits(limits), [&](const Send& send) { run_baseline(instance, limits, send); }), task);
}

}  // namespace stepwright::bench
