#include "tests/support/fleet/drawn_transports.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/fleet/split_mix.h"

namespace stepwright::support {

namespace {

using std::chrono::milliseconds;

struct Spot {
  double x_m = 0.0;
  double y_m = 0.0;
};

// Aisles run along x, with cross aisles at both ends: to another aisle by way of the nearer end.
milliseconds way(const Spot& a, const Spot& b) {
  constexpr double kLength_m = 80.0, kSpeed_mps = 1.5, kTurns_s = 6.0;
  double distance_m = std::abs(a.x_m - b.x_m);
  double seconds = 0.0;
  if (a.y_m != b.y_m) {
    distance_m = std::abs(a.y_m - b.y_m) + std::min(a.x_m + b.x_m, 2.0 * kLength_m - a.x_m - b.x_m);
    seconds = kTurns_s;
  }
  return milliseconds(std::llround(1000.0 * (seconds + distance_m / kSpeed_mps)));
}

}  // namespace

std::string name_of(TransportKind kind) {
  switch (kind) {
    case TransportKind::Single:
      return "single";
    case TransportKind::Shared:
      return "shared";
    case TransportKind::Due:
      return "due";
    case TransportKind::Coupled:
      return "coupled";
  }
  return {};
}

fleet::AllocationProblem draw_transports(TransportKind kind, std::uint32_t transports, std::uint32_t vehicles,
                                         std::uint64_t seed) {
  SplitMix64 random(seed);
  fleet::AllocationProblem problem;
  std::vector<Spot> points;
  const auto location = [&] {
    points.push_back({random.between(0.0, 80.0), 5.0 * static_cast<double>(random.below(12))});
    problem.locations.push_back("l" + std::to_string(points.size()));
    return fleet::LocationId(static_cast<std::uint32_t>(points.size() - 1));
  };
  for (std::uint32_t v = 0; v < vehicles; ++v) {
    problem.vehicles.push_back({.name = "v" + std::to_string(v),
                                .start = location(),
                                .capacity = kind == TransportKind::Shared ? 3U : 1U});
  }
  for (std::uint32_t t = 0; t < transports; ++t) {
    fleet::Transport transport;
    transport.name = "t" + std::to_string(t);
    if (kind == TransportKind::Shared) {
      transport.amount = t % 20 == 19 ? 7 : static_cast<std::uint32_t>(1 + random.below(3));
    }
    transport.from = location();
    transport.to = location();
    transport.pick_up_service = milliseconds(15'000);
    transport.set_down_service = milliseconds(15'000);
    // A vehicle makes a trip in about 100 s: late ones are due when most are done.
    const double span_s = 110.0 * transports / vehicles;
    if (kind == TransportKind::Due)
      transport.due = milliseconds(std::llround(1000.0 * random.between(60.0, span_s)));
    problem.transports.push_back(transport);
    const fleet::TransportId id(t);
    if (kind == TransportKind::Coupled && t % 4 == 3) {
      const fleet::TransportId before(static_cast<std::uint32_t>(random.below(t)));
      problem.constraints.push_back({"after " + std::to_string(t),
                                     fleet::end_of(before),
                                     fleet::start_of(id),
                                     {milliseconds(0), milliseconds(600'000)}});
    }
    if (kind == TransportKind::Coupled && t % 5 == 4) {
      problem.constraints.push_back(
          {"deadline " + std::to_string(t),
           {},
           fleet::end_of(id),
           {milliseconds(0), milliseconds(std::llround(1000.0 * span_s) + 120'000)}});
    }
  }
  if (kind == TransportKind::Due) problem.objective = {.makespan = 0, .travel = 1, .tardiness = 1000};
  fleet::TravelTimes times(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    for (std::uint32_t j = 0; j < points.size(); ++j) {
      times.set(fleet::LocationId(i), fleet::LocationId(j), way(points[i], points[j]));
    }
  }
  problem.classes.push_back(std::move(times));
  return problem;
}

}  // namespace stepwright::support
