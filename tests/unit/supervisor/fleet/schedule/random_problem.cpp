#include "tests/unit/supervisor/fleet/schedule/random_problem.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <utility>

namespace stepwright::fleet {

using std::chrono::milliseconds;

namespace {

int upto(int most, std::mt19937& random) {
  return std::uniform_int_distribution<int>(0, most)(random);
}

Bounds random_stay(std::mt19937& random) {
  const int least = upto(4, random);
  const int slack = upto(3, random) == 0 ? 1000 : upto(6, random);
  return {milliseconds(least), milliseconds(least + slack)};
}

TrajectoryEnvelope random_envelope(std::uint32_t vehicle, std::uint32_t size, std::mt19937& random) {
  TrajectoryEnvelope envelope{.vehicle = "v" + std::to_string(vehicle), .polygons = {}};
  double x = upto(3, random), y = upto(2, random);
  const auto polygons = static_cast<std::uint32_t>(1 + random() % size);
  for (std::uint32_t k = 0; k < polygons; ++k) {
    EnvelopePolygon polygon{
        .area = rectangle(x, y, x + 1.2, y + 1.2), .stay = random_stay(random), .overlap = {}};
    polygon.overlap.least = milliseconds(upto(1, random));
    polygon.overlap.most = polygon.overlap.least + milliseconds(upto(5, random));
    if (upto(5, random) == 0) polygon.left_into = 2;
    envelope.polygons.push_back(std::move(polygon));
    // Straight on most of the time.
    (upto(2, random) == 0 ? y : x) += upto(3, random) == 0 ? -1.0 : 1.0;
  }
  return envelope;
}

TimepointRef random_timepoint(const Problem& problem, std::mt19937& random) {
  const auto vehicle = static_cast<std::uint32_t>(random() % problem.envelopes.size());
  const auto polygons = static_cast<std::uint32_t>(problem.envelopes[vehicle].polygons.size());
  return {{vehicle, static_cast<std::uint32_t>(random() % polygons)},
          random() % 2 ? Side::Entry : Side::Exit};
}

}  // namespace

geometry::ConvexPolygon rectangle(double x0_m, double y0_m, double x1_m, double y1_m) {
  const std::array<geometry::Point, 4> corners = {
      geometry::Point{x0_m, y0_m}, {x1_m, y0_m}, {x1_m, y1_m}, {x0_m, y1_m}};
  return geometry::ConvexPolygon::hull(corners).value();
}

TrajectoryEnvelope lane(const std::string& name, int from, int to, double y_m, milliseconds most) {
  TrajectoryEnvelope envelope{.vehicle = name, .polygons = {}};
  for (int x = from; x != to; x += from < to ? 1 : -1) {
    envelope.polygons.push_back({.area = rectangle(x, y_m, x + 1.1, y_m + 1.0),
                                 .stay = {milliseconds(1000), most},
                                 .overlap = {milliseconds(200), most}});
  }
  return envelope;
}

Problem random_problem(std::uint32_t vehicles, std::uint32_t size, std::mt19937& random) {
  Problem problem;
  for (std::uint32_t v = 0; v < vehicles; ++v) problem.envelopes.push_back(random_envelope(v, size, random));
  if (upto(1, random) == 0) {
    for (std::uint32_t v = 0; v < vehicles; ++v) {
      problem.constraints.push_back({"start " + std::to_string(v), {}, {{v, 0}, Side::Entry}, {}});
    }
  }
  for (int extra = upto(2, random); extra > 0; --extra) {
    TemporalConstraint constraint{
        .name = "extra " + std::to_string(extra), .from = {}, .to = {}, .distance = {}};
    if (upto(1, random) == 0) constraint.from = random_timepoint(problem, random);
    constraint.to = random_timepoint(problem, random);
    constraint.distance.least = milliseconds(upto(12, random) - 8);
    constraint.distance.most = constraint.distance.least + milliseconds(upto(12, random));
    problem.constraints.push_back(constraint);
  }
  return problem;
}

}  // namespace stepwright::fleet
