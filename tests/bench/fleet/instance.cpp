#include "tests/bench/fleet/instance.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "tests/support/fleet/split_mix.h"

namespace stepwright::bench::fleet {

namespace fleet = stepwright::fleet;
using geometry::ConvexPolygon;
using geometry::Point;
using geometry::Pose;
using std::chrono::milliseconds;

namespace {

ConvexPolygon box_at(const Pose& from, const Pose& to, const Vehicle& vehicle) {
  Pose along = from;
  if (!(from.position() == to.position())) {
    along.heading_rad = std::atan2(to.y_m - from.y_m, to.x_m - from.x_m);
  }
  const double reach_m = vehicle.length_m / 2 + vehicle.growth_m;
  return geometry::footprint_at(
      along, {.front_m = reach_m, .rear_m = reach_m, .half_width_m = vehicle.width_m / 2 + vehicle.growth_m});
}

struct Passage {
  ConvexPolygon area;
  std::size_t in = 0;  // first and last point of the path within it
  std::size_t out = 0;
};

std::vector<Passage> passages(std::span<const Pose> path, const Vehicle& vehicle) {
  std::vector<Passage> all;
  for (std::size_t at = 0;;) {
    const Pose& next = path[std::min(at + 1, path.size() - 1)];
    Passage passage{box_at(path[at], next, vehicle), at, at};
    const std::size_t earliest = all.empty() ? 0 : all.back().in;
    while (passage.in > earliest && passage.area.contains(path[passage.in - 1].position())) --passage.in;
    while (passage.out + 1 < path.size() && passage.area.contains(path[passage.out + 1].position()))
      ++passage.out;
    // The point before is within both, as close as it is.
    if (!all.empty()) all.back().out = std::max(all.back().out, passage.in);
    all.push_back(passage);
    if (passage.out + 1 >= path.size() && (at + 1 == path.size() || !vehicle.goal_polygon)) return all;
    at = std::min(passage.out + 1, path.size() - 1);
  }
}

fleet::Bounds bounds_of(double length_m, const Vehicle& vehicle) {
  const auto ms = [&](double speed) {
    const double time = speed > 0.0 ? 1000.0 * length_m / speed : 1e8;
    return milliseconds(std::llround(std::min(time, 1e8)));
  };
  return {ms(vehicle.v_max_mps), ms(vehicle.v_min_mps)};
}

void start_together(Instance& instance) {
  for (std::uint32_t v = 0; v < instance.envelopes.size(); ++v) {
    instance.constraints.push_back(
        {instance.envelopes[v].vehicle + " starts", {}, {{v, 0}, fleet::Side::Entry}, {}});
  }
}

// From the middle between two crossings to another one, straight on.
std::vector<Pose> stretch(Point from, Point to) {
  const double length_m = geometry::distance(from, to);
  const double heading_rad = std::atan2(to.y_m - from.y_m, to.x_m - from.x_m);
  const auto samples = static_cast<int>(std::lround(length_m / 0.2));
  std::vector<Pose> path;
  for (int k = 0; k <= samples; ++k) {
    const Point p = from + (static_cast<double>(k) / samples) * (to - from);
    path.push_back({p.x_m, p.y_m, heading_rad});
  }
  return path;
}

}  // namespace

std::size_t Instance::polygons() const {
  std::size_t sum = 0;
  for (const auto& envelope : envelopes) sum += envelope.polygons.size();
  return sum;
}

fleet::TrajectoryEnvelope envelope_along(const std::string& name, std::span<const Pose> path,
                                         const Vehicle& vehicle) {
  std::vector<double> length_m(path.size(), 0.0);
  for (std::size_t k = 1; k < path.size(); ++k) {
    length_m[k] = length_m[k - 1] + geometry::distance(path[k - 1].position(), path[k].position());
  }
  const auto all = passages(path, vehicle);
  fleet::TrajectoryEnvelope envelope{.vehicle = name, .polygons = {}};
  for (std::size_t k = 0; k < all.size(); ++k) {
    fleet::EnvelopePolygon polygon{.area = all[k].area,
                                   .stay = bounds_of(length_m[all[k].out] - length_m[all[k].in], vehicle),
                                   .overlap = {}};
    if (k + 1 < all.size()) {
      polygon.overlap = bounds_of(length_m[all[k].out] - length_m[all[k + 1].in], vehicle);
    }
    envelope.polygons.push_back(std::move(polygon));
  }
  return envelope;
}

CircleSource::CircleSource() : circle_(vehicle_, primitives_, table_, {}) {}

Instance CircleSource::instance(std::uint32_t vehicles, std::uint32_t run, double v_max_mps) {
  fleet::SpeedLimits speed;
  speed.max_mps = v_max_mps;
  Instance instance;
  for (const support::CircleTask& task :
       support::circle_problem(static_cast<int>(vehicles), static_cast<int>(run))) {
    fleet::GrownEnvelope grown = circle_.of(task);
    set_times(grown, speed);
    instance.envelopes.push_back(std::move(grown.envelope));
    instance.envelopes.back().vehicle = "v" + std::to_string(instance.envelopes.size());
  }
  start_together(instance);
  return instance;
}

Instance warehouse(std::uint32_t vehicles, std::uint32_t run, const Vehicle& vehicle) {
  support::SplitMix64 random(10000 * static_cast<std::uint64_t>(vehicles) + run);
  constexpr std::uint32_t kCells = 5;          // that a vehicle crosses
  constexpr std::uint32_t kSlot = kCells + 2;  // of an aisle, for two vehicles
  constexpr double kAisle_m = 10.0;
  const auto slots = static_cast<std::uint32_t>(std::ceil(std::sqrt(vehicles / (4.0 * kSlot))));
  const std::uint32_t aisles = slots * kSlot;
  Instance instance;
  const auto drive = [&](bool along_x, bool backwards, std::uint32_t aisle, std::uint32_t cell) {
    if (instance.envelopes.size() >= vehicles) return;
    const auto at = [&](std::uint32_t c) {
      const double along_m = kAisle_m * (backwards ? aisles - 0.5 - c : c + 0.5);
      const double across_m = kAisle_m * aisle;
      return along_x ? Point{along_m, across_m} : Point{across_m, along_m};
    };
    const std::string name = "v" + std::to_string(instance.envelopes.size());
    instance.envelopes.push_back(envelope_along(name, stretch(at(cell), at(cell + kCells)), vehicle));
  };
  // Square by square, so that few vehicles meet as much as many do.
  for (std::uint32_t square = 0; square < slots * slots; ++square) {
    for (std::uint32_t k = 0; k < kSlot; ++k) {
      for (const bool along_x : {true, false}) {
        const std::uint32_t aisle = (along_x ? square / slots : square % slots) * kSlot + k;
        const std::uint32_t slot = along_x ? square % slots : square / slots;
        const bool backwards = random.below(2) == 1;
        const std::uint32_t cell = (backwards ? slots - 1 - slot : slot) * kSlot;
        drive(along_x, backwards, aisle, cell + 1);
        drive(along_x, backwards, aisle, cell);
      }
    }
  }
  start_together(instance);
  return instance;
}

}  // namespace stepwright::bench::fleet
