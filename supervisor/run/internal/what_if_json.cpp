#include "supervisor/run/internal/what_if_json.h"

#include <algorithm>
#include <utility>

namespace stepwright::run::internal {

json worth_json(const WhatIfWorth& worth) {
  return {{"steps", worth.steps},
          {"cost", worth.cost},
          {"cost_ahead", worth.cost_ahead},
          {"makespan_s", worth.makespan_s}};
}

json plan_json(const Episode& episode, double cost_before) {
  json actions = json::array();
  const std::size_t listed = std::min(episode.actions.size(), kMostListedActions);
  for (std::size_t i = 0; i < listed; ++i) {
    const ActionRecord& action = episode.actions[i];
    actions.push_back({{"index", i},
                       {"text", action.text},
                       {"planned_start_s", action.planned_start_s},
                       {"planned_finish_s", action.planned_finish_s},
                       {"planned_cost", action.planned_cost}});
  }
  json plan = worth_json({.steps = episode.actions.size(),
                          .cost = episode.cost,
                          .cost_ahead = episode.cost - cost_before,
                          .makespan_s = episode.planned_makespan_s});
  plan["bound"] = episode.bound ? json(*episode.bound) : json(nullptr);
  plan["proved_optimal"] = episode.proved_optimal;
  plan["first_plan_ms"] = episode.first_plan_ms;
  plan["sequential_makespan_s"] = episode.planned_sequential_makespan_s;
  plan["actions"] = std::move(actions);
  return plan;
}

}  // namespace stepwright::run::internal
