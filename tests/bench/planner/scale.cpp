#include "tests/bench/planner/scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/bench/planner/suite.h"

namespace stepwright::bench {
namespace {

constexpr const char* kLargest = "the largest size";

int next_size(int size) {
  return std::max(size + 1, size * 7 / 5);
}

result::Result<Curve> run_curve(const Generator& generator, const Settings& settings,
                                const std::function<void(const std::string&, const ScalePoint&)>& done) {
  Curve curve;
  curve.domain = generator.name;
  const auto wrong = [](const Instance& instance, const std::string& why) {
    return result::fail("P0400", {instance.name(), 0, 0}, "a plan is wrong: " + why);
  };
  if (!settings.baseline) curve.baseline_ended = "not asked";
  for (int size = generator.sizes.front(); size <= generator.largest; size = next_size(size)) {
    if (!curve.ours_ended.empty() && !curve.baseline_ended.empty()) break;
    const Instance instance = make_instance(generator, size, settings.seed);
    auto task = task_of(instance);
    if (!task) return result::forward(task);
    ScalePoint point;
    point.size = size;
    const auto judge_end = [&](const Measurement& measured, std::string& ended) {
      if (!measured.solved()) ended = fmt::format("size {}: {}", size, measured.outcome);
    };
    point.ground = measure_grounding(instance, settings.limits);
    if (curve.ours_ended.empty()) {
      point.ours = measure_planner(instance, *task, settings.limits);
      if (!point.ours.wrong.empty()) return wrong(instance, point.ours.wrong);
      judge_end(point.ours, curve.ours_ended);
    }
    if (curve.baseline_ended.empty()) {
      point.baseline = measure_baseline(instance, *task, settings.limits);
      if (!point.baseline.wrong.empty()) return wrong(instance, point.baseline.wrong);
      judge_end(point.baseline, curve.baseline_ended);
    }
    done(generator.name, point);
    curve.points.push_back(std::move(point));
  }
  if (curve.ours_ended.empty()) curve.ours_ended = kLargest;
  if (curve.baseline_ended.empty()) curve.baseline_ended = kLargest;
  return curve;
}

nlohmann::json to_json(const Measurement& measured) {
  if (measured.outcome.empty() && !measured.solved()) return nullptr;
  nlohmann::json out = {{"outcome", measured.outcome},
                        {"wall_ms", measured.wall_ms},
                        {"cpu_ms", measured.cpu_ms},
                        {"peak_mb", measured.peak_mb},
                        {"expanded", measured.expanded}};
  if (measured.solved()) {
    out["first_plan_ms"] = measured.first().wall_ms;
    out["plan_cost"] = measured.first().cost;
    out["plan_steps"] = measured.first().steps;
  }
  return out;
}

}  // namespace

result::Result<std::vector<Curve>> run_scale(
    const Settings& settings, const std::function<void(const std::string&, const ScalePoint&)>& done) {
  const auto asked = instances_of(settings);  // says which names are wrong
  if (!asked) return tl::unexpected(asked.error());
  std::vector<Curve> curves;
  for (const Generator& generator : generators()) {
    const auto& names = settings.domains;
    if (!names.empty() && std::find(names.begin(), names.end(), generator.name) == names.end()) continue;
    auto curve = run_curve(generator, settings, done);
    if (!curve) return result::forward(curve);
    curves.push_back(std::move(*curve));
  }
  return curves;
}

nlohmann::json to_json(const std::vector<Curve>& curves) {
  nlohmann::json all = nlohmann::json::object();
  for (const Curve& curve : curves) {
    nlohmann::json points = nlohmann::json::array();
    for (const ScalePoint& point : curve.points) {
      nlohmann::json out = {
          {"size", point.size}, {"planner", to_json(point.ours)}, {"baseline", to_json(point.baseline)}};
      if (point.ground.operators > 0) {
        out["grounding_ms"] = point.ground.grounding_ms;
        out["operators"] = point.ground.operators;
        out["facts"] = point.ground.facts;
        out["variables"] = point.ground.variables;
      }
      points.push_back(std::move(out));
    }
    all[curve.domain] = {{"points", std::move(points)},
                         {"planner_ended", curve.ours_ended},
                         {"baseline_ended", curve.baseline_ended}};
  }
  return all;
}

}  // namespace stepwright::bench
