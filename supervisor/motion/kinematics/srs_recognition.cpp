#include <algorithm>
#include <cmath>
#include <numbers>

#include "supervisor/motion/kinematics/srs_arm.h"

namespace stepwright::motion {

namespace {

constexpr double kMeet_m = 1e-7;
constexpr double kRightAngle = 1e-7;

struct Line {
  Vector3 point, direction;
};

// The point nearest to three lines, if it lies on all of them.
std::optional<Vector3> common_point(const Line& a, const Line& b, const Line& c) {
  // Of two lines that are not parallel: the point of `a` nearest to `b`.
  const Vector3 normal = cross(a.direction, b.direction);
  const double square = dot(normal, normal);
  if (square < 1e-6) return std::nullopt;
  const double along = dot(cross(b.point - a.point, b.direction), normal) / square;
  const Vector3 point = a.point + along * a.direction;
  for (const Line& each : {a, b, c})
    if (length(without(point - each.point, each.direction)) > kMeet_m) return std::nullopt;
  return point;
}

bool at_right_angles(const Line& a, const Line& b) {
  return std::abs(dot(a.direction, b.direction)) < kRightAngle;
}

}  // namespace

std::optional<SrsArm> SrsArm::recognise(const Chain& chain) {
  if (chain.size() != 7) return std::nullopt;
  std::array<Transform, 7> frames;
  const std::array<double, 7> zeros{};
  SrsArm arm;
  arm.zero_ = chain.forward(zeros, frames);
  arm.zero_back_ = inverse(arm.zero_);
  std::array<Line, 7> axes;
  for (std::size_t k = 0; k < 7; ++k) {
    const ChainJoint& joint = chain.joints()[k];
    if (joint.kind == JointKind::Prismatic) return std::nullopt;
    axes[k] = {frames[k].position_m, normalised(frames[k].rotation * joint.axis)};
    arm.lower_[k] = joint.lower;
    arm.upper_[k] = joint.upper;
  }
  for (const std::size_t second : {1U, 5U})
    if (!at_right_angles(axes[second], axes[second - 1]) || !at_right_angles(axes[second], axes[second + 1]))
      return std::nullopt;
  const auto shoulder = common_point(axes[0], axes[1], axes[2]);
  const auto wrist = common_point(axes[4], axes[5], axes[6]);
  if (!shoulder || !wrist) return std::nullopt;
  arm.shoulder_ = OrthogonalAxes(axes[0].direction, axes[1].direction, axes[2].direction);
  arm.wrist_ = OrthogonalAxes(axes[4].direction, axes[5].direction, axes[6].direction);
  arm.shoulder_m_ = *shoulder;
  arm.wrist_at_zero_m_ = *wrist;
  arm.elbow_axis_ = axes[3].direction;
  // The point of the elbow's axis that is nearest to the shoulder.
  arm.elbow_m_ = *shoulder + without(axes[3].point - *shoulder, arm.elbow_axis_);
  const Vector3 forearm = *wrist - arm.elbow_m_;
  const GoingRound round(arm.elbow_axis_, forearm);
  const Vector3 still = arm.elbow_m_ + round.constant - *shoulder;
  const double square = dot(round.with_cosine, round.with_cosine);
  arm.distance_ = {dot(still, still) + square, 2.0 * dot(still, round.with_cosine),
                   2.0 * dot(still, round.with_sine)};
  const double amplitude = std::hypot(arm.distance_.with_cosine, arm.distance_.with_sine);
  if (amplitude < 1e-6) return std::nullopt;  // the elbow does not change the distance
  // The extremes lie at the limits, or where the arm is stretched or folded.
  const double stretched = std::atan2(arm.distance_.with_sine, arm.distance_.with_cosine);
  double least = arm.distance_.constant + amplitude, greatest = arm.distance_.constant - amplitude;
  const auto consider = [&](double angle) {
    const double value = std::max(0.0, arm.distance_.at(std::cos(angle), std::sin(angle)));
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  };
  for (const double limit : {arm.lower_[3], arm.upper_[3]})
    if (std::isfinite(limit)) consider(limit);
  for (const double angle : {stretched, wrapped(stretched + std::numbers::pi)})
    if (arm.within(3, angle)) consider(angle);
  arm.wrist_distance_m_ = {std::sqrt(std::max(0.0, least)), std::sqrt(std::max(0.0, greatest))};
  return arm;
}

}  // namespace stepwright::motion
