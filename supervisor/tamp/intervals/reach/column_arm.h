#pragma once

// An arm as eight numbers: a shoulder on a column, whose tool hangs down and turns about the vertical around
// the direction from the shoulder to the tool, the less the further it is stretched. Not a model of a certain
// robot: exact arcs at a point and sound ones for a box come from the same short formula, so that what is
// built on bounds of reach can be judged without an inverse kinematics.
//
// Functions without state; any thread.
//
//   const ColumnArm right{.x_m = 0, .y_m = -0.3, .z_m = 0.6};
//   const ReachTable table = reach_table(right, 0.04);

#include "supervisor/tamp/intervals/reach/exact_reach.h"

namespace stepwright::tamp {

struct ColumnArm {
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;  // of the shoulder
  double least_m = 0.2;                    // from shoulder to tool
  double easy_m = 0.5;                     // up to here it turns freely
  double most_m = 0.9;                     // here it does not turn any more
  double lean_rad = 0.0;                   // the middle of its turns, from the direction shoulder -> tool
  double turn_rad = 1.6;                   // to both sides of it, up to `easy_m`
  double flip_rad = 0.0;  // likewise with the hand turned around by half a turn; 0: not at all
};

// What it reaches at a point, to a unit outward.
ArcSet arcs_at(const ColumnArm& arm, const Point3& tool);

class ColumnReach final : public ExactReach {
 public:
  explicit ColumnReach(const ColumnArm& arm) : arm_(arm) {}

  bool reaches(const Point3& at, Angle angle) const override { return near(at).contains(angle); }
  ArcSet near(const Point3& at) const override { return arcs_at(arm_, at); }

 private:
  ColumnArm arm_;
};

// An outer bound for all points of the box and a nanometre around it.
ArcSet arcs_over(const ColumnArm& arm, const Box& box);
// Cells of this width over all that it reaches. Requires a width from 1 mm to 1 m.
ReachTable reach_table(const ColumnArm& arm, double cell_m);

}  // namespace stepwright::tamp
