#include "supervisor/motion/timing/internal/profile_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "supervisor/motion/timing/internal/greatest_share.h"

namespace stepwright::motion::internal {

namespace {

// Integral of 1 / sqrt(b) over an interval, b being the quadratic with these values and slopes at its ends:
// Gauss's rule with five places (Abramowitz, Stegun 1964, table 25.4) on each of `kCuts` parts.
double passing_time(double length, double b0, double slope0, double b1) {
  constexpr std::array<double, 5> kPlaces{-0.906179845938663992797626878299,
                                          -0.538469310105683091036314420700, 0.0,
                                          0.538469310105683091036314420700, 0.906179845938663992797626878299};
  constexpr std::array<double, 5> kWeights{0.236926885056189087514264040720, 0.478628670499366468041291514836,
                                           0.568888888888888888888888888889, 0.478628670499366468041291514836,
                                           0.236926885056189087514264040720};
  constexpr int kCuts = 4;
  const double bend = b1 - b0 - slope0 * length;
  double sum = 0.0;
  for (int cut = 0; cut < kCuts; ++cut)
    for (std::size_t k = 0; k < kPlaces.size(); ++k) {
      const double x = (static_cast<double>(cut) + 0.5 + 0.5 * kPlaces[k]) / kCuts;
      sum += kWeights[k] / std::sqrt(b0 + x * (slope0 * length + x * bend));
    }
  return 0.5 * length * sum / kCuts;
}

TimeRow quintic(double begin, double length, double duration, const std::array<double, 2>& speeds,
                const std::array<double, 2>& accelerations) {
  const double c1 = speeds[0] * duration, c2 = 0.5 * accelerations[0] * duration * duration;
  const double place = length - c1 - c2, speed = speeds[1] * duration - c1 - 2.0 * c2,
               acceleration = accelerations[1] * duration * duration - 2.0 * c2;
  TimeRow row;
  row.duration = duration;
  row.c = {begin,
           c1,
           c2,
           10.0 * place - 4.0 * speed + 0.5 * acceleration,
           -15.0 * place + 7.0 * speed - acceleration,
           6.0 * place - 3.0 * speed + 0.5 * acceleration};
  return row;
}

// The optimiser keeps limits at the ends of an interval only; what they are exceeded by within it is taken
// away from both of its ends.
void lower_limits(SpeedGrid& grid, std::size_t k, const Share& share) {
  const double velocity = std::max(1.0, share.velocity), acceleration = std::max(1.0, share.acceleration),
               jerk = std::max(1.0, share.jerk);
  const auto lower = [&](GridEnd& end, bool own) {
    end.most_b /= velocity * velocity;
    for (LimitRow& row : end.acceleration) {
      row.first *= acceleration;
      row.second *= acceleration;
    }
    if (!own) return;
    for (LimitRow& row : end.jerk) {
      row.first *= jerk;
      row.second *= jerk;
      row.third *= jerk;
    }
  };
  // Limits of velocity and acceleration at a place are read from the interval that begins there.
  lower(grid[k].left, true);
  lower(grid[k].right, true);
  if (k + 1 < grid.size()) lower(grid[k + 1].left, false);
}

}  // namespace

std::vector<TimeRow> profile_rows(const SpeedGrid& grid, const SpeedProfile& profile) {
  std::vector<TimeRow> rows;
  const double up = grid.front().length(), down = grid.back().length();
  rows.push_back({3.0 * up / std::sqrt(profile.b.front()), {grid.front().begin, 0.0, 0.0, up, 0.0, 0.0}});
  for (std::size_t k = 1; k + 1 < grid.size(); ++k) {
    const double length = grid[k].length(), b0 = profile.b[k - 1], b1 = profile.b[k], a0 = profile.a[k - 1];
    const double duration = passing_time(length, b0, 2.0 * a0, b1);
    rows.push_back(
        quintic(grid[k].begin, length, duration, {std::sqrt(b0), std::sqrt(b1)}, {a0, profile.a[k]}));
  }
  rows.push_back({3.0 * down / std::sqrt(profile.b.back()),
                  {grid.back().begin, 3.0 * down, -3.0 * down, down, 0.0, 0.0}});
  return rows;
}

std::vector<TimeRow> fastest_rows(const BlendedPath& path, std::size_t first, std::size_t last,
                                  const JointLimits& limits) {
  constexpr int kRounds = 4;
  constexpr double kGoodEnough = 1.0005, kRounding = 1.0 + 1e-12;
  SpeedGrid grid = speed_grid(path, first, last, limits, 1);
  std::vector<TimeRow> fastest;
  double shortest = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds; ++round) {
    std::vector<TimeRow> rows = profile_rows(grid, SpeedOptimiser(grid).solve({}));
    Share most;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const Share share = greatest_share(path, path.pieces()[grid[k].piece], rows[k], limits);
      most.raise(share);
      lower_limits(grid, k, share);
    }
    const double stretch = most.stretch() * kRounding;
    double sum = 0.0;
    for (TimeRow& row : rows) {
      row.duration *= stretch;
      sum += row.duration;
    }
    if (sum < shortest) {
      shortest = sum;
      fastest = std::move(rows);
    }
    if (stretch < kGoodEnough) break;
  }
  return fastest;
}

}  // namespace stepwright::motion::internal
