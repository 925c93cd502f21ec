#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cell/trial/trial.h"
#include "runtime/ground/process/diagnostics_json.h"

namespace stepwright::trial {
namespace {

std::string plural(std::size_t count, const char* word) {
  return fmt::format("{} {}{}", count, word, count == 1 ? "" : "s");
}

}  // namespace

std::string to_text(const TrialReport& report) {
  std::size_t width = 6;
  for (const ActionTrial& trial : report.actions)
    width = std::max(width, model::to_string(trial.action).size());
  std::string text = fmt::format("{:<{}}  {:>6} {:>5} {:>9} {:>8} {:>10}\n", "action", width, "starts",
                                 "runs", "takes s", "spread", "duration s");
  std::size_t runs = 0;
  for (const ActionTrial& trial : report.actions) {
    runs += trial.runs;
    const bool ended = trial.duration.runs > 0;
    text += fmt::format("{:<{}}  {:>6} {:>5} {:>9} {:>8} {:>10}{}\n", model::to_string(trial.action), width,
                        trial.starts, trial.runs, ended ? fmt::format("{:.2f}", trial.duration.mean_s) : "-",
                        ended ? fmt::format("{:.2f}", trial.duration.spread_s) : "-",
                        fmt::format("{:.2f}", trial.nominal_s), trial.problems > 0 ? "  !" : "");
  }
  for (const std::string& action : report.never)
    text += fmt::format("{:<{}}  no plan leads to where it may start\n", action, width);
  if (report.left_out > 0)
    text +=
        fmt::format("{} not tried: every object was tried, or sought, in every place; --every tries all\n",
                    plural(report.left_out, "more ground action"));
  if (!report.complete) text += "there are more ground actions than these; --action tries others\n";
  text += fmt::format("{} in {}: {}; {:.0f} s simulated in {:.1f} s\n",
                      plural(report.actions.size(), "action"), plural(runs, "run"),
                      plural(report.problems.size(), "problem"), report.simulated_s, report.wall_s);
  return text;
}

std::string to_json(const TrialReport& report) {
  nlohmann::json actions = nlohmann::json::array();
  for (const ActionTrial& trial : report.actions) {
    actions.push_back({{"action", model::to_string(trial.action)},
                       {"line", trial.where.line},
                       {"starts", trial.starts},
                       {"runs", trial.runs},
                       {"done", trial.duration.runs},
                       {"mean_s", trial.duration.mean_s},
                       {"spread_s", trial.duration.spread_s},
                       {"longest_s", trial.duration.longest_s},
                       {"duration_s", trial.nominal_s},
                       {"problems", trial.problems}});
  }
  const nlohmann::json json = {{"sound", !result::has_errors(report.problems)},
                               {"actions", std::move(actions)},
                               {"never", report.never},
                               {"left_out", report.left_out},
                               {"complete", report.complete},
                               {"cancelled", report.cancelled},
                               {"diagnostics", process::diagnostics_json(report.problems)},
                               {"simulated_s", report.simulated_s},
                               {"wall_s", report.wall_s}};
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace stepwright::trial
