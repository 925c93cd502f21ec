#pragma once

// Drives a vehicle along its path, within its polygons, no further than it may and no earlier than its
// schedule says.
//
// One thread at a time. step() is called every kControlStep_s and allocates nothing. A vehicle that is
// farther from its path than `lost_m`, or stands while it should drive, gets the command to stop and is not
// driven on; somebody has to plan for it anew.
//
//   auto follower = PathFollower::create(path, areas, limits, footprint, {});
//   while (!follower->arrived()) {
//     const DriveCommand command =
//         follower->step(measured(), now_s, {.permitted_m = granted_m, .gates = gates});
//   }

#include <optional>
#include <span>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/fleet/control/predictive_controller.h"
#include "supervisor/fleet/control/speed_plan.h"
#include "supervisor/geometry/path.h"

namespace stepwright::fleet {

// A polygon of an envelope and the part of the path during which the vehicle is within it.
struct PathArea {
  geometry::ConvexPolygon polygon;
  double entry_m = 0.0;
  double exit_m = 0.0;
};

struct FollowerSettings {
  ControllerWeights weights;
  double lost_m = 0.6;
  double stalled_s = 6.0;      // of standing while it should drive
  double halt_before_m = 0.2;  // of the place up to which it may go
  double arrived_m = 0.04;
  double arrived_m_s = 0.02;
};

class PathFollower {
 public:
  // Fails with F1201: the path has a number that is none, or goes nowhere.
  [[nodiscard]] static result::Result<PathFollower> create(const geometry::Path& path,
                                                           std::span<const PathArea> areas,
                                                           const DriveLimits& limits,
                                                           const geometry::Footprint& footprint,
                                                           const FollowerSettings& settings);

  // The drives' set points for the next step. Measured numbers that are none stop the vehicle.
  DriveCommand step(const VehicleState& measured, double time_s, const Clearance& clearance);

  bool arrived() const { return arrived_; }
  bool lost() const { return lost_; }
  // Length of way so far.
  double arc_m() const { return arc_m_; }
  // To the path, at the last step.
  double deviation_m() const { return deviation_m_; }
  // When the vehicle will have come as far as `arc_m` if nothing else holds it; nothing if it may not go
  // there.
  std::optional<double> expected_s(double arc_m, double time_s, const Clearance& clearance) const;
  const Prediction& prediction() const { return prediction_; }

 private:
  struct Section {
    Leg leg;
    SpeedPlan plan;
  };
  struct Area {
    std::vector<geometry::HalfPlane> sides;
    double entry_m = 0.0;
    double exit_m = 0.0;
  };

  PathFollower(std::vector<Section> sections, std::vector<Area> areas, const DriveLimits& limits,
               const geometry::Footprint& footprint, const FollowerSettings& settings);
  void find_place(const VehicleState& measured);
  bool at_end_of_leg(const VehicleState& measured) const;
  bool stalled();
  double turning_s(const VehicleState& measured) const;
  void fill_reference(const VehicleState& measured, double time_s, const Clearance& clearance);
  std::span<const geometry::HalfPlane> area_at(double arc_m) const;
  const Section& section() const { return sections_[at_]; }

  std::vector<Section> sections_;
  std::vector<Area> areas_;
  DriveLimits limits_;
  FollowerSettings settings_;
  PredictiveController controller_;
  Reference reference_;
  Prediction prediction_;
  std::size_t at_ = 0;  // into sections_
  double arc_m_ = 0.0;
  double speed_m_s_ = 0.0;  // along the path
  double deviation_m_ = 0.0;
  double standing_s_ = 0.0;  // while it should drive
  double stood_at_m_ = 0.0;  // since then
  bool arrived_ = false;
  bool lost_ = false;
};

}  // namespace stepwright::fleet
