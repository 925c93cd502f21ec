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
constexpr int kHalvings = 2;

RealVector fixed(Vector3 a) {
  return {{Real(a.x), Real(a.y), Real(a.z)}};
}
Real dot_of(const RealVector& a, Vector3 b) {
  return b.x * a[0] + b.y * a[1] + b.z * a[2];
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

std::array<bool, 2> SrsReach::first_two_hold(std::size_t first, double skew_rad, Real with_first,
                                             Real with_second, Real with_side) const {
  const Real between = arc_cosine_of(with_first), skew(skew_rad);
  const std::array second{within(first + 1, between - skew), within(first + 1, -between - skew)};
  if (!second[0] && !second[1]) return second;
  const Real turned = angle_of(with_second, with_side);
  return {second[0] && within(first, turned), second[1] && within(first, turned + Real(kPi))};
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
  // The upper arm's frame in the base: its elbow's axis, and across.
  const RealVector axis = within_unit(c * posture.side + s * posture.up);
  const RealVector across = within_unit(c * posture.up - s * posture.side);
  const auto parts = [&](Vector3 of_base) {
    return Parts{dot_of(posture.line, of_base), dot_of(axis, of_base), dot_of(across, of_base)};
  };
  const Parts first = parts(shoulder_.first);
  const auto held = first_two_hold(0, shoulder_.skew_rad, dot_of(posture.shoulder_third, first),
                                   dot_of(posture.shoulder_third, parts(shoulder_.second)),
                                   dot_of(posture.shoulder_third, parts(shoulder_.first_side)));
  if (!held[0] && !held[1]) return;
  const Real third = angle_of(dot_of(posture.shoulder_second, first), -dot_of(posture.shoulder_side, first));
  if (!(held[0] && within(2, third)) && !(held[1] && within(2, third + Real(kPi)))) return;
  // Where the tool's axis points, as the forearm sees it.
  const double down = outward_ ? -1.0 : 1.0;
  const Parts tool{down * posture.line[2], down * axis[2], down * across[2]};
  const auto seen = first_two_hold(4, wrist_.skew_rad, dot_of(posture.wrist_first, tool),
                                   dot_of(posture.wrist_second, tool), dot_of(posture.wrist_side, tool));
  if (!seen[0] && !seen[1]) return;
  // The wrist's first axis in the base.
  const auto level = [&](std::size_t k) {
    return dot_of(posture.wrist_first, Parts{posture.line[k], axis[k], across[k]});
  };
  const Real bearing = angle_of(level(1), level(0));
  ArcSet more;
  for (const bool flipped : {false, true})
    if (seen[flipped ? 1 : 0]) add_tool(bearing, flipped, more);
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
  const Real towards = angle_of(dot_of(reach, plane_y_), dot_of(reach, plane_x_));
  const Real along_c = cosine_of(towards), along_s = sine_of(towards);
  const RealVector along = within_unit(along_c * fixed(plane_x_) + along_s * fixed(plane_y_));
  const RealVector across = within_unit(along_s * fixed(plane_x_) - along_c * fixed(plane_y_));
  const auto parts = [&](Vector3 a) {
    return Parts{dot_of(along, a), Real(dot(a, elbow_axis_)), dot_of(across, a)};
  };
  posture.shoulder_third = parts(shoulder_.third);
  posture.shoulder_second = parts(shoulder_.second);
  posture.shoulder_side = parts(shoulder_.third_side);
  // Directions of the forearm, after the elbow has bent.
  const auto bent = [&](Vector3 a) {
    const double still = dot(a, elbow_axis_);
    const RealVector turned = bend_c * fixed(without(a, elbow_axis_)) + bend_s * fixed(cross(elbow_axis_, a));
    return Parts{dot_of(along, turned), Real(still), dot_of(across, turned)};
  };
  posture.wrist_first = bent(wrist_.first);
  posture.wrist_second = bent(wrist_.second);
  posture.wrist_side = bent(wrist_.first_side);
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
