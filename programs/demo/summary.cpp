#include "programs/demo/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace stepwright::demo {
namespace {

using nlohmann::json;

double makespan_s(const run::RunRecord& record) {
  return record.finished_s - record.started_s;
}

bool any_ended(const run::RunRecord& record) {
  return std::ranges::any_of(record.episodes, [](const run::Episode& episode) {
    return std::ranges::any_of(episode.actions,
                               [](const run::ActionRecord& action) { return action.finished_s.has_value(); });
  });
}

std::optional<double> sequential_makespan_s(const std::optional<CellRunResult>& sequential) {
  const bool usable = sequential && sequential->report && sequential->exit == result::ExitCode::Done;
  return usable ? std::optional<double>(makespan_s(sequential->report->record)) : std::nullopt;
}

void add_record(const run::RunRecord& record, json& out) {
  out["goal_reached"] = record.phase == run::Phase::Done;
  out["replans"] = record.replans.size();
  out["message"] = record.message;
  out["makespan_s"] = makespan_s(record);
  if (record.episodes.empty()) return;
  const run::Episode& first = record.episodes.front();  // the plan for the problem as it was set
  out["plan_steps"] = first.actions.size();
  out["plan_cost"] = first.cost;
  out["plan_proved_optimal"] = first.proved_optimal;
  out["first_plan_ms"] = first.first_plan_ms;
  out["optimal_plan_ms"] = first.optimal_plan_ms;
  out["planned_makespan_s"] = first.planned_makespan_s;
  out["planned_sequential_makespan_s"] = first.planned_sequential_makespan_s;
}

void add_runtime(const host::RuntimeStatus& runtime, json& out) {
  out["scans"] = runtime.scan;
  out["overruns"] = runtime.overruns;
  out["scan_p50_us"] = runtime.scan_p50_us;
  out["scan_p99_us"] = runtime.scan_p99_us;
  out["scan_max_us"] = runtime.scan_max_us;
  out["realtime_factor"] = runtime.realtime_factor;
  out["trace_hash"] = fmt::format("{:016x}", runtime.trace_hash);
  for (const host::NamedValue& value : runtime.plant) {  // "level_a1_percent" and the like
    if (value.name.ends_with("_percent")) out[value.name] = value.value;
  }
  json& plant = out["plant"] = json::object();
  for (const host::NamedValue& value : runtime.plant) plant[value.name] = value.value;
}

// What only a cell with a fleet has; overlaps are counted by the plant's own judge.
void add_fleet(const run::Report& report, json& out) {
  const auto found = report.record.details.find("fleet");  // supervisor/doc/fleet_executive.md
  const json document =
      found == report.record.details.end() ? json() : json::parse(found->second, nullptr, false);
  if (!document.is_object()) return;
  json& fleet = out["fleet"] = json::object();
  std::uint64_t delivered = 0;
  for (const json& goal : document.value("goals", json::array())) delivered += goal.value("delivered", 0U);
  fleet["delivered"] = delivered;
  fleet["plans"] = report.record.episodes.size();
  fleet["vehicles"] = document.value("vehicles", json::array());
  fleet["goals"] = document.value("goals", json::array());
  fleet["retime_ms"] = document.value("retime_ms", 0.0);
  fleet["retimings"] = document.value("retimings", 0U);
  for (const host::NamedValue& value : report.runtime.plant) {
    if (value.name == "overlaps" || value.name == "obstacle_overlaps") fleet[value.name] = value.value;
    if (value.name == "smallest_gap") fleet["smallest_gap_m"] = value.value;
  }
}

}  // namespace

std::string summary_json(const CellRunResult& run, const std::optional<CellRunResult>& sequential) {
  json out = {{"exit_code", to_int(run.exit)}, {"processes", run.processes}, {"restarts", run.restarts}};
  if (!run.message.empty()) out["message"] = run.message;
  if (run.report) {
    add_record(run.report->record, out);
    add_runtime(run.report->runtime, out);
    add_fleet(*run.report, out);
    out["record"] = json::parse(run::to_json(run.report->record));
  }
  const auto strict = sequential_makespan_s(sequential);
  out["sequential_makespan_s"] = strict ? json(*strict) : json(nullptr);
  return out.dump(2);
}

std::string summary_text(const CellRunResult& run, const std::optional<CellRunResult>& sequential) {
  if (!run.report) return run.message;
  const run::RunRecord& record = run.report->record;
  const host::RuntimeStatus& runtime = run.report->runtime;
  std::string text;
  const auto out = std::back_inserter(text);
  if (record.phase == run::Phase::Done)
    fmt::format_to(out, "Makespan {:.1f} s", makespan_s(record));
  else
    fmt::format_to(out, "The goal was not reached; {}",
                   any_ended(record) ? fmt::format("the last action ended after {:.1f} s", makespan_s(record))
                                     : "no action ended");
  if (const auto strict = sequential_makespan_s(sequential)) {
    fmt::format_to(out, ", strictly sequential {:.1f} s ({:.2f} times as long)", *strict,
                   *strict / makespan_s(record));
  }
  fmt::format_to(
      out,
      "\nScan p50 {:.2f} us, p99 {:.2f} us, max {:.1f} us over {} scans, {} overruns; {:.0f} x real time\n",
      runtime.scan_p50_us, runtime.scan_p99_us, runtime.scan_max_us, runtime.scan, runtime.overruns,
      runtime.realtime_factor);
  for (const host::NamedValue& value : runtime.plant) {
    if (value.name.ends_with("_percent")) fmt::format_to(out, "  {:<24} {:6.2f}\n", value.name, value.value);
  }
  fmt::format_to(out, "Trace hash {:016x}\n", runtime.trace_hash);
  return text;
}

}  // namespace stepwright::demo
