#include "cell/trial/trial.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>
#include <utility>

#include "cell/binding/ground_actions.h"
#include "cell/missions/planning/executive_options.h"
#include "cell/trial/sample.h"
#include "cell/trial/starts.h"
#include "supervisor/translate/schedule.h"

namespace stepwright::trial {
namespace {

constexpr std::size_t kMostCombinations = 20'000;

using Told = std::function<void(const TrialProgress&)>;
using translate::ActionBinding;

pddl::Options own_planning(const TrialCell& cell, const TrialOptions& options) {
  const missions::PlanningTable& table = missions::planning_table(cell.config);
  pddl::Options planning;
  planning.optimal = table.optimal;
  planning.budget.time = table.time;
  planning.cancel = options.cancel;
  return planning;
}

class Trial {
 public:
  Trial(const TrialCell& cell, const TrialOptions& options, const Told& told)
      : cell_(cell),
        options_(options),
        told_(told),
        starts_(cell.task, own_planning(cell, options), options.search) {}

  result::Result<TrialReport> run() {
    const auto begin = std::chrono::steady_clock::now();
    std::vector<pddl::GroundActionInfo> wanted = wanted_actions();
    if (wanted.empty() && options_.only)
      return result::fail("M0031", {},
                          "no action of the domain matches " + translate::to_string(*options_.only),
                          "an action as the domain has it, such as --action \"(load ?v ?f ?l)\"");
    samples_only_ = options_.most == 0 && !options_.every && wanted.size() > kTriedEach;
    for (std::size_t i = 0; i < wanted.size() && !cancelled(); ++i) {
      if (told_) told_({i, wanted.size(), model::to_string(wanted[i].action)});
      if (auto tried = try_action(wanted[i]); !tried) return result::forward(tried);
    }
    judge_durations();
    merge_problems();
    report_.cancelled = cancelled();
    report_.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return std::move(report_);
  }

 private:
  bool cancelled() const { return options_.cancel != nullptr && *options_.cancel; }

  std::vector<pddl::GroundActionInfo> wanted_actions() {
    cell_binding::GroundActions all = cell_binding::ground_actions(cell_.task, kMostCombinations);
    report_.complete = all.complete;
    std::vector<pddl::GroundActionInfo> wanted;
    for (pddl::GroundActionInfo& info : all.actions)
      if (!options_.only || translate::match(*options_.only, info.action)) wanted.push_back(std::move(info));
    return wanted;
  }

  const ActionBinding* entry_of(const model::GroundAction& action) const {
    translate::Assignment assignment;
    return cell_.binding.action_for(action, assignment);
  }

  result::Result<void> try_action(const pddl::GroundActionInfo& info) {
    const ActionBinding* const entry = entry_of(info.action);
    if (entry == nullptr) {
      const std::string message = "no entry of the binding matches " + model::to_string(info.action);
      found_.push_back(
          {{"B0009", result::Severity::Error, {cell_.binding.file, 0, 0}, message, {}}, std::string()});
      return {};
    }
    if (options_.most > 0 && tried_of_[entry] >= options_.most) return {};
    if (samples_only_ && !samples_[entry].wants(info.action)) {
      ++report_.left_out;
      return {};
    }
    std::vector<Start> starts = starts_.of(info);
    // The way to a second state is long, and what it shows of an entry one of its actions shows.
    if (samples_only_ && tried_of_[entry] > 0 && starts.size() > 1) starts.resize(1);
    if (starts.empty()) {
      samples_[entry].note_unreachable(info.action);
      report_.never.push_back(model::to_string(info.action));
      return {};
    }
    samples_[entry].note_tried(info.action);
    ++tried_of_[entry];
    return run_all(info.action, *entry, starts);
  }

  result::Result<void> run_all(const model::GroundAction& action, const ActionBinding& entry,
                               const std::vector<Start>& starts) {
    ActionTrial trial{.action = action, .where = entry.where, .starts = starts.size()};
    std::vector<ActionRun> runs;
    Findings found;
    for (const Start& start : starts) {
      auto of_start = run_seeds(start, action);
      if (!of_start) return result::forward(of_start);
      add_new(judge_runs(cell_.binding, *of_start), found);
      std::ranges::move(*of_start, std::back_inserter(runs));
    }
    trial.runs = runs.size();
    if (!runs.empty()) {
      trial.nominal_s = nominal_s(runs, entry);
      trial.duration = spread_of(runs);
      trial.problems = found.size();
      std::ranges::move(found, std::back_inserter(found_));
      std::ranges::move(runs, std::back_inserter(runs_of_[&entry]));
    }
    report_.actions.push_back(std::move(trial));
    return {};
  }

  // The mean over the runs that the measured time is a mean of; over all of them if none was done.
  double nominal_s(std::span<const ActionRun> runs, const ActionBinding& entry) const {
    const bool any = std::ranges::any_of(runs, [](const ActionRun& run) { return run.end == RunEnd::Done; });
    double sum = 0.0;
    std::size_t count = 0;
    for (const ActionRun& run : runs) {
      const auto nominal = translate::nominal_duration(run.planned, cell_.binding);
      if (!nominal || (any && run.end != RunEnd::Done)) continue;
      sum += *nominal - std::chrono::duration<double>(entry.rest).count();
      ++count;
    }
    return count > 0 ? sum / static_cast<double>(count) : 0.0;
  }

  result::Result<std::vector<ActionRun>> run_seeds(const Start& start, const model::GroundAction& action) {
    std::vector<ActionRun> runs;
    for (std::size_t n = 0; n < options_.seeds && !cancelled(); ++n) {
      auto run = run_action(cell_, start.before, action, cell_.config.plant.seed + n);
      if (!run) return result::forward(run);
      report_.simulated_s += run->simulated_s;
      runs.push_back(std::move(*run));
    }
    return runs;
  }

  // What shows from another start as well is said once.
  static void add_new(Findings more, Findings& found) {
    for (Finding& each : more) {
      const bool known =
          std::ranges::any_of(found, [&](const Finding& other) { return other.is_of_kind(each); });
      if (!known) found.push_back(std::move(each));
    }
  }

  void judge_durations() {
    for (const ActionBinding& entry : cell_.binding.actions) {
      std::ranges::move(judge_duration(cell_.binding, entry, runs_of_[&entry]), std::back_inserter(found_));
    }
  }

  // One of each kind at a place; how many more actions have it is said with it.
  void merge_problems() {
    Findings merged;
    std::vector<std::size_t> more;
    for (Finding& each : found_) {
      const auto same = std::ranges::find_if(merged, [&](const Finding& other) {
        const bool at_start = each.code == kNotBegunCode && other.code == each.code;
        return at_start || (other.is_of_kind(each) && other.where.line == each.where.line);
      });
      if (same != merged.end()) {
        ++more[static_cast<std::size_t>(same - merged.begin())];
        continue;
      }
      merged.push_back(std::move(each));
      more.push_back(0);
    }
    for (std::size_t i = 0; i < merged.size(); ++i) {
      if (more[i] > 0 && merged[i].code != kNotBegunCode)
        merged[i].message += more[i] == 1 ? std::string("; so does 1 other of this entry")
                                          : "; so do " + std::to_string(more[i]) + " others of this entry";
    }
    std::ranges::stable_sort(merged,
                             [](const auto& a, const auto& b) { return a.where.line < b.where.line; });
    std::ranges::move(merged, std::back_inserter(report_.problems));
  }

  const TrialCell& cell_;
  const TrialOptions& options_;
  const Told& told_;
  Starts starts_;
  TrialReport report_;
  Findings found_;  // not yet merged
  bool samples_only_ = false;
  std::map<const ActionBinding*, Sample> samples_;
  std::map<const ActionBinding*, std::size_t> tried_of_;
  std::map<const ActionBinding*, std::vector<ActionRun>> runs_of_;
};

}  // namespace

result::Result<TrialReport> try_binding(const config::CellConfig& config, const TrialOptions& options,
                                        const Told& told) {
  const auto cell = TrialCell::open(config);
  if (!cell) return tl::unexpected(cell.error());
  return Trial(*cell, options, told).run();
}

}  // namespace stepwright::trial
