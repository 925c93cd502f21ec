#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "supervisor/run/report.h"

namespace stepwright::run {
namespace {

std::string seconds(const std::optional<double>& value, double origin) {
  return value ? fmt::format("{:8.2f}", *value - origin) : std::string("       -");
}

std::string proof_of(const Episode& episode) {
  if (episode.proved_optimal) return ", proved optimal";
  return episode.bound ? fmt::format(" (no plan below {:g})", *episode.bound) : " (no bound known)";
}

void add_episode(const Episode& episode, std::size_t number, std::size_t count, std::string& text) {
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "Plan {} of {}: {} actions, cost {:g}{}\n", number, count, episode.actions.size(),
                 episode.cost, proof_of(episode));
  fmt::format_to(out, "   # {:<34} {:<8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8}\n", "action", "state", "plan s",
                 "start s", "plan s", "end s", "cost", "actual");
  for (std::size_t i = 0; i < episode.actions.size(); ++i) {
    const ActionRecord& action = episode.actions[i];
    fmt::format_to(out, "  {:2} {:<34} {:<8} {:8.2f} {} {:8.2f} {} {:8.2f} {}\n", i + 1, action.text,
                   to_string(action.state), action.planned_start_s,
                   seconds(action.started_s, episode.started_s), action.planned_finish_s,
                   seconds(action.finished_s, episode.started_s), action.planned_cost,
                   action.actual_cost ? fmt::format("{:8.2f}", *action.actual_cost) : "       -");
  }
}

// Every plan but the first comes from one replan; the first does if the plant was not in its initial state.
std::size_t replans_before_first_plan(const RunRecord& record) {
  if (record.episodes.empty()) return 0;
  const double started_s = record.episodes.front().started_s;
  return static_cast<std::size_t>(
      std::count_if(record.replans.begin(), record.replans.end(),
                    [started_s](const Replan& replan) { return replan.time_s < started_s; }));
}

void add_incidents(const RunRecord& record, std::string& text) {
  const auto out = std::back_inserter(text);
  for (const Incident& incident : record.incidents) {
    fmt::format_to(out, "Incident at {:.2f} s, {}: {}\n", incident.time_s, to_string(incident.kind),
                   fmt::join(incident.evidence, "; "));
    for (const Alarm& alarm : incident.alarms) fmt::format_to(out, "  alarm: {}\n", to_string(alarm));
    fmt::format_to(out, "  decision: {} in {:.1f} ms", to_string(incident.response), incident.decision_ms);
    if (incident.remaining > 0) {
      fmt::format_to(out, ", {} of {} actions kept (repair {:.1f} ms, new plan {:.1f} ms)", incident.kept,
                     incident.remaining, incident.repair_ms, incident.replan_ms);
    }
    fmt::format_to(out, "\n");
  }
}

}  // namespace

std::string report_table(const RunRecord& record) {
  std::string text;
  const auto out = std::back_inserter(text);
  std::size_t told = 0;
  const auto tell_replans = [&](std::size_t end) {
    for (; told < std::min(end, record.replans.size()); ++told) {
      fmt::format_to(out, "Replanned at {:.2f} s: {}\n", record.replans[told].time_s,
                     record.replans[told].cause);
    }
  };
  const std::size_t before_first = replans_before_first_plan(record);
  for (std::size_t i = 0; i < record.episodes.size(); ++i) {
    tell_replans(before_first + i);
    add_episode(record.episodes[i], i + 1, record.episodes.size(), text);
  }
  tell_replans(record.replans.size());  // the last one may have found no plan
  add_incidents(record, text);
  fmt::format_to(out, "Levels at the end (planned, observed):\n");
  for (const auto& [fluent, expected] : record.expected) {
    const auto observed = record.observed.find(fluent);
    if (observed != record.observed.end()) {
      fmt::format_to(out, "  {:<16} {:8.2f} {:8.2f}\n", fluent, expected, observed->second);
    }
  }
  fmt::format_to(out, "Goal:\n");
  for (const GoalRecord& goal : record.goal) {
    fmt::format_to(out, "  {:<8} {}\n", goal.met ? "met" : "NOT MET", goal.text);
  }
  fmt::format_to(out, "{}: {}\n", to_string(record.phase), record.message);
  return text;
}

}  // namespace stepwright::run
