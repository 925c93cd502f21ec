#include "supervisor/motion/blend/blend.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "supervisor/motion/blend/codes.h"
#include "supervisor/motion/blend/rounding.h"

namespace stepwright::motion {

namespace {

constexpr std::size_t kMostJoints = 14, kMostWayPoints = 1000;
constexpr double kMostCoordinate = 1e6;
// Below it the path turns round. The joints nearly stand still in the middle of such a blend, and a blend
// saves nothing.
constexpr double kTurnsRound = -0.99;

std::string way_point(std::size_t k) {
  return "way-point " + std::to_string(k + 1);
}

JointPath chords_of(const BlendedPath& path, const PathPiece& piece, int count) {
  JointPath chords;
  for (int k = 0; k <= count; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(count);
    chords.emplace_back(path.joints());
    path.at(piece, piece.begin + share * piece.length(), chords.back());
  }
  return chords;
}

// The widest blend of a corner within the tolerance and half of the straight parts beside it.
double widest(const BlendedPath& corners, std::size_t k, double tolerance) {
  const Configuration &in = corners.directions()[k - 1], &out = corners.directions()[k];
  double cosine = 0.0, turn = 0.0;
  for (std::size_t j = 0; j < in.size(); ++j) {
    cosine += in[j] * out[j];
    turn = std::max(turn, std::abs(out[j] - in[j]));
  }
  if (cosine < kTurnsRound) return 0.0;
  const auto& places = corners.places();
  const double room = 0.5 * std::min(places[k] - places[k - 1], places[k + 1] - places[k]);
  return Rounding::kDeviation * turn * room <= tolerance ? room : tolerance / (Rounding::kDeviation * turn);
}

}  // namespace

result::Result<void> check_way_points(const JointPath& way_points) {
  if (way_points.size() < 2 || way_points.size() > kMostWayPoints)
    return result::fail(code::kShortPath, {},
                        "a path has 2 to " + std::to_string(kMostWayPoints) + " way-points, this one has " +
                            std::to_string(way_points.size()));
  const std::size_t joints = way_points.front().size();
  if (joints == 0 || joints > kMostJoints)
    return result::fail(code::kShortPath, {},
                        "a way-point has 1 to " + std::to_string(kMostJoints) + " joints, these have " +
                            std::to_string(joints));
  for (std::size_t k = 0; k < way_points.size(); ++k) {
    if (way_points[k].size() != joints)
      return result::fail(code::kJointCount, {},
                          way_point(k) + " has " + std::to_string(way_points[k].size()) +
                              " joints, way-point 1 has " + std::to_string(joints));
    for (std::size_t j = 0; j < joints; ++j)
      if (!(std::abs(way_points[k][j]) <= kMostCoordinate))
        return result::fail(
            code::kNotFinite, {},
            way_point(k) + ", joint " + std::to_string(j + 1) + ": no finite number within 1e6 rad or m");
    // Nearer than this a direction is made of rounding errors.
    constexpr double kLeastDistance = 1e-7;
    if (k > 0 && !(joint_distance(way_points[k - 1], way_points[k]) > kLeastDistance))
      return result::fail(code::kRepeated, {}, way_point(k) + " repeats the one before",
                          "leave it out; way-points are at least 1e-7 rad or m apart");
  }
  return {};
}

result::Result<BlendedPath> blend(const JointPath& way_points, const BlendOptions& options,
                                  const BlendCheck& check) {
  if (auto sound = check_way_points(way_points); !sound) return result::forward(sound);
  if (!(options.tolerance >= 0.0) || !std::isfinite(options.tolerance) || options.most_halvings < 0 ||
      options.chords < 1 || options.chords > 10'000)
    return result::fail(code::kBadLimit, {},
                        "a tolerance of blends is a finite number from 0 on, and a blend has 1 to 10,000 "
                        "chords");
  std::vector<double> half_widths(way_points.size(), 0.0);
  const BlendedPath corners(way_points, half_widths);
  constexpr double kLeastHalfWidth = 1e-6;
  for (std::size_t k = 1; k + 1 < way_points.size(); ++k) {
    double tolerance = options.tolerance;
    for (int tries = 0; tries <= options.most_halvings; ++tries, tolerance *= 0.5) {
      const double half_width = widest(corners, k, tolerance);
      if (half_width < kLeastHalfWidth) break;
      const double place = corners.places()[k];
      const PathPiece piece{k, true, place - half_width, place + half_width, place, half_width};
      if (check && !check(chords_of(corners, piece, options.chords))) continue;
      half_widths[k] = half_width;
      break;
    }
  }
  return BlendedPath(way_points, std::move(half_widths));
}

}  // namespace stepwright::motion
