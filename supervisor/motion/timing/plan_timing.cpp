#include "supervisor/motion/timing/plan_timing.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "supervisor/motion/blend/blend.h"
#include "supervisor/motion/blend/codes.h"
#include "supervisor/motion/timing/double_s.h"
#include "supervisor/motion/timing/internal/profile_rows.h"
#include "supervisor/motion/timing/internal/speed_optimiser.h"

namespace stepwright::motion {

namespace {

using namespace internal;

// Pieces between two places where the arm rests.
struct Part {
  std::size_t first = 0, last = 0;  // of the path's pieces; last is not one of them
  bool straight(const BlendedPath& path) const { return last == first + 1 && !path.pieces()[first].is_blend; }
};

std::vector<Part> parts_of(const BlendedPath& path) {
  std::vector<Part> parts;
  const auto& pieces = path.pieces();
  for (std::size_t k = 0; k < pieces.size(); ++k)
    if (k == 0 || (!pieces[k - 1].is_blend && !pieces[k].is_blend))
      parts.push_back({k, k + 1});
    else
      parts.back().last = k + 1;
  return parts;
}

// Requires a part that is one straight motion.
std::vector<TimeRow> straight_rows(const BlendedPath& path, const PathPiece& piece,
                                   const JointLimits& limits) {
  auto rows = *double_s(piece.length(), 0.0, along_straight(path, piece, limits));
  for (TimeRow& row : rows) row.c[0] += piece.begin;
  return rows;
}

double duration_of(const std::vector<TimeRow>& rows) {
  return TimeLaw{rows}.duration();
}

}  // namespace

result::Result<TimeLaw> plan_timing(const BlendedPath& path, const JointLimits& limits) {
  if (auto sound = check_limits(limits, path.joints()); !sound) return result::forward(sound);
  TimeLaw law;
  for (const Part& part : parts_of(path)) {
    const auto rows = part.straight(path) ? straight_rows(path, path.pieces()[part.first], limits)
                                          : fastest_rows(path, part.first, part.last, limits);
    if (rows.empty())
      return result::fail(code::kBadLimit, {},
                          "the limits differ by so much that no motion through way-point " +
                              std::to_string(path.pieces()[part.first].point + 2) + " was found");
    law.rows.insert(law.rows.end(), rows.begin(), rows.end());
  }
  return law;
}

result::Result<TimeLaw> plan_straight(const Configuration& from, const Configuration& to,
                                      const JointLimits& limits, double start_speed) {
  if (auto sound = check_way_points({from, to}); !sound) return result::forward(sound);
  if (auto sound = check_limits(limits, from.size()); !sound) return result::forward(sound);
  if (!(start_speed >= 0.0) || !std::isfinite(start_speed))
    return result::fail(code::kBadLimit, {}, "a start speed is a finite number from 0 on");
  const BlendedPath path({from, to}, {0.0, 0.0});
  const PathPiece& piece = path.pieces().front();
  const AxisLimits axis = along_straight(path, piece, limits);
  auto rows = double_s(piece.length(), start_speed, axis);
  if (!rows)
    return result::fail(code::kCannotStop, {},
                        "the motion of " + std::to_string(piece.length()) + " begins with a speed of " +
                            std::to_string(start_speed) + ", from which it takes " +
                            std::to_string(stopping_distance(start_speed, axis)) + " to stop");
  return TimeLaw{std::move(*rows)};
}

result::Result<TimingBound> bound_timing(const BlendedPath& path, const JointLimits& limits, int fineness) {
  if (auto sound = check_limits(limits, path.joints()); !sound) return result::forward(sound);
  TimingBound found;
  found.proved = true;
  for (const Part& part : parts_of(path)) {
    if (part.straight(path)) {
      const double exact = duration_of(straight_rows(path, path.pieces()[part.first], limits));
      found.seconds += exact;
      found.minimum += exact;
      continue;
    }
    SpeedGrid grid = speed_grid(path, part.first, part.last, limits, std::clamp(fineness, 1, 32));
    SpeedProfile profile = SpeedOptimiser(grid).solve({.gap = 1e-4, .most_steps = 150});
    found.minimum += profile.duration;
    // Where multipliers of jerk spoil the proof: limits of jerk may be exceeded for a price, which keeps the
    // multipliers as small as the proof allows and changes nothing where they are. The minimum may be lower
    // then, and its bound holds all the same: what keeps the limits pays nothing.
    double best = profile.bound;
    constexpr int kRounds = 3;
    for (int k = 0; k < kRounds && best < (1.0 - 1e-3) * profile.duration && !profile.weights.empty(); ++k) {
      for (const JerkWeight& place : profile.weights) {
        const double sum = place.at_begin + place.at_end,
                     share = sum > 0.0 ? std::clamp(place.at_begin / sum, 0.05, 0.95) : 0.5;
        grid[place.interval].left.price = share * place.weight;
        grid[place.interval - 1].right.price = (1.0 - share) * place.weight;
      }
      profile = SpeedOptimiser(grid).solve({.gap = 1e-4, .most_steps = 150});
      best = std::max(best, profile.bound);
    }
    found.seconds += best > 0.0 ? best : profile.duration;
    found.proved = found.proved && best > 0.0;
  }
  return found;
}

}  // namespace stepwright::motion
