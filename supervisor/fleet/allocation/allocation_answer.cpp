#include "supervisor/fleet/allocation/allocation_answer.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "supervisor/fleet/network/constraint.h"

namespace stepwright::fleet {

namespace {

std::string seconds(std::chrono::milliseconds time) {
  std::string text = std::to_string(time.count() / 1000);
  const auto part = std::to_string(1000 + std::abs(time.count() % 1000)).substr(1);
  if (time.count() < 0 && time.count() > -1000) text = "-" + text;
  return part == "000" ? text + " s" : text + "." + part + " s";
}

std::string moment(const TransportTimepoint& t, const AllocationProblem& problem) {
  switch (t.moment) {
    case TransportMoment::TimeZero:
      return "time zero";
    case TransportMoment::VehicleStart:
      return "the start of vehicle '" + problem.vehicles[t.index].name + "'";
    case TransportMoment::TransportStart:
      return "the pick-up of '" + problem.transports[t.index].name + "'";
    case TransportMoment::TransportEnd:
      return "the set-down of '" + problem.transports[t.index].name + "'";
  }
  return {};
}

std::string constraint_text(const TransportConstraint& c, const AllocationProblem& problem) {
  const auto binds = [](std::chrono::milliseconds d) {
    return d.count() > -kHorizon_ms && d.count() < kHorizon_ms;
  };
  std::string text = "Constraint '" + c.name + "': " + moment(c.to, problem) + " comes";
  if (binds(c.distance.least)) text += " at least " + seconds(c.distance.least);
  if (binds(c.distance.least) && binds(c.distance.most)) text += " and";
  if (binds(c.distance.most)) text += " at most " + seconds(c.distance.most);
  return text + " after " + moment(c.from, problem) + ".\n";
}

std::string transport_text(const Transport& transport, const AllocationProblem& problem) {
  std::string text = "Transport '" + transport.name + "': " + std::to_string(transport.amount) + " from '" +
                     problem.locations[transport.from.value] + "' to '" +
                     problem.locations[transport.to.value] + "'.";
  std::uint32_t largest = 0;
  for (const TransportVehicle& vehicle : problem.vehicles) largest = std::max(largest, vehicle.capacity);
  if (!transport.divisible && transport.amount > largest) {
    text += " It may not be divided, and no vehicle carries more than " + std::to_string(largest) + ".";
  }
  return text + "\n";
}

}  // namespace

std::string to_string(const AllocationConflict& conflict, const AllocationProblem& problem) {
  std::string text;
  const auto name = [&](TransportId t) { return "'" + problem.transports[t.value].name + "'"; };
  for (const TransportId t : conflict.transports) {
    text += transport_text(problem.transports[t.value], problem);
  }
  for (const TransportId t : conflict.vehicles) {
    const VehicleId vehicle = *problem.transports[t.value].vehicle;
    text += "Fixed by hand: vehicle '" + problem.vehicles[vehicle.value].name + "' takes " + name(t) + ".\n";
  }
  for (const std::uint32_t o : conflict.orders) {
    text += "Fixed by hand: one vehicle takes " + name(problem.orders[o].before) + " before " +
            name(problem.orders[o].after) + ".\n";
  }
  for (const std::uint32_t r : conflict.routes) {
    const FixedRoute& route = problem.routes[r];
    text += std::string("Fixed by hand: ") + (route.whole ? "the route" : "the beginning of the route") +
            " of vehicle '" + problem.vehicles[route.vehicle.value].name + "'.\n";
  }
  for (const std::uint32_t c : conflict.constraints) {
    text += constraint_text(problem.constraints[c], problem);
  }
  if (text.empty()) text = "A vehicle cannot reach its finish.\n";
  return text;
}

}  // namespace stepwright::fleet
