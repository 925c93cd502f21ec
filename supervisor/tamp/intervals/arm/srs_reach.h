#pragma once

// The reach of an arm with spherical shoulder, elbow and spherical wrist, for a tool that hangs down: outer
// bounds of its angle about the vertical for all positions of a box, by interval evaluation of the closed
// form of the inverse kinematics over the swivel, a part of a turn at a time. What it leaves out is proved to
// be out of reach: some joint would be beyond its limits, or the elbow does not bend so far. What it leaves
// in may be too much by what intervals overestimate: narrower parts of the swivel and smaller boxes make it
// less.
//
// The last joint turns the tool about the vertical, so that the first six know nothing of the angle; for
// other mountings of the tool nothing is made. Collisions are not looked at.
//
// Immutable; any thread.
//
//   const auto reach = SrsReach::make(*chain);          // from the base to the tool's tip
//   const ReachTable table = ReachTable::fill(grid, [&](const Box& cell) { return reach->arcs_over(cell); });

#include <array>
#include <optional>

#include "supervisor/motion/kinematics/chain.h"
#include "supervisor/tamp/intervals/arm/interval_math.h"
#include "supervisor/tamp/intervals/reach/reach_bounds.h"

namespace stepwright::tamp {

class SrsReach {
 public:
  // Nothing for chains of another kind, or whose last axis is not that of the tool (z of the tip).
  static std::optional<SrsReach> make(const motion::Chain& chain, int swivel_parts = 24);

  // In the frame of the chain's base.
  Shoulder shoulder() const { return {{shoulder_m_.x, shoulder_m_.y, shoulder_m_.z}, tool_m_}; }
  // From shoulder to wrist at the most.
  double most_m() const { return length(upper_m_) + length(lower_m_); }
  // Of the tip's z axis pointing down, its x axis at the angle; positions in the chain's base, which stands
  // upright. A nanometre around the box included.
  ArcSet arcs_over(const Box& box) const;
  // Cells of this width over all that it may reach, in the cell where the base stands at `base_nm`.
  ReachTable table(double cell_m, const Point3& base_nm = {}) const;

 private:
  // Directions of three axes that meet, at zero.
  struct Axes {
    motion::Vector3 first, second, third;
    motion::Vector3 first_side, third_side;  // second x first, second x third
    double skew_rad = 0.0;                   // from the first to the third, about the second
  };
  // A direction in the upper arm's frame: along the line from shoulder to wrist, along the elbow's axis, and
  // across both; or of the base, the same of the upper arm's frame as it stands there.
  struct Parts {
    Real along, axis, across;
  };
  friend Real dot_of(const Parts& a, const Parts& b) {
    return a.along * b.along + a.axis * b.axis + a.across * b.across;
  }
  // The arm at a place of the wrist and a bend of the elbow: all but the swivel.
  struct Posture {
    RealVector line, side, up;             // of the base: from shoulder to wrist, and two at right angles
    Parts shoulder_third;                  // of the upper arm
    Parts shoulder_second, shoulder_side;  // likewise: the second axis, and second x third
    Parts wrist_first, wrist_second, wrist_side;  // likewise, with the elbow bent
  };

  static std::optional<Axes> axes_of(motion::Vector3 first, motion::Vector3 second, motion::Vector3 third);
  bool within(std::size_t joint, Real angle) const;
  // Whether joints can do it, unflipped and flipped: of the direction to which the third axis is to point,
  // its parts along the first axis, the second, and second x first.
  std::array<bool, 2> first_two_hold(std::size_t first, double skew_rad, Real with_first, Real with_second,
                                     Real with_side) const;
  void add_elbow(const RealVector& to_wrist, Real distance, double side, ArcSet& found) const;
  void add_swivel(const Posture& posture, Real swivel, int depth, ArcSet& found) const;
  void add_tool(Real bearing, bool flipped, ArcSet& found) const;

  int parts_ = 24;
  std::array<std::array<double, 2>, 7> limits_{};
  Axes shoulder_, wrist_;
  motion::Vector3 shoulder_m_;
  motion::Vector3 elbow_axis_, plane_x_, plane_y_;  // right-handed: x, y, axis
  motion::Vector3 upper_m_, lower_m_;               // shoulder to elbow, elbow to wrist, at zero
  std::array<double, 3> distance_{};                // squared: constant, with cosine, with sine of the elbow
  double tool_m_ = 0.0;                             // of the wrist above the tip
  bool outward_ = true;                             // the last axis points to where the tool does
  double second_rad_ = 0.0;                         // of the wrist's second axis, as the tool looks up to it
};

}  // namespace stepwright::tamp
