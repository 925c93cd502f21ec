#pragma once

// Scaling curves: each domain at growing sizes until a limit ends it, our planner and the baseline beside it.
//
// Thread rule: one thread.

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "tests/bench/planner/settings.h"

namespace stepwright::bench {

struct ScalePoint {
  int size = 0;
  GroundSize ground;
  Measurement ours;  // an empty outcome: this planner's curve had ended before
  Measurement baseline;
};

struct Curve {
  std::string domain;
  std::vector<ScalePoint> points;
  std::string ours_ended, baseline_ended;  // "size 12: out of time"; "the largest size"
};

// `done` sees every point when it is ready. Fails at the first wrong plan.
[[nodiscard]] result::Result<std::vector<Curve>> run_scale(
    const Settings& settings, const std::function<void(const std::string& domain, const ScalePoint&)>& done);

nlohmann::json to_json(const std::vector<Curve>& curves);

}  // namespace stepwright::bench
