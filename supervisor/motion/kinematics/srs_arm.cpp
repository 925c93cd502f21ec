#include "supervisor/motion/kinematics/srs_arm.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stepwright::motion {

namespace {

constexpr double kAtShoulder_m = 1e-9;  // a wrist in the shoulder leaves everything open

// `line` and what a direction of reference has at right angles to it, as the first two columns.
Rotation frame_of(Vector3 line, Vector3 reference, Vector3 instead) {
  Vector3 aside = without(reference, line);
  if (length(aside) < 1e-7 * std::max(1.0, length(reference))) aside = without(instead, line);
  const Vector3 y = normalised(aside);
  return from_columns(line, y, cross(line, y));
}

}  // namespace

std::optional<double> SrsArm::within(std::size_t joint, double value) const {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  constexpr double kSlack = 1e-12;
  const double lower = lower_[joint], upper = upper_[joint];
  if (!std::isfinite(lower) || !std::isfinite(upper)) return wrapped(value);
  const double middle = 0.5 * (lower + upper);
  const double nearest = middle + wrapped(value - middle);
  if (nearest >= lower - kSlack && nearest <= upper + kSlack) return std::clamp(nearest, lower, upper);
  const double other =
      nearest < middle ? nearest + kTurn : nearest - kTurn;  // at half a turn both are as near
  if (other >= lower - kSlack && other <= upper + kSlack) return std::clamp(other, lower, upper);
  return std::nullopt;
}

std::optional<double> SrsArm::elbow(double distance_m, bool lesser) const {
  constexpr double kOutside = 1e-12;  // of the squared distance: stretched but for rounding
  const double amplitude = std::hypot(distance_.with_cosine, distance_.with_sine);
  const double level = (distance_m * distance_m - distance_.constant) / amplitude;
  if (!(std::abs(level) <= 1.0 + kOutside)) return std::nullopt;
  const double middle = std::atan2(distance_.with_sine, distance_.with_cosine);
  const double aside = std::acos(std::clamp(level, -1.0, 1.0));
  return wrapped(lesser ? middle - aside : middle + aside);
}

Rotation SrsArm::upper_arm(double elbow, Vector3 line) const {
  const Vector3 forearm = elbow_m_ + about(elbow_axis_, elbow) * (wrist_at_zero_m_ - elbow_m_) - shoulder_m_;
  const Vector3 from = normalised(forearm);
  const Rotation zero = frame_of(from, elbow_m_ - shoulder_m_, cross(elbow_axis_, from));
  const Rotation there = frame_of(line, shoulder_.first(), any_normal(shoulder_.first()));
  return there * transposed(zero);
}

Vector3 SrsArm::wrist_m(const Transform& tip) const {
  return tip * (zero_back_ * wrist_at_zero_m_);
}

std::optional<SrsArm::Posture> SrsArm::posture(const Transform& tip, bool lesser_bend) const {
  const Vector3 reach = wrist_m(tip) - shoulder_m_;
  const double far_m = length(reach);
  if (!(far_m > kAtShoulder_m)) return std::nullopt;
  const auto bend = elbow(far_m, lesser_bend);
  if (!bend) return std::nullopt;
  Posture posture;
  posture.elbow = *bend;
  posture.line = (1.0 / far_m) * reach;
  posture.at_zero = upper_arm(*bend, posture.line);
  posture.carried = tip.rotation * zero_back_.rotation;
  posture.elbow_back = about(elbow_axis_, -*bend);
  return posture;
}

std::optional<SrsSolution> SrsArm::solve(const Transform& tip, double swivel_rad, SrsBranch branch,
                                         bool limits) const {
  const auto found = posture(tip, branch.elbow);
  if (!found) return std::nullopt;
  const Rotation upper = about(found->line, swivel_rad) * found->at_zero;
  const auto shoulder = shoulder_.values(upper, branch.shoulder);
  const auto wrist = wrist_.values(found->elbow_back * (transposed(upper) * found->carried), branch.wrist);
  SrsSolution solution{{shoulder[0], shoulder[1], shoulder[2], found->elbow, wrist[0], wrist[1], wrist[2]},
                       branch};
  for (std::size_t k = 0; k < 7; ++k)
    if (const auto value = within(k, solution.q[k]))
      solution.q[k] = *value;
    else if (limits)
      return std::nullopt;
  return solution;
}

SrsSolutions SrsArm::solve(const Transform& tip, double swivel_rad) const {
  SrsSolutions solutions;
  for (const bool lesser : {false, true}) {
    const auto found = posture(tip, lesser);
    if (!found) return solutions;
    const auto bend = within(3, found->elbow);
    if (!bend) continue;
    const Rotation upper = about(found->line, swivel_rad) * found->at_zero;
    const Rotation hand = found->elbow_back * (transposed(upper) * found->carried);
    for (const bool flipped : {false, true}) {
      const auto shoulder = shoulder_.values(upper, flipped);
      const auto q1 = within(0, shoulder[0]), q2 = within(1, shoulder[1]), q3 = within(2, shoulder[2]);
      if (!q1 || !q2 || !q3) continue;
      for (const bool turned : {false, true}) {
        const auto wrist = wrist_.values(hand, turned);
        const auto q5 = within(4, wrist[0]), q6 = within(5, wrist[1]), q7 = within(6, wrist[2]);
        if (q5 && q6 && q7)
          solutions.all[solutions.count++] = {{*q1, *q2, *q3, *bend, *q5, *q6, *q7},
                                              {lesser, flipped, turned}};
      }
    }
  }
  return solutions;
}

Transform SrsArm::forward(const std::array<double, 7>& q) const {
  const Rotation upper = shoulder_.rotation({q[0], q[1], q[2]});
  const Rotation lower = upper * about(elbow_axis_, q[3]);
  const Rotation all = lower * wrist_.rotation({q[4], q[5], q[6]});
  const Vector3 elbow = shoulder_m_ + upper * (elbow_m_ - shoulder_m_);
  const Vector3 wrist = elbow + lower * (wrist_at_zero_m_ - elbow_m_);
  return {all * zero_.rotation, wrist + all * (zero_.position_m - wrist_at_zero_m_)};
}

double SrsArm::swivel(const std::array<double, 7>& q) const {
  const Rotation upper = shoulder_.rotation({q[0], q[1], q[2]});
  const Vector3 forearm = elbow_m_ + about(elbow_axis_, q[3]) * (wrist_at_zero_m_ - elbow_m_) - shoulder_m_;
  const Vector3 line = normalised(upper * forearm);
  const Rotation turned = upper * transposed(upper_arm(q[3], line));
  const Vector3 aside = any_normal(line);
  return std::atan2(dot(line, cross(aside, turned * aside)), dot(aside, turned * aside));
}

SrsBranch SrsArm::branch(const std::array<double, 7>& q) const {
  const double middle = std::atan2(distance_.with_sine, distance_.with_cosine);
  return {wrapped(q[3] - middle) < 0.0, shoulder_.flipped(q[1]), wrist_.flipped(q[5])};
}

}  // namespace stepwright::motion
