#include "tests/bench/planner/report/table.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tests/bench/planner/report/domain_figures.h"

namespace stepwright::bench {
namespace {

using nlohmann::json;

std::string number(const std::optional<double>& value, const char* form) {
  return value ? fmt::format(fmt::runtime(form), *value) : "-";
}

json or_null(const std::optional<double>& value) {
  return value ? json(*value) : json(nullptr);
}

std::string time_and_cost(const Measurement& measured) {
  if (measured.outcome.empty() && !measured.solved()) return fmt::format("{:>21}", "");
  if (!measured.solved()) return fmt::format("{:>21.21}", measured.outcome);
  return fmt::format("{:>10.1f} {:>10.8g}", measured.first().wall_ms, measured.last().cost);
}

json to_json(const Measurement& measured) {
  json profile = json::array();
  for (const Found& found : measured.profile) {
    profile.push_back({{"wall_ms", found.wall_ms},
                       {"cpu_ms", found.cpu_ms},
                       {"plan_cost", found.cost},
                       {"plan_steps", found.steps}});
  }
  json out = {{"outcome", measured.outcome},          {"solved", measured.solved()},
              {"cost_over_time", std::move(profile)}, {"bound", or_null(measured.bound)},
              {"proved_optimal", measured.proved},    {"expanded", measured.expanded},
              {"wall_ms", measured.wall_ms},          {"cpu_ms", measured.cpu_ms},
              {"peak_mb", measured.peak_mb}};
  if (!measured.solved()) return out;
  out["first_plan_ms"] = measured.first().wall_ms;
  out["first_plan_cpu_ms"] = measured.first().cpu_ms;
  out["first_plan_cost"] = measured.first().cost;
  out["plan_cost"] = measured.last().cost;
  out["plan_steps"] = measured.last().steps;
  return out;
}

json to_json(const Settings& settings, const Row& row) {
  json out = to_json(row.ours);
  out["instance"] = row.instance.name();
  out["domain"] = row.instance.generator;
  out["size"] = row.instance.size;
  out["seed"] = row.instance.seed;
  out["digest"] = row.instance.digest();
  out["best_known_cost"] = row.best.cost;
  out["best_known_bound"] = row.best.bound;
  out["best_known_found_by"] = row.best.found_by;
  if (row.ground.operators > 0) {
    out["grounding_ms"] = row.ground.grounding_ms;
    out["operators"] = row.ground.operators;
    out["facts"] = row.ground.facts;
    out["variables"] = row.ground.variables;
  }
  if (settings.baseline) out["baseline"] = to_json(row.baseline);
  for (std::size_t i = 0; i < settings.outside.size(); ++i) {
    if (!row.outside[i].outcome.empty()) out[settings.outside[i].name] = to_json(row.outside[i]);
  }
  if (row.ours.solved()) out["cost_ratio_to_best_known"] = row.ratio(row.ours.last().cost);
  return out;
}

json to_json(const DomainFigures& figures) {
  json out = {{"solved", figures.solved},
              {"instances", figures.instances},
              {"proved_optimal", figures.proved},
              {"first_plan_ms_median", or_null(figures.first_plan_ms_median)},
              {"first_plan_cost_ratio_to_best_known", or_null(figures.first_cost_ratio)},
              {"cost_ratio_to_best_known", or_null(figures.cost_ratio_to_best_known)},
              {"grounding_ms_median", or_null(figures.grounding_ms_median)}};
  out["quality_over_time"] = json::array();
  for (const Quality& quality : figures.quality_over_time) {
    out["quality_over_time"].push_back({{"time_s", quality.time_s},
                                        {"solved", quality.solved},
                                        {"cost_ratio_to_best_known", or_null(quality.cost_ratio)}});
  }
  for (const Rival& rival : figures.rivals) {
    out[rival.name] = {{"solved", rival.solved},
                       {"instances", rival.instances},
                       {"solved_and_ours_not", rival.lost},
                       {"first_plan_ms_median", or_null(rival.first_plan_ms_median)},
                       {"time_ratio_to_ours_median", or_null(rival.time_ratio_median)},
                       {"cpu_ratio_to_ours_median", or_null(rival.cpu_ratio_median)},
                       {"cost_ratio_to_best_known", or_null(rival.cost_ratio_to_best_known)}};
  }
  return out;
}

}  // namespace

std::string heading(const Settings& settings) {
  std::string text =
      fmt::format("{:<20} {:>8} {:>9} {:>9} {:>9} {:>10} {:>10} {:>6} {:>9} {:>7}", "instance", "operators",
                  "ground ms", "first ms", "1st cost", "cost", "best known", "ratio", "expanded", "MB");
  if (settings.baseline) text += fmt::format("  {:>21}", "baseline ms and cost");
  for (const Outside& planner : settings.outside) text += fmt::format("  {:>21}", planner.name);
  return text + "\n";
}

std::string line(const Settings& settings, const Row& row) {
  const Measurement& ours = row.ours;
  std::string text = fmt::format("{:<20} {:>8} {:>9.2f} ", row.instance.name(), row.ground.operators,
                                 row.ground.grounding_ms);
  if (ours.solved()) {
    text += fmt::format("{:>9.2f} {:>9.8g} {:>9.8g}{} {:>9.8g}{} {:>6.3f}", ours.first().wall_ms,
                        ours.first().cost, ours.last().cost, ours.proved ? "*" : " ", row.best.cost,
                        row.best.proved() ? "*" : " ", row.ratio(ours.last().cost));
  } else {
    text += fmt::format("{:>30.30} {:>9.8g}{} {:>6}", ours.outcome, row.best.cost,
                        row.best.proved() ? "*" : " ", "-");
  }
  text += fmt::format(" {:>9} {:>7.1f}", ours.expanded, ours.peak_mb);
  if (settings.baseline) text += "  " + time_and_cost(row.baseline);
  for (const Measurement& outside : row.outside) text += "  " + time_and_cost(outside);
  return text + "\n";
}

std::string summary(const Settings& settings, const std::vector<Row>& rows) {
  const std::vector<DomainFigures> all = figures(settings, rows);
  std::string text = fmt::format("\n{:<16} {:>9} {:>7} {:>10} {:>10} {:>9}", "domain", "solved", "optimal",
                                 "ground ms", "first ms", "1st ratio");
  for (const Quality& quality : all.front().quality_over_time) {
    text += fmt::format(" {:>8}", fmt::format("{:g} s", quality.time_s));
  }
  text += fmt::format(" {:>8}", "ratio");
  if (settings.baseline) text += "  | baseline: solved, ms, ratios of time, CPU time, cost";
  for (const Outside& planner : settings.outside) text += "  | " + planner.name + ": the same";
  text += "\n";
  for (const DomainFigures& f : all) {
    text += fmt::format("{:<16} {:>9} {:>7} {:>10} {:>10} {:>9}", f.name,
                        fmt::format("{} of {}", f.solved, f.instances), f.proved,
                        number(f.grounding_ms_median, "{:.2f}"), number(f.first_plan_ms_median, "{:.2f}"),
                        number(f.first_cost_ratio, "{:.3f}"));
    for (const Quality& q : f.quality_over_time)
      text += fmt::format(" {:>8}", number(q.cost_ratio, "{:.3f}"));
    text += fmt::format(" {:>8}", number(f.cost_ratio_to_best_known, "{:.3f}"));
    for (const Rival& r : f.rivals) {
      text +=
          fmt::format("  | {:>9} {:>9} {:>8} {:>8} {:>7}", fmt::format("{} of {}", r.solved, r.instances),
                      number(r.first_plan_ms_median, "{:.1f}"), number(r.time_ratio_median, "{:.1f}x"),
                      number(r.cpu_ratio_median, "{:.1f}x"), number(r.cost_ratio_to_best_known, "{:.3f}"));
    }
    text += "\n";
  }
  return text +
         "ms are medians of the solved, from the texts to the first plan; ratios are costs over the best "
         "known "
         "(of what\nis solved by then), time ratios how many times longer than ours; * = proved optimal\n";
}

json to_json(const Settings& settings, const std::vector<Row>& rows) {
  json out = {{"time_limit_s", static_cast<double>(settings.limits.time.count()) / 1000.0},
              {"memory_limit_mb", settings.limits.memory_mb},
              {"domains", json::object()},
              {"instances", json::array()}};
  for (const DomainFigures& each : figures(settings, rows)) {
    if (each.name == "all") {
      out["all"] = to_json(each);
    } else {
      out["domains"][each.name] = to_json(each);
    }
  }
  for (const Row& row : rows) out["instances"].push_back(to_json(settings, row));
  return out;
}

}  // namespace stepwright::bench
