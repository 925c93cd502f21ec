#include "supervisor/fleet/allocation/internal/evaluation.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "supervisor/fleet/network/network.h"

namespace stepwright::fleet::internal {

namespace {

// Posts one route; what its vehicle drives, or nothing.
std::optional<std::int32_t> post_route(const TripModel& model, std::uint32_t vehicle, const Route& route,
                                       Network& network) {
  const Driver& driver = model.driver(vehicle);
  std::int64_t travel_ms = 0;
  Timepoint at = model.start_of(vehicle);
  std::uint32_t place = driver.start;
  std::int32_t stay_ms = 0;
  const auto drive = [&](std::uint32_t to, Timepoint arrival) {
    const std::int32_t way_ms = model.way_ms(vehicle, place, to);
    travel_ms += way_ms;
    if (way_ms >= kNoWay || travel_ms > kHorizon_ms) return false;
    if (static_cast<std::int64_t>(way_ms) + stay_ms > kHorizon_ms) return false;
    if (!network.post({at, arrival, way_ms + stay_ms, 0})) return false;
    at = arrival;
    place = to;
    return true;
  };
  for (const StopIndex stop : route) {
    if (!drive(model.place(stop), TripModel::at(stop))) return std::nullopt;
    stay_ms = model.service_ms(stop);
  }
  if (driver.finish != kNone) {
    if (!drive(driver.finish, model.finish_of(vehicle))) return std::nullopt;
  } else if (!network.post({at, model.finish_of(vehicle), stay_ms, 0})) {
    return std::nullopt;
  }
  return static_cast<std::int32_t>(travel_ms);
}

}  // namespace

std::int64_t tardiness_ms(const TripModel& model, const std::vector<std::int32_t>& begin_ms) {
  const std::vector<Transport>& transports = model.problem().transports;
  std::vector<std::int64_t> late(transports.size(), 0);
  for (std::uint32_t t = 0; t < model.trips(); ++t) {
    const StopIndex down = set_down_of(t);
    const std::uint32_t transport = model.trip(t).transport;
    if (!transports[transport].due) continue;
    const std::int64_t end_ms = static_cast<std::int64_t>(begin_ms[down]) + model.service_ms(down);
    late[transport] = std::max<std::int64_t>(late[transport], end_ms - transports[transport].due->count());
  }
  std::int64_t sum_ms = 0;
  for (std::size_t i = 0; i < late.size(); ++i) sum_ms += transports[i].weight * late[i];
  return sum_ms;
}

std::optional<Evaluation> evaluate(const TripModel& model, const Routes& routes) {
  Network network(model.timepoints());
  if (!network.post(model.constraints())) return std::nullopt;
  Evaluation out;
  for (std::uint32_t v = 0; v < model.vehicles(); ++v) {
    const auto travel_ms = post_route(model, v, routes[v], network);
    if (!travel_ms) return std::nullopt;
    out.travel_ms.push_back(*travel_ms);
    out.score.travel_ms += *travel_ms;
  }
  for (StopIndex stop = 0; stop < model.stops(); ++stop) {
    out.begin_ms.push_back(network.earliest_ms(TripModel::at(stop)));
  }
  for (std::uint32_t v = 0; v < model.vehicles(); ++v) {
    out.start_ms.push_back(network.earliest_ms(model.start_of(v)));
    out.finish_ms.push_back(network.earliest_ms(model.finish_of(v)));
    if (routes[v].empty() && model.driver(v).finish == kNone) continue;
    out.score.makespan_ms = std::max<std::int64_t>(out.score.makespan_ms, out.finish_ms.back());
  }
  out.score.tardiness_ms = tardiness_ms(model, out.begin_ms);
  return out;
}

AllocationAnswer answer_of(const TripModel& model, const Routes& routes, const Evaluation& evaluation) {
  using std::chrono::milliseconds;
  AllocationAnswer answer;
  for (std::uint32_t v = 0; v < model.vehicles(); ++v) {
    VehicleRoute route;
    route.start = milliseconds(evaluation.start_ms[v]);
    route.finish = milliseconds(evaluation.finish_ms[v]);
    route.travel = milliseconds(evaluation.travel_ms[v]);
    std::uint32_t aboard = 0;
    for (const StopIndex stop : routes[v]) {
      const Trip& trip = model.trip(trip_of(stop));
      const Transport& transport = model.transport_of(trip_of(stop));
      RouteStop made;
      made.action = is_pick_up(stop) ? LoadAction::PickUp : LoadAction::SetDown;
      made.transport = TransportId(trip.transport);
      made.location = is_pick_up(stop) ? transport.from : transport.to;
      made.amount = trip.amount;
      aboard = is_pick_up(stop) ? aboard + trip.amount : aboard - trip.amount;
      made.aboard = aboard;
      made.begin = milliseconds(evaluation.begin_ms[stop]);
      made.end = made.begin + milliseconds(model.service_ms(stop));
      route.stops.push_back(made);
    }
    answer.routes.push_back(std::move(route));
  }
  answer.makespan = milliseconds(evaluation.score.makespan_ms);
  answer.travel = milliseconds(evaluation.score.travel_ms);
  answer.tardiness = milliseconds(evaluation.score.tardiness_ms);
  answer.objective = evaluation.score.value(model.problem().objective);
  return answer;
}

}  // namespace stepwright::fleet::internal
