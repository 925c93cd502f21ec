#include "tests/bench/fleet/instance.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace stepwright::bench::fleet {

namespace fleet = stepwright::fleet;
using geometry::ConvexPolygon;
using geometry::Point;
using geometry::Pose;
using std::chrono::milliseconds;

namespace {

constexpr std::uint32_t kPoints = 10;
constexpr std::uint32_t kHeadings = 8;
constexpr double kRadius_m = 20.0;

// Steele, Lea and Flood 2014.
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15U;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31);
  }
  std::uint32_t below(std::uint32_t bound) { return static_cast<std::uint32_t>(next() % bound); }

 private:
  std::uint64_t state_;
};

// The first `count` of all points in a random order.
std::vector<std::uint32_t> draw(std::uint32_t count, std::uint32_t of, SplitMix64& random) {
  std::vector<std::uint32_t> points(of);
  std::iota(points.begin(), points.end(), 0U);
  for (std::uint32_t k = 0; k < count; ++k) std::swap(points[k], points[k + random.below(of - k)]);
  points.resize(count);
  return points;
}

Pose pose_at(std::uint32_t point, std::uint32_t heading, Point middle) {
  const double angle = 2.0 * std::numbers::pi * point / kPoints;
  return {middle.x_m + kRadius_m * std::cos(angle), middle.y_m + kRadius_m * std::sin(angle),
          2.0 * std::numbers::pi * heading / kHeadings};
}

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

struct Trip {
  std::uint32_t from, to, heading_from, heading_to;
};

std::vector<Trip> trips(std::uint32_t vehicles, SplitMix64& random) {
  const auto starts = draw(vehicles, kPoints, random);
  auto goals = draw(vehicles, kPoints, random);
  while (!std::ranges::equal(starts, goals, std::ranges::not_equal_to{}))
    goals = draw(vehicles, kPoints, random);
  std::vector<Trip> all;
  for (std::uint32_t v = 0; v < vehicles; ++v) {
    const std::uint32_t heading_from = random.below(kHeadings);
    all.push_back({starts[v], goals[v], heading_from, random.below(kHeadings)});
  }
  return all;
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

std::vector<Pose> curve(const Pose& from, const Pose& to) {
  const double span_m = geometry::distance(from.position(), to.position());
  const auto tangent = [&](const Pose& pose) {
    return span_m * Point{std::cos(pose.heading_rad), std::sin(pose.heading_rad)};
  };
  const auto at = [&](double t) {
    const double s = 1.0 - t;
    return (s * s * (1.0 + 2.0 * t)) * from.position() + (t * s * s) * tangent(from) +
           (t * t * (1.0 + 2.0 * s)) * to.position() + (-t * t * s) * tangent(to);
  };
  std::vector<Pose> path = {from};
  constexpr double kSample_m = 0.2;
  constexpr int kSteps = 4000;
  for (int k = 1; k <= kSteps; ++k) {
    const Point p = at(static_cast<double>(k) / kSteps);
    const Point before = path.back().position();
    if (k < kSteps && geometry::distance(before, p) < kSample_m) continue;
    path.push_back({p.x_m, p.y_m, std::atan2(p.y_m - before.y_m, p.x_m - before.x_m)});
  }
  return path;
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

Instance circle(std::uint32_t vehicles, std::uint32_t run, const Vehicle& vehicle, const Route& route) {
  SplitMix64 random(10000 * static_cast<std::uint64_t>(vehicles) + run);
  const Point middle{25.0, 25.0};
  Instance instance;
  for (const Trip& trip : trips(vehicles, random)) {
    const auto path =
        route(pose_at(trip.from, trip.heading_from, middle), pose_at(trip.to, trip.heading_to, middle));
    instance.envelopes.push_back(
        envelope_along("v" + std::to_string(instance.envelopes.size()), path, vehicle));
  }
  start_together(instance);
  return instance;
}

Instance warehouse(std::uint32_t vehicles, std::uint32_t run, const Vehicle& vehicle) {
  SplitMix64 random(10000 * static_cast<std::uint64_t>(vehicles) + run);
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
