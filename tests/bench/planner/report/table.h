#pragma once

// The results as a person reads them, and as JSON.
//
// Thread rule: pure functions.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tests/bench/planner/suite.h"

namespace stepwright::bench {

// One line per instance, and the line above them all.
std::string heading(const Settings& settings);
std::string line(const Settings& settings, const Row& row);

// One line per domain: coverage, times, quality, beside the baseline and what was found outside.
std::string summary(const Settings& settings, const std::vector<Row>& rows);

// `domains` (by name: solved, instances, first_plan_ms_median, cost_ratio_to_best_known, ...) and
// `instances`.
nlohmann::json to_json(const Settings& settings, const std::vector<Row>& rows);

}  // namespace stepwright::bench
