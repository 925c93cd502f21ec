#include "tests/bench/campaign/campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cell/campaign/spread.h"

namespace stepwright::campaign {
namespace {

using nlohmann::json;

void add(const RunResult& run, ClassFigures& figures) {
  ++figures.runs;
  const run::RunRecord& record = run.record;
  if (run.verdict == Verdict::GoalReached) {
    ++figures.goals;
    figures.cost_sum += record.episodes.empty() ? 0.0 : record.episodes.back().cost;
    figures.makespan_sum_s += record.finished_s - record.started_s;
    figures.worst_level_error = std::max(figures.worst_level_error, run.level_error);
  }
  if (run.verdict == Verdict::SafeStop) ++figures.safe_stops;
  if (run.verdict == Verdict::Lost) ++figures.lost;
  figures.replans += record.replans.size();
  figures.worst_replans = std::max<std::uint64_t>(figures.worst_replans, record.replans.size());
  for (const run::Incident& incident : record.incidents) {
    ++figures.incidents[to_string(incident.kind)];
    ++figures.decisions[to_string(incident.response)];
    figures.kept += incident.kept;
    figures.remaining += incident.remaining;
    if (incident.remaining > 0) {
      figures.repairs += incident.kept > 0 ? 1 : 0;
      figures.repair_ms_sum += incident.repair_ms;
      figures.replannings += incident.replan_ms > 0.0 ? 1 : 0;
      figures.replan_ms_sum += incident.replan_ms;
      ++figures.mended;
    }
    figures.decision_ms_sum += incident.decision_ms;
    figures.worst_decision_ms = std::max(figures.worst_decision_ms, incident.decision_ms);
  }
}

void add(const ClassFigures& more, ClassFigures& sum) {
  sum.runs += more.runs;
  sum.goals += more.goals;
  sum.safe_stops += more.safe_stops;
  sum.lost += more.lost;
  sum.cost_sum += more.cost_sum;
  sum.makespan_sum_s += more.makespan_sum_s;
  sum.worst_level_error = std::max(sum.worst_level_error, more.worst_level_error);
  sum.replans += more.replans;
  sum.worst_replans = std::max(sum.worst_replans, more.worst_replans);
  for (const auto& [kind, count] : more.incidents) sum.incidents[kind] += count;
  for (const auto& [response, count] : more.decisions) sum.decisions[response] += count;
  sum.kept += more.kept;
  sum.remaining += more.remaining;
  sum.mended += more.mended;
  sum.repairs += more.repairs;
  sum.repair_ms_sum += more.repair_ms_sum;
  sum.replannings += more.replannings;
  sum.replan_ms_sum += more.replan_ms_sum;
  sum.decision_ms_sum += more.decision_ms_sum;
  sum.worst_decision_ms = std::max(sum.worst_decision_ms, more.worst_decision_ms);
}

double mean(double sum, std::uint64_t count) {
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

std::uint64_t incidents_of(const ClassFigures& figures) {
  std::uint64_t count = 0;
  for (const auto& [kind, number] : figures.incidents) count += number;
  return count;
}

void row(const char* name, const ClassFigures& f, std::string& text) {
  fmt::format_to(std::back_inserter(text),
                 "{:<14} {:>7} {:>7} {:>7} {:>5} {:>8.1f} {:>9.1f} {:>8.2f} {:>6} {:>9.1f} {:>9.1f}\n", name,
                 f.runs, f.goals, f.safe_stops, f.lost, mean(f.cost_sum, f.goals),
                 mean(f.makespan_sum_s, f.goals), mean(static_cast<double>(f.replans), f.runs),
                 f.worst_replans, mean(f.decision_ms_sum, incidents_of(f)), f.worst_decision_ms);
}

json figures_json(const char* name, const ClassFigures& f) {
  return {{"class", name},
          {"runs", f.runs},
          {"goals_reached", f.goals},
          {"safe_stops", f.safe_stops},
          {"lost", f.lost},
          {"cost_mean", mean(f.cost_sum, f.goals)},
          {"makespan_mean_s", mean(f.makespan_sum_s, f.goals)},
          {"worst_level_error", f.worst_level_error},
          {"replans_mean", mean(static_cast<double>(f.replans), f.runs)},
          {"replans_max", f.worst_replans},
          {"incidents", f.incidents},
          {"decisions", f.decisions},
          {"actions_kept", f.kept},
          {"actions_remaining", f.remaining},
          {"mended", f.mended},
          {"suffix_kept", f.repairs},
          {"repair_mean_ms", mean(f.repair_ms_sum, f.mended)},
          {"replan_mean_ms", mean(f.replan_ms_sum, f.replannings)},
          {"decision_mean_ms", mean(f.decision_ms_sum, incidents_of(f))},
          {"decision_max_ms", f.worst_decision_ms}};
}

}  // namespace

ClassFigures Figures::all() const {
  ClassFigures sum;
  for (const ClassFigures& each : of) add(each, sum);
  return sum;
}

Figures campaign(const executive::PlanningService& planning, std::uint64_t first, std::uint64_t runs,
                 unsigned threads, const std::function<void(std::uint64_t done)>& told,
                 const std::atomic<bool>* cancel) {
  Figures figures;
  const auto run = [&](std::uint64_t i) { return run_once(planning, disturbance_of(first + i)); };
  const auto take = [&](const RunResult& result) {
    const Disturbance& disturbance = result.disturbance;
    add(result, figures.of[static_cast<std::size_t>(disturbance.of)]);
    figures.run_ms_sum += result.wall_ms;
    if (result.verdict == Verdict::Lost)
      figures.lost.push_back({disturbance.seed, disturbance.story, result.why});
  };
  figures.wall_s = spread(runs, threads, told, cancel, run, take);
  std::sort(figures.lost.begin(), figures.lost.end(),
            [](const LostRun& a, const LostRun& b) { return a.seed < b.seed; });
  return figures;
}

std::string table(const Figures& figures) {
  std::string text = fmt::format("{:<14} {:>7} {:>7} {:>7} {:>5} {:>8} {:>9} {:>8} {:>6} {:>9} {:>9}\n",
                                 "disturbance", "runs", "goal", "safe", "lost", "cost", "makespan", "replans",
                                 "most", "decision", "slowest");
  for (std::size_t i = 0; i < kClasses; ++i)
    row(to_string(static_cast<DisturbanceClass>(i)), figures.of[i], text);
  const ClassFigures all = figures.all();
  row("all", all, text);
  fmt::format_to(
      std::back_inserter(text),
      "cost, makespan (s): means where the goal was reached; decision, slowest: ms\n{:.1f} s, {:.1f} runs a "
      "second, {:.1f} ms a run and thread; {} of {} remaining actions kept\n"
      "{} plans mended, {} with a suffix of the old one: repair {:.1f} ms, new plan beside it {:.1f} ms\n",
      figures.wall_s, static_cast<double>(all.runs) / figures.wall_s, mean(figures.run_ms_sum, all.runs),
      all.kept, all.remaining, all.mended, all.repairs, mean(all.repair_ms_sum, all.mended),
      mean(all.replan_ms_sum, all.replannings));
  for (const LostRun& lost : figures.lost) {
    fmt::format_to(std::back_inserter(text), "LOST seed {} ({}): {}\n", lost.seed, lost.story, lost.why);
  }
  return text;
}

std::string to_json(const Figures& figures, std::uint64_t first, unsigned threads) {
  const ClassFigures all = figures.all();
  json lost = json::array();
  for (const LostRun& run : figures.lost)
    lost.push_back({{"seed", run.seed}, {"story", run.story}, {"why", run.why}});
  json classes = json::array();
  for (std::size_t i = 0; i < kClasses; ++i) {
    classes.push_back(figures_json(to_string(static_cast<DisturbanceClass>(i)), figures.of[i]));
  }
  json document = figures_json("all", all);
  document.update({{"first_seed", first},
                   {"threads", threads},
                   {"wall_s", figures.wall_s},
                   {"runs_per_s", static_cast<double>(all.runs) / figures.wall_s},
                   {"run_mean_ms", mean(figures.run_ms_sum, all.runs)},
                   {"classes", std::move(classes)},
                   {"lost_seeds", std::move(lost)}});
  return document.dump(2);
}

}  // namespace stepwright::campaign
