#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "cell/trial/judge.h"
#include "cell/trial/level_change.h"

namespace stepwright::trial {
namespace {

using translate::ActionBinding;
using translate::Binding;

// Nominal durations serve schedules: off by less than this share of the measured one, or this time, is near.
constexpr double kNear = 0.3;
constexpr double kNear_s = 0.5;

// What a duration counts of an action: the change of the fluent, or its value where that does not change.
std::optional<double> counted(const ActionRun& run, const Binding& binding, const translate::Pattern& of) {
  translate::Assignment assignment;
  (void)binding.action_for(run.planned.action, assignment);
  const std::string fluent = translate::instantiate(of, assignment);
  const auto before = run.planned.before.fluents.find(fluent);
  const auto after = run.planned.after.fluents.find(fluent);
  if (before == run.planned.before.fluents.end() || after == run.planned.after.fluents.end())
    return std::nullopt;
  const double change = std::abs(after->second - before->second);
  return change != 0.0 ? change : std::abs(after->second);
}

struct Line {
  double fixed_s = 0.0;
  double per_unit_s = 0.0;
};

// Least squares through (counted, seconds), with no negative time; nothing where all count the same.
std::optional<Line> fit(const std::vector<std::pair<double, double>>& points) {
  const auto count = static_cast<double>(points.size());
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const auto& [amount, time_s] : points) {
    x += amount / count;
    y += time_s / count;
  }
  for (const auto& [amount, time_s] : points) {
    xx += (amount - x) * (amount - x);
    xy += (amount - x) * (time_s - y);
  }
  if (xx < 1e-9) return std::nullopt;
  Line line{y - xy / xx * x, xy / xx};
  if (line.per_unit_s < 0.0) return Line{y, 0.0};
  if (line.fixed_s < 0.0) return Line{0.0, x > 0.0 ? y / x : 0.0};
  return line;
}

std::string written(const Line& line, const std::optional<translate::Pattern>& of) {
  if (!of || line.per_unit_s <= 0.0) return fmt::format("duration = {{ fixed_s = {:.3g} }}", line.fixed_s);
  return fmt::format("duration = {{ fixed_s = {:.3g}, per_unit_s = {:.3g}, of = \"{}\" }}", line.fixed_s,
                     line.per_unit_s, translate::to_string(*of));
}

// The fluent that the time is counted by: the entry's own, or the one that ends its actions.
std::optional<translate::Pattern> measure_of(const ActionBinding& entry) {
  if (entry.duration.of) return entry.duration.of;
  if (entry.completion.kind == translate::CompletionKind::Fluent) return entry.completion.atom;
  return std::nullopt;
}

}  // namespace

Findings judge_duration(const Binding& binding, const ActionBinding& entry, std::span<const ActionRun> runs) {
  const auto of = measure_of(entry);
  // Runs of one action from several starts may have other amounts to move.
  std::map<std::pair<std::string, double>, std::vector<ActionRun>> by_amount;
  std::vector<std::pair<double, double>> points;
  for (const ActionRun& run : runs) {
    if (run.end != RunEnd::Done || began_elsewhere(binding, run)) continue;
    const double amount = of ? counted(run, binding, *of).value_or(0.0) : 0.0;
    by_amount[{model::to_string(run.planned.action), amount}].push_back(run);
    points.emplace_back(amount, run.active_s);
  }
  double worst = 1.0;
  std::string message;
  for (const auto& [of_runs, own] : by_amount) {
    const auto& [action, amount] = of_runs;
    const Spread spread = spread_of(own);
    const double nominal_s =
        entry.duration.fixed_s + (entry.duration.of ? entry.duration.per_unit_s * amount : 0.0);
    const double allowed_s = std::max(kNear_s, kNear * spread.mean_s);
    const double off = std::abs(nominal_s - spread.mean_s) / allowed_s;
    if (off <= worst) continue;
    worst = off;
    message = fmt::format("{} takes {:.3g} s (spread {:.2g} s over {} runs), and its duration says {:.3g} s",
                          action, spread.mean_s, spread.spread_s, spread.runs, nominal_s);
  }
  if (message.empty()) return {};
  double mean = 0.0;
  for (const auto& [amount, time_s] : points) mean += time_s / static_cast<double>(points.size());
  Line line = fit(points).value_or(Line{mean, 0.0});
  if (of && line.per_unit_s == 0.0 && entry.duration.of && points.front().first > 0.0) {
    line = {entry.duration.fixed_s, std::max(0.0, mean - entry.duration.fixed_s) / points.front().first};
  }
  return {{{"B0030", result::Severity::Error, entry.where, std::move(message), written(line, of)}, {}}};
}

}  // namespace stepwright::trial
