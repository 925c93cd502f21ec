// What a campaign says: the table for people, the JSON for programs.

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "cell/campaign/campaign.h"

namespace stepwright::campaign {
namespace {

using nlohmann::json;

constexpr std::size_t kMostShown = 20;

// Where there is no planner there is no goal: a cell has held its process values.
const char* word(Verdict verdict, bool planned) {
  return verdict == Verdict::GoalReached && !planned ? "held" : to_string(verdict);
}

// As wide as the longest name.
std::size_t first_column(const Campaign& campaign) {
  std::size_t wide = 24;
  for (const auto& [fault, tally] : campaign.by_fault) wide = std::max(wide, fault.size());
  return wide;
}

std::string row(const std::string& name, const Tally& tally, std::size_t wide) {
  return fmt::format("{:<{}} {:>7} {:>7} {:>7} {:>7} {:>9}\n", name, wide, tally.runs,
                     tally.count(Verdict::GoalReached), tally.count(Verdict::SafeStop),
                     tally.count(Verdict::Lost), tally.count(Verdict::Violated));
}

std::string head(const char* what, const Campaign& campaign, std::size_t wide) {
  return fmt::format("{:<{}} {:>7} {:>7} {:>7} {:>7} {:>9}\n", what, wide, "runs",
                     word(Verdict::GoalReached, campaign.planned), "safe", "lost", "violated");
}

json to_json(const Tally& tally) {
  json entry = {{"runs", tally.runs}};
  for (const Verdict verdict : {Verdict::GoalReached, Verdict::SafeStop, Verdict::Lost, Verdict::Violated})
    entry[to_string(verdict)] = tally.count(verdict);
  return entry;
}

json to_json(const DrawnFault& fault) {
  json entry = {{"name", fault.name}, {"unit", fault.unit}, {"value", fault.value}, {"at_s", fault.at_s}};
  if (fault.ends_s) entry["ends_s"] = *fault.ends_s;
  return entry;
}

json to_json(const CellRun& run) {
  json faults = json::array();
  for (const DrawnFault& fault : run.disturbance.faults) faults.push_back(to_json(fault));
  return {{"seed", run.seed},
          {"verdict", to_string(run.verdict)},
          {"cause", run.cause},
          {"why", run.why},
          {"printed", run.printed},
          {"faults", faults},
          {"refused", run.refused},
          {"alarms", run.alarms},
          {"replans", run.replans},
          {"time_s", run.time_s},
          {"trace_hash", fmt::format("{:016x}", run.trace_hash)}};
}

// Behind the line that says that the plant is lost.
std::string quoted(const std::string& printed) {
  if (printed.empty()) return {};
  std::string text = "\n  its processes have printed last:";
  for (std::size_t at = 0; at < printed.size();) {
    const std::size_t end = std::min(printed.find('\n', at), printed.size());
    text += "\n    " + printed.substr(at, end - at);
    at = end + 1;
  }
  return text;
}

}  // namespace

std::string story(const CellRun& run) {
  std::string text =
      fmt::format("seed {}: {}: {}", run.seed, to_string(run.verdict), run.disturbance.words());
  const auto out = std::back_inserter(text);
  if (!run.why.empty()) fmt::format_to(out, "\n  {}{}", run.why, quoted(run.printed));
  if (!run.cause.empty()) fmt::format_to(out, "\n  cause: {}", run.cause);
  for (const std::string& name : run.refused) fmt::format_to(out, "\n  the plant did not take {}", name);
  for (const std::string& alarm : run.alarms) fmt::format_to(out, "\n  alarm {}", alarm);
  fmt::format_to(out, "\n  {:.1f} s of plant time, {} replan{}, trace {:016x}\n", run.time_s, run.replans,
                 run.replans == 1 ? "" : "s", run.trace_hash);
  return text;
}

std::string table(const Campaign& campaign) {
  std::string text = fmt::format("{}: {} fault{}, within {:.1f} s", campaign.cell, campaign.offered,
                                 campaign.offered == 1 ? "" : "s", campaign.horizon_s);
  const auto out = std::back_inserter(text);
  if (campaign.without_range > 0)
    fmt::format_to(out, "; {} more {} no range and {} not tried", campaign.without_range,
                   campaign.without_range == 1 ? "has" : "have", campaign.without_range == 1 ? "is" : "are");
  fmt::format_to(out, "\nundisturbed: {}{}{}{}\n\n", word(campaign.undisturbed.verdict, campaign.planned),
                 campaign.undisturbed.why.empty() ? "" : ": ", campaign.undisturbed.why,
                 quoted(campaign.undisturbed.printed));
  const std::size_t wide = first_column(campaign);
  text += head("disturbance", campaign, wide);
  for (const auto& [kind, tally] : campaign.by_kind) text += row(kind, tally, wide);
  if (!campaign.by_fault.empty()) text += "\n" + head("fault", campaign, wide);
  for (const auto& [fault, tally] : campaign.by_fault) text += row(fault, tally, wide);
  if (!campaign.causes.empty()) text += "\ncauses\n";
  for (const auto& [cause, runs] : campaign.causes) fmt::format_to(out, "  {:<22} {:>7}\n", cause, runs);
  fmt::format_to(out, "\n{:.1f} s\n", campaign.wall_s);
  for (std::size_t i = 0; i < std::min(kMostShown, campaign.failures.size()); ++i)
    text += story(campaign.failures[i]);
  if (campaign.failures.size() > kMostShown)
    fmt::format_to(out, "and {} more\n", campaign.failures.size() - kMostShown);
  return text;
}

std::string to_json(const Campaign& campaign) {
  json document = {{"cell", campaign.cell},
                   {"first_seed", campaign.options.first},
                   {"jobs", campaign.options.jobs},
                   {"planned", campaign.planned},
                   {"horizon_s", campaign.horizon_s},
                   {"faults_offered", campaign.offered},
                   {"faults_without_range", campaign.without_range},
                   {"undisturbed", to_json(campaign.undisturbed)},
                   {"wall_s", campaign.wall_s},
                   {"causes", campaign.causes}};
  const auto all = campaign.by_kind.find("all");
  document.update(to_json(all == campaign.by_kind.end() ? Tally{} : all->second));
  for (const auto& [kind, tally] : campaign.by_kind) document["by_disturbance"][kind] = to_json(tally);
  for (const auto& [fault, tally] : campaign.by_fault) document["by_fault"][fault] = to_json(tally);
  document["last"] = to_json(campaign.last);
  document["failures"] = json::array();
  for (const CellRun& run : campaign.failures) document["failures"].push_back(to_json(run));
  return document.dump(2, ' ', false, json::error_handler_t::replace);  // plants print what they like
}

}  // namespace stepwright::campaign
