#pragma once

// The exact reach of an arm with spherical shoulder, elbow and spherical wrist, by its inverse kinematics in
// closed form, for a tool that hangs down. The elbow has a few degrees to spare. Collisions are not looked
// at.
//
// Immutable; any thread.
//
//   const auto exact = SrsExact::make(*chain, {});       // of the arms of which there is an SrsReach

#include <optional>

#include "supervisor/motion/kinematics/srs_arm.h"
#include "supervisor/tamp/intervals/arm/srs_reach.h"
#include "supervisor/tamp/intervals/reach/exact_reach.h"

namespace stepwright::tamp {

class SrsExact final : public ExactReach {
 public:
  // The base stands upright at `base_nm`. Nothing for chains of which no bounds are made.
  static std::optional<SrsExact> make(const motion::Chain& chain, const Point3& base_nm);

  bool reaches(const Point3& at, Angle angle) const override;
  ArcSet near(const Point3& at) const override;

 private:
  SrsExact(SrsReach bounds, const motion::SrsArm& arm, const Point3& base_nm)
      : bounds_(std::move(bounds)), arm_(arm), base_nm_(base_nm) {}

  SrsReach bounds_;
  motion::SrsArm arm_;
  Point3 base_nm_;
};

}  // namespace stepwright::tamp
