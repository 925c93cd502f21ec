#pragma once

// Evaluation of routes: their earliest times in the network, and the objective. Pure functions; any thread.

#include <cstdint>
#include <optional>
#include <vector>

#include "supervisor/fleet/allocation/allocation_answer.h"
#include "supervisor/fleet/allocation/internal/trip_model.h"

namespace stepwright::fleet::internal {

struct Score {
  std::int64_t makespan_ms = 0;
  std::int64_t travel_ms = 0;
  std::int64_t tardiness_ms = 0;

  std::int64_t value(const AllocationObjective& objective) const {
    return objective.makespan * makespan_ms + objective.travel * travel_ms +
           objective.tardiness * tardiness_ms;
  }
};

struct Evaluation {
  Score score;
  std::vector<std::int32_t> begin_ms;  // by stop
  std::vector<std::int32_t> start_ms;  // by vehicle
  std::vector<std::int32_t> finish_ms;
  std::vector<std::int32_t> travel_ms;
};

// Weighted, each transport by its last trip; `begin_ms` by stop.
std::int64_t tardiness_ms(const TripModel& model, const std::vector<std::int32_t>& begin_ms);

// Nothing if a way is missing or the constraints cannot all hold. Requires every trip in one route of a
// vehicle that may take it, within its capacity, and a model without a contradiction.
std::optional<Evaluation> evaluate(const TripModel& model, const Routes& routes);

// Verdict and figures are the caller's.
AllocationAnswer answer_of(const TripModel& model, const Routes& routes, const Evaluation& evaluation);

}  // namespace stepwright::fleet::internal
