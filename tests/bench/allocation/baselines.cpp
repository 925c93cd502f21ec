#include "tests/bench/allocation/baselines.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "supervisor/fleet/allocation/internal/evaluation.h"
#include "supervisor/fleet/allocation/internal/route_plan.h"
#include "supervisor/fleet/allocation/internal/trip_model.h"

namespace stepwright::bench::allocation {

namespace {

namespace internal = fleet::internal;

internal::TripModel model_of(const fleet::AllocationProblem& problem) {
  const internal::Selection all(problem);
  return make_model(problem, all, joint_divisions(problem, all, 0).all.front(), internal::Ways::AsGiven);
}

std::optional<fleet::AllocationAnswer> answer(const internal::TripModel& model,
                                              const internal::Routes& routes) {
  const auto evaluation = evaluate(model, routes);
  if (!evaluation) return std::nullopt;
  return answer_of(model, routes, *evaluation);
}

}  // namespace

std::optional<fleet::AllocationAnswer> nearest_vehicle(const fleet::AllocationProblem& problem) {
  const internal::TripModel model = model_of(problem);
  if (model.contradiction()) return std::nullopt;
  internal::Routes routes(model.vehicles());
  std::vector<std::int64_t> free_ms;
  std::vector<std::uint32_t> place;
  for (std::uint32_t v = 0; v < model.vehicles(); ++v) {
    free_ms.push_back(model.start_ms(v));
    place.push_back(model.driver(v).start);
  }
  std::vector<std::uint32_t> left;
  for (std::uint32_t t = 0; t < model.trips(); ++t) left.push_back(t);
  while (!left.empty()) {
    const auto v = static_cast<std::uint32_t>(std::ranges::min_element(free_ms) - free_ms.begin());
    std::int32_t nearest_ms = internal::kNoWay;
    std::uint32_t taken = internal::kNone;
    for (const std::uint32_t t : left) {
      const std::int32_t way_ms = model.way_ms(v, place[v], model.place(internal::pick_up_of(t)));
      if (model.trip(t).vehicles[v] == 0 || way_ms >= nearest_ms) continue;
      nearest_ms = way_ms;
      taken = t;
    }
    if (taken == internal::kNone) return std::nullopt;
    for (const internal::StopIndex stop : {internal::pick_up_of(taken), internal::set_down_of(taken)}) {
      free_ms[v] = std::max<std::int64_t>(free_ms[v] + model.way_ms(v, place[v], model.place(stop)),
                                          model.earliest_ms(stop)) +
                   model.service_ms(stop);
      place[v] = model.place(stop);
      routes[v].push_back(stop);
    }
    std::erase(left, taken);
  }
  return answer(model, routes);
}

std::optional<fleet::AllocationAnswer> plain_insertion(const fleet::AllocationProblem& problem) {
  const internal::TripModel model = model_of(problem);
  if (model.contradiction()) return std::nullopt;
  internal::RoutePlan plan(model);
  for (const std::uint32_t trip : std::vector<std::uint32_t>(plan.missing())) {
    const auto all = plan.insertions(trip);
    if (all.empty()) return std::nullopt;
    const internal::Insertion best = *std::ranges::min_element(all, {}, &internal::Insertion::cost);
    plan.insert(trip, best);
  }
  return answer(model, plan.routes());
}

}  // namespace stepwright::bench::allocation
