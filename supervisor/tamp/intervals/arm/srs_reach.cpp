#include "supervisor/tamp/intervals/arm/srs_reach.h"

#include <cmath>
#include <numbers>

#include "supervisor/motion/kinematics/srs_arm.h"

namespace stepwright::tamp {
namespace {

using motion::Vector3;

constexpr double kPi = std::numbers::pi;
// Axes, and the elbow's plane, are straight to this; joints' limits are widened by more than it changes.
constexpr double kStraight = 1e-9;
constexpr double kLimitSlack = 1e-6;
constexpr double kWhereSlack_m = 1e-7;
// A part of the swivel that holds is halved so often, to bound the angle more closely.
constexpr int kHalvings = 3;

RealVector fixed(Vector3 a) {
  return {{Real(a.x), Real(a.y), Real(a.z)}};
}
Real dot_of(const RealVector& a, Vector3 b) {
  return dot_of(a, fixed(b));
}

}  // namespace

std::optional<SrsReach::Axes> SrsReach::axes_of(Vector3 first, Vector3 second, Vector3 third) {
  if (std::abs(dot(first, second)) > kStraight || std::abs(dot(third, second)) > kStraight)
    return std::nullopt;
  Axes axes{first, second, third, cross(second, first), cross(second, third), 0.0};
  axes.skew_rad = std::atan2(dot(third, axes.first_side), dot(third, first));
  return axes;
}

std::optional<SrsReach> SrsReach::make(const motion::Chain& chain, int swivel_parts) {
  const auto arm = motion::SrsArm::recognise(chain);
  if (!arm || swivel_parts < 1) return std::nullopt;
  std::array<motion::Transform, 7> frames;
  const std::array<double, 7> zeros{};
  const motion::Transform tip = chain.forward(zeros, frames);
  std::array<Vector3, 7> axes;
  SrsReach reach;
  reach.parts_ = swivel_parts;
  for (std::size_t k = 0; k < 7; ++k) {
    axes[k] = normalised(frames[k].rotation * chain.joints()[k].axis);
    reach.limits_[k] = {chain.joints()[k].lower - kLimitSlack, chain.joints()[k].upper + kLimitSlack};
  }
  const auto shoulder = axes_of(axes[0], axes[1], axes[2]), wrist = axes_of(axes[4], axes[5], axes[6]);
  if (!shoulder || !wrist) return std::nullopt;
  reach.shoulder_ = *shoulder;
  reach.wrist_ = *wrist;
  reach.shoulder_m_ = arm->shoulder_m();
  const Vector3 wrist_m = arm->wrist_m(tip), axis = axes[3];
  const Vector3 elbow_m = reach.shoulder_m_ + without(frames[3].position_m - reach.shoulder_m_, axis);
  reach.elbow_axis_ = axis;
  reach.upper_m_ = elbow_m - reach.shoulder_m_;
  reach.lower_m_ = wrist_m - elbow_m;
  if (std::abs(dot(reach.lower_m_, axis)) > kStraight || length(reach.upper_m_) < 1e-3) return std::nullopt;
  reach.plane_x_ = normalised(without(reach.upper_m_, axis));
  reach.plane_y_ = cross(axis, reach.plane_x_);
  reach.distance_ = {dot(reach.upper_m_, reach.upper_m_) + dot(reach.lower_m_, reach.lower_m_),
                     2.0 * dot(reach.upper_m_, reach.lower_m_),
                     2.0 * dot(reach.upper_m_, cross(axis, reach.lower_m_))};
  const Vector3 tool_x = tip.rotation.column(0), tool_y = tip.rotation.column(1),
                tool_z = tip.rotation.column(2);
  const Vector3 beside = tip.position_m - wrist_m;
  if (length(cross(axes[6], tool_z)) > kStraight || length(without(beside, tool_z)) > kWhereSlack_m)
    return std::nullopt;
  reach.tool_m_ = dot(beside, tool_z);
  reach.outward_ = dot(axes[6], tool_z) > 0.0;
  reach.second_rad_ = std::atan2(-dot(axes[5], tool_y), dot(axes[5], tool_x));
  return reach;
}

bool SrsReach::within(std::size_t joint, Real angle) const {
  const auto [low, high] = limits_[joint];
  if (!std::isfinite(low) || !std::isfinite(high)) return true;
  // The first turn on which it ends above the lower limit.
  const double turn = 2.0 * kPi * std::ceil((low - angle.high) / (2.0 * kPi));
  return angle.low + turn <= high;
}

std::array<bool, 2> SrsReach::first_two_hold(const Axes& axes, std::size_t first,
                                             const RealVector& third_turned) const {
  const Real between = arc_cosine_of(dot_of(third_turned, axes.first)), skew(axes.skew_rad);
  const std::array second{within(first + 1, between - skew), within(first + 1, -between - skew)};
  if (!second[0] && !second[1]) return second;
  const Real turned = angle_of(dot_of(third_turned, axes.second), dot_of(third_turned, axes.first_side));
  return {second[0] && within(first, turned), second[1] && within(first, turned + Real(kPi))};
}

std::array<bool, 2> SrsReach::third_holds(const Axes& axes, std::size_t joint,
                                          const RealVector& first_back) const {
  const Real turned = angle_of(dot_of(first_back, axes.second), -dot_of(first_back, axes.third_side));
  return {within(joint, turned), within(joint, turned + Real(kPi))};
}

// sin and cos of the last joint go as f . Rz(angle) a for two directions a of the tool, f being the wrist's
// first axis in the base: what counts is the difference of its bearing and the tool's angle.
void SrsReach::add_tool(Real bearing, bool flipped, ArcSet& found) const {
  const auto [low, high] = limits_[6];
  if (!std::isfinite(low) || !std::isfinite(high) || high - low + bearing.width() >= 2.0 * kPi)
    return found.add({0, Arc::kFull});
  constexpr double kSlack = 1e-9;
  const double half = flipped ? kPi : 0.0;
  const double from = bearing.low - second_rad_ + half - kSlack,
               to = bearing.high - second_rad_ + half + kSlack;
  if (outward_)
    found.add(arc_outward(from + 0.5 * kPi - high, to + 0.5 * kPi - low));
  else
    found.add(arc_outward(from - 0.5 * kPi + low, to - 0.5 * kPi + high));
}

void SrsReach::add_swivel(const Posture& posture, Real swivel, int depth, ArcSet& found) const {
  if (found.is_full()) return;
  const Real c = cosine_of(swivel), s = sine_of(swivel);
  // The upper arm's frame in the base.
  const RealVector axis = within_unit(c * posture.side + s * posture.up);
  const RealVector across = within_unit(c * posture.up - s * posture.side);
  const RealVector elbow_axis = fixed(elbow_axis_);
  const auto turned = [&](const RealVector& a) {
    return within_unit(dot_of(a, posture.along) * posture.line + dot_of(a, elbow_axis) * axis +
                       dot_of(a, posture.across) * across);
  };
  const auto back = [&](const RealVector& a) {
    return within_unit(dot_of(a, posture.line) * posture.along + dot_of(a, axis) * elbow_axis +
                       dot_of(a, across) * posture.across);
  };
  const auto held = first_two_hold(shoulder_, 0, turned(fixed(shoulder_.third)));
  if (!held[0] && !held[1]) return;
  const auto held_third = third_holds(shoulder_, 2, back(fixed(shoulder_.first)));
  if (!(held[0] && held_third[0]) && !(held[1] && held_third[1])) return;
  // Where the tool's axis points, as the forearm sees it, and the forearm's own axis as the base sees it.
  const Real bend_c = cosine_of(posture.elbow), bend_s = sine_of(posture.elbow);
  const RealVector down = back(fixed({0.0, 0.0, outward_ ? -1.0 : 1.0}));
  const RealVector seen = within_unit((dot_of(down, elbow_axis) * (Real(1.0) - bend_c)) * elbow_axis +
                                      bend_c * down - bend_s * cross_of(elbow_axis, down));
  const auto seen_well = first_two_hold(wrist_, 4, seen);
  if (!seen_well[0] && !seen_well[1]) return;
  const RealVector fore_axis = fixed(wrist_.first);
  const RealVector bent = within_unit((dot_of(fore_axis, elbow_axis) * (Real(1.0) - bend_c)) * elbow_axis +
                                      bend_c * fore_axis + bend_s * cross_of(elbow_axis, fore_axis));
  const RealVector fore = turned(bent);
  const Real bearing = angle_of(fore[1], fore[0]);
  ArcSet more;
  for (const bool flipped : {false, true})
    if (seen_well[flipped ? 1 : 0]) add_tool(bearing, flipped, more);
  bool is_new = false;
  for (const Arc arc : more.arcs()) is_new = is_new || !found.contains(arc);
  if (!is_new) return;
  if (depth == 0) return found.add(more.arcs());
  const double middle = swivel.middle();
  add_swivel(posture, {swivel.low, middle}, depth - 1, found);
  add_swivel(posture, {middle, swivel.high}, depth - 1, found);
}

// One of the two bends of the elbow.
void SrsReach::add_elbow(const RealVector& to_wrist, Real distance, double side, ArcSet& found) const {
  const double amplitude = std::hypot(distance_[1], distance_[2]);
  const Real cosine = (square_of(distance) - Real(distance_[0])) * inverse_of(Real(amplitude));
  if (cosine.low > 1.0 + kLimitSlack || cosine.high < -1.0 - kLimitSlack) return;
  const Real off =
      arc_cosine_of({std::clamp(cosine.low - 1e-12, -1.0, 1.0), std::clamp(cosine.high + 1e-12, -1.0, 1.0)});
  const Real elbow = Real(std::atan2(distance_[2], distance_[1])) + (side > 0.0 ? off : -off);
  if (!within(3, elbow)) return;
  Posture posture;
  posture.elbow = elbow;
  posture.line = within_unit(inverse_of(distance) * to_wrist);
  // A direction that is not near to the line's.
  const Vector3 middle{posture.line[0].middle(), posture.line[1].middle(), posture.line[2].middle()};
  const RealVector reference = fixed(motion::any_normal(middle));
  const RealVector side_line = cross_of(posture.line, reference);
  const Real side_length = length_of(side_line);
  if (side_length.low < 0.1) return found.add({0, Arc::kFull});  // the box is too large to tell
  posture.side = within_unit(inverse_of(side_length) * side_line);
  posture.up = within_unit(cross_of(posture.line, posture.side));
  // The line from shoulder to wrist in the upper arm's own frame: in the plane of the elbow.
  const Real bend_c = cosine_of(elbow), bend_s = sine_of(elbow);
  const RealVector lower = bend_c * fixed(lower_m_) + bend_s * fixed(cross(elbow_axis_, lower_m_));
  const RealVector reach = fixed(upper_m_) + lower;
  const Real along = angle_of(dot_of(reach, plane_y_), dot_of(reach, plane_x_));
  const Real along_c = cosine_of(along), along_s = sine_of(along);
  posture.along = within_unit(along_c * fixed(plane_x_) + along_s * fixed(plane_y_));
  posture.across = within_unit(along_s * fixed(plane_x_) - along_c * fixed(plane_y_));
  for (int part = 0; part < parts_ && !found.is_full(); ++part) {
    const double from = -kPi + 2.0 * kPi * part / parts_, to = -kPi + 2.0 * kPi * (part + 1) / parts_;
    add_swivel(posture, {from - 1e-12, to + 1e-12}, kHalvings, found);
  }
}

ArcSet SrsReach::arcs_over(const Box& box) const {
  RealVector to_wrist;
  const double shoulder[3] = {shoulder_m_.x, shoulder_m_.y, shoulder_m_.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double up = axis == 2 ? tool_m_ : 0.0, around = 1e-9 + kWhereSlack_m;
    to_wrist.v[axis] = {metres_of(box[axis].low_nm) - shoulder[axis] + up - around,
                        metres_of(box[axis].high_nm) - shoulder[axis] + up + around};
  }
  const Real distance = length_of(to_wrist);
  if (distance.low < 0.02) return ArcSet::full();  // at the shoulder there is no line to speak of
  ArcSet found;
  for (const double side : {1.0, -1.0}) add_elbow(to_wrist, distance, side, found);
  return found;
}

ReachTable SrsReach::table(double cell_m, const Point3& base_nm) const {
  const double most_m = this->most_m();
  const double middle[3] = {shoulder_m_.x, shoulder_m_.y, shoulder_m_.z - tool_m_};
  ReachGrid grid;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    grid.step_nm[axis] = nanometres_of(cell_m);
    const auto first = static_cast<std::int64_t>(std::floor((middle[axis] - most_m) / cell_m)) - 1;
    const auto last = static_cast<std::int64_t>(std::floor((middle[axis] + most_m) / cell_m)) + 1;
    grid.origin_nm[axis] = first * grid.step_nm[axis] + base_nm[axis];
    grid.cells[axis] = static_cast<std::int32_t>(last - first + 1);
  }
  return ReachTable::fill(grid, [&](const Box& cell) {
    Box box = cell;
    for (std::size_t axis = 0; axis < 3; ++axis)
      box[axis] = {cell[axis].low_nm - base_nm[axis], cell[axis].high_nm - base_nm[axis]};
    return arcs_over(box);
  });
}

}  // namespace stepwright::tamp
