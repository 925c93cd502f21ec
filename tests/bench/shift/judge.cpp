#include "tests/bench/shift/judge.h"

#include <algorithm>
#include <cmath>

namespace stepwright::bench::shift {

namespace {

constexpr double kMoved_m = 1e-4;
constexpr double kTouch_m = 1e-6;
constexpr double kStill_m = 0.05;

double largest_separation_m(geometry::Point between, geometry::Point a_along, double a_length, double a_width,
                            geometry::Point b_along, double b_length, double b_width) {
  const auto half = [](geometry::Point axis, geometry::Point along, double length, double width) {
    return length * std::abs(dot(axis, along)) + width * std::abs(cross(axis, along));
  };
  double largest = -1e9;
  for (const geometry::Point axis : {a_along, geometry::Point{-a_along.y_m, a_along.x_m}, b_along,
                                     geometry::Point{-b_along.y_m, b_along.x_m}}) {
    largest = std::max(largest, std::abs(dot(axis, between)) - half(axis, a_along, a_length, a_width) -
                                    half(axis, b_along, b_length, b_width));
  }
  return largest;
}

}  // namespace

Judge::Judge(const Scenario& scenario, const geometry::Footprint& outline)
    : scenario_(scenario), outline_(outline), blocked_(scenario.places.size(), 0) {
  const std::size_t n = scenario.settings.vehicles;
  for (const Rectangle& place : scenario.places) {
    places_.push_back({0.5 * (place.low + place.high),
                       {1.0, 0.0},
                       0.5 * (place.high.x_m - place.low.x_m),
                       0.5 * (place.high.y_m - place.low.y_m)});
  }
  boxes_.resize(n);
  last_.assign(n, {-1e9, 0.0, 0.0});
  touching_.assign(n, std::vector<char>(n + 1 + places_.size(), 0));
  still_since_s_.assign(n, 0.0);
  still_at_.assign(n, {-1e9, 0.0, 0.0});
  nameless_since_s_.assign(n, 0.0);
  idle_since_s_.assign(n, 0.0);
  reported_.assign(n, 0);
}

Judge::Box Judge::box_of(const geometry::Pose& pose) const {
  const geometry::Point along{std::cos(pose.heading_rad), std::sin(pose.heading_rad)};
  const double ahead_m = 0.5 * (outline_.front_m - outline_.rear_m);
  return {pose.position() + ahead_m * along, along, 0.5 * (outline_.front_m + outline_.rear_m),
          outline_.half_width_m};
}

bool Judge::apart(const Box& a, const Box& b) {
  return gap_m(a, b) > -kTouch_m;
}

double Judge::gap_m(const Box& a, const Box& b) {
  return largest_separation_m(b.middle - a.middle, a.along, a.half_length_m, a.half_width_m, b.along,
                              b.half_length_m, b.half_width_m);
}

bool Judge::hits_wall(const Box& box) const {
  const fleet::OccupancyGrid& grid = scenario_.hall.grid;
  const double half = 0.5 * grid.frame().resolution_m;
  const double reach_x =
      box.half_length_m * std::abs(box.along.x_m) + box.half_width_m * std::abs(box.along.y_m);
  const double reach_y =
      box.half_length_m * std::abs(box.along.y_m) + box.half_width_m * std::abs(box.along.x_m);
  const fleet::Cell low = grid.frame().cell_at(box.middle - geometry::Point{reach_x, reach_y});
  const fleet::Cell high = grid.frame().cell_at(box.middle + geometry::Point{reach_x, reach_y});
  for (int row = low.row; row <= high.row; ++row) {
    for (int column = low.column; column <= high.column; ++column) {
      if (!grid.blocked({column, row})) continue;
      const Box cell{
          grid.frame().corner({column, row}) + geometry::Point{half, half}, {1.0, 0.0}, half, half};
      if (!apart(box, cell)) return true;
    }
  }
  return false;
}

void Judge::report(double now_s, std::uint32_t vehicle, std::uint32_t other, std::string with,
                   bool touching) {
  char& before = touching_[vehicle][other];
  if (touching && before == 0) collisions_.push_back({now_s, vehicle, std::move(with)});
  before = touching ? 1 : 0;
}

void Judge::step(double now_s, std::span<const geometry::Pose> poses) {
  const auto n = static_cast<std::uint32_t>(poses.size());
  std::vector<char> moved(n, 0);
  for (std::uint32_t v = 0; v < n; ++v) {
    const geometry::Pose& a = poses[v];
    const geometry::Pose& b = last_[v];
    moved[v] = std::abs(a.x_m - b.x_m) + std::abs(a.y_m - b.y_m) + std::abs(a.heading_rad - b.heading_rad) >
               kMoved_m;
    if (moved[v] == 0) continue;
    last_[v] = a;
    boxes_[v] = box_of(a);
  }
  const double reach_m = 2.0 * std::hypot(boxes_[0].half_length_m, boxes_[0].half_width_m);
  for (std::uint32_t v = 0; v < n; ++v) {
    if (moved[v] == 0) continue;
    ++checks_;
    report(now_s, v, n, "wall", hits_wall(boxes_[v]));
    for (std::uint32_t k = 0; k < places_.size(); ++k)
      report(now_s, v, n + 1 + k, "blocked place", blocked_[k] != 0 && !apart(boxes_[v], places_[k]));
    for (std::uint32_t u = 0; u < n; ++u) {
      if (u == v || (moved[u] != 0 && u < v)) continue;
      if (geometry::distance(boxes_[u].middle, boxes_[v].middle) > reach_m) continue;
      const double gap = gap_m(boxes_[u], boxes_[v]);
      smallest_gap_m_ = std::min(smallest_gap_m_, gap);
      report(now_s, std::min(u, v), std::max(u, v), "vehicle " + std::to_string(std::max(u, v) + 1),
             gap < -kTouch_m);
    }
  }
}

void Judge::standing(double now_s, std::span<const geometry::Pose> poses,
                     std::span<const VehicleState> states) {
  const auto n = static_cast<std::uint32_t>(states.size());
  for (std::uint32_t v = 0; v < n; ++v) {
    const Doing doing = states[v].doing;
    const bool still = geometry::distance(poses[v].position(), still_at_[v].position()) < kStill_m;
    if (!still || (doing != Doing::Waits && doing != Doing::Drives)) {
      still_since_s_[v] = now_s;
      still_at_[v] = poses[v];
      reported_[v] = 0;
    }
    if (!still || doing != Doing::Drives) idle_since_s_[v] = now_s;
    if (doing != Doing::Waits || states[v].waits_for) nameless_since_s_[v] = now_s;
    if (doing == Doing::Waits) longest_wait_s_ = std::max(longest_wait_s_, now_s - still_since_s_[v]);
  }
  for (std::uint32_t v = 0; v < n; ++v) {
    if (reported_[v] != 0) continue;
    std::string chain = endless_chain(now_s, v, states);
    if (now_s - idle_since_s_[v] > kStuck_s)
      chain = "v" + std::to_string(v + 1) + " could drive and does not";
    if (chain.empty()) continue;
    reported_[v] = 1;
    deadlocks_.push_back("at " + std::to_string(now_s) + " s: " + chain);
  }
}

// Whom it waits for, whom he waits for, and so on: the chain has to end with somebody who stands for another
// reason, or who drives, or who has just been permitted to. Empty if it does.
std::string Judge::endless_chain(double now_s, std::uint32_t vehicle,
                                 std::span<const VehicleState> states) const {
  std::string chain = "v" + std::to_string(vehicle + 1);
  std::uint32_t at = vehicle;
  for (std::size_t k = 0; k <= states.size(); ++k) {
    if (states[at].doing != Doing::Waits) return {};
    if (!states[at].waits_for)
      return now_s - nameless_since_s_[at] > kStuck_s ? chain + " waits for nobody" : "";
    at = *states[at].waits_for;
    if (k < states.size()) chain += " -> v" + std::to_string(at + 1);
  }
  return chain;
}

}  // namespace stepwright::bench::shift
