#pragma once

// Answer to a what-if, as JSON on plans (supervisor/doc/goals.md), for the missions that plan for one.
//
// Pure functions.

#include <cstddef>

#include "supervisor/run/internal/record_json.h"
#include "supervisor/run/run_record.h"

namespace stepwright::run::internal {

// Of a longer plan the answer has the first ones.
inline constexpr std::size_t kMostListedActions = 1'000;

struct WhatIfWorth {
  std::size_t steps = 0;
  double cost = 0.0, cost_ahead = 0.0;  // in all; from where the plan begins
  double makespan_s = 0.0;
};

json worth_json(const WhatIfWorth& worth);
// `cost_before`: of the episode's cost, what had run up before the plan begins.
json plan_json(const Episode& episode, double cost_before);

}  // namespace stepwright::run::internal
