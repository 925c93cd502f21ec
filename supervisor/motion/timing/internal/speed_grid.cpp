#include "supervisor/motion/timing/internal/speed_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "supervisor/motion/blend/rounding.h"
#include "supervisor/motion/timing/internal/roots.h"

namespace stepwright::motion::internal {

namespace {

class GridMaker {
 public:
  GridMaker(const BlendedPath& path, std::size_t first, std::size_t last, const JointLimits& limits,
            int fineness)
      : path_(path), limits_(limits), first_(first), last_(last) {
    fine_ = static_cast<double>(fineness);
    whole_ = path.pieces()[last - 1].end - path.pieces()[first].begin;
    longest_ = whole_ / (160.0 * fine_);
    growth_ = 1.0 + 0.12 / fine_;
  }

  SpeedGrid made() {
    for (std::size_t k = first_; k < last_; ++k) {
      const PathPiece& piece = path_.pieces()[k];
      const std::vector<double> lengths = piece.is_blend ? of_blend(piece) : of_straight(k);
      double begin = piece.begin;
      for (std::size_t m = 0; m < lengths.size(); ++m) {
        const double end = m + 1 == lengths.size() ? piece.end : begin + lengths[m];
        grid_.push_back({k, begin, end, end_at(piece, begin), end_at(piece, end)});
        begin = end;
      }
    }
    rest_beside(grid_.front(), grid_.front().right, grid_[1].left);
    rest_beside(grid_.back(), grid_.back().left, grid_[grid_.size() - 2].right);
    return std::move(grid_);
  }

 private:
  std::vector<double> of_blend(const PathPiece& piece) const {
    const double count = std::max(40.0 * fine_, std::floor(piece.length() / longest_) + 1.0);
    return std::vector<double>(static_cast<std::size_t>(count), piece.length() / count);
  }

  // Small beside what is small, and growing from there.
  std::vector<double> of_straight(std::size_t k) const {
    const PathPiece& piece = path_.pieces()[k];
    const double most = std::min(longest_, piece.length() / 4.0);
    const double rest = std::min(most, at_rest(piece));
    const auto beside = [&](bool inner, std::size_t other) {
      return inner ? std::min(most, 1.0 * path_.pieces()[other].length() / (40.0 * fine_)) : rest;
    };
    double left = beside(k > first_, k - 1), right = beside(k + 1 < last_, k + 1), sum = 0.0;
    std::vector<double> begins, ends;
    // After the interval at rest the next one is to grow from its length times growth - 1.
    const auto push = [&](std::vector<double>& list, double& length, bool at_rest) {
      list.push_back(length);
      sum += length;
      length = at_rest && list.size() == 1 ? std::max(length * (growth_ - 1.0), 1e-3 * length)
                                           : std::min(most, length * growth_);
    };
    while (sum < piece.length())
      if (left <= right)
        push(begins, left, k == first_);
      else
        push(ends, right, k + 1 == last_);
    begins.insert(begins.end(), ends.rbegin(), ends.rend());
    for (double& each : begins) each *= piece.length() / sum;
    return begins;
  }

  // A small part of what it takes to reach the greatest acceleration from rest.
  double at_rest(const PathPiece& piece) const {
    const AxisLimits axis = along_straight(path_, piece, limits_);
    const double until_constant =
        axis.acceleration * axis.acceleration * axis.acceleration / (6.0 * axis.jerk * axis.jerk);
    const double until_fast = axis.velocity * std::sqrt(axis.velocity / axis.jerk);
    return std::max(0.05 / fine_ * std::min({until_constant, until_fast, whole_}), 1e-6 * whole_);
  }

  GridEnd end_at(const PathPiece& piece, double s) const {
    const Rounding round = piece.is_blend ? rounding(s - piece.place, piece.half_width) : Rounding{};
    GridEnd end;
    double slowest = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < path_.joints(); ++j) {
      const double before = path_.before(piece, j), turn = path_.turn(piece, j);
      const LimitRow row{before + turn * round.first, turn * round.second, turn * round.third};
      if (row.first != 0.0) slowest = std::min(slowest, limits_.velocity[j] / std::abs(row.first));
      if (!piece.is_blend) continue;
      end.acceleration.push_back(over(row, limits_.acceleration[j]));
      end.jerk.push_back(over(row, limits_.jerk[j]));
    }
    end.most_b = slowest * slowest;
    if (!piece.is_blend) {
      const AxisLimits axis = along_straight(path_, piece, limits_);
      end.acceleration.push_back({1.0 / axis.acceleration, 0.0, 0.0});
      end.jerk.push_back({1.0 / axis.jerk, 0.0, 0.0});
    }
    return end;
  }

  static LimitRow over(const LimitRow& row, double limit) {
    return {row.first / limit, row.second / limit, row.third / limit};
  }

  // From rest with the jerk j: b^(3/2) = 9/2 j s^2.
  void rest_beside(const GridInterval& interval, GridEnd& own, GridEnd& next) const {
    const double jerk = along_straight(path_, path_.pieces()[interval.piece], limits_).jerk;
    const double root = cube_root(4.5 * jerk * interval.length() * interval.length());
    own.most_b = next.most_b = std::min(own.most_b, root * root);
  }

  const BlendedPath& path_;
  const JointLimits& limits_;
  std::size_t first_, last_;
  double fine_ = 1.0, whole_ = 0.0, longest_ = 0.0, growth_ = 0.0;
  SpeedGrid grid_;
};

}  // namespace

SpeedGrid speed_grid(const BlendedPath& path, std::size_t first, std::size_t last, const JointLimits& limits,
                     int fineness) {
  return GridMaker(path, first, last, limits, fineness).made();
}

AxisLimits along_straight(const BlendedPath& path, const PathPiece& piece, const JointLimits& limits) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  AxisLimits axis{kNone, kNone, kNone};
  for (std::size_t j = 0; j < path.joints(); ++j) {
    const double slope = std::abs(path.before(piece, j));
    if (slope == 0.0) continue;
    axis.velocity = std::min(axis.velocity, limits.velocity[j] / slope);
    axis.acceleration = std::min(axis.acceleration, limits.acceleration[j] / slope);
    axis.jerk = std::min(axis.jerk, limits.jerk[j] / slope);
  }
  return axis;
}

}  // namespace stepwright::motion::internal
