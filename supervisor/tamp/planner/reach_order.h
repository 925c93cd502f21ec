#pragma once

// How likely a choice of grasp or angle is to be within reach all along a thing's way: of the hand that picks
// it, of the same hand where it is put, of the next hand there, and so on. By the outer bounds of the arms'
// reach (interval_model.h): outside of them there is no way; the farther inside, the likelier there is one.
//
// Does not change after it was made; any thread. The model outlives it.
//
//   ReachOrder order(model, grasps, angles);
//   order.then(right, start);                      // picked here
//   order.then(right, box_top);                    // placed there
//   if (order.of_grasp(start_angle, hand) <= 0.0)  // never
//
// All lengths are of tools, metres; angles in radians.

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "supervisor/tamp/planner/interval_model.h"

namespace stepwright::tamp::planner {

class ReachOrder {
 public:
  struct Spot {
    double x_m = 0.0, y_m = 0.0, z_m = 0.0;
  };

  // The hand's angles seen from the thing, and the thing's angles, that may be chosen.
  ReachOrder(const IntervalModel& model, std::vector<double> grasps, std::vector<double> angles)
      : model_(&model), grasps_(std::move(grasps)), angles_(std::move(angles)) {}

  // The next visit of a hand: the first one picks, or places if the order is asked of_place(), then they take
  // turns.
  void then(int arm, const Spot& tool);
  std::size_t visits() const { return visits_.size(); }

  // The least distance from the ends of the bounds, with the best choices later: 0 outside.
  double of_grasp(double angle_rad, double hand_rad) const { return picked(0, angle_rad, hand_rad); }
  double of_place(double angle_rad, double hand_rad) const { return placed(0, angle_rad, hand_rad); }

 private:
  double picked(std::size_t visit, double angle_rad, double hand_rad) const;
  double placed(std::size_t visit, double angle_rad, double hand_rad) const;

  const IntervalModel* model_;
  std::vector<double> grasps_, angles_;
  std::vector<std::span<const Arc>> visits_;  // of each: which angles the arm reaches there
};

}  // namespace stepwright::tamp::planner
