#pragma once

// Counts overlaps of vehicles with one another, with walls and with blockages, from their exact outlines
// (rectangles, forks included). It knows no plan, so that it is an independent check of one.
//
// Threads: one at a time. No heap after construction.
//
//   OverlapMonitor monitor(parameters);
//   monitor.put(v, pose); ... monitor.look(present);    // once in each step
//   monitor.overlaps();                               // pairs times steps

#include <array>
#include <cstdint>
#include <vector>

#include "plant_models/assemblies/fleet_parameters.h"

namespace stepwright::assemblies {

class OverlapMonitor {
 public:
  explicit OverlapMonitor(const FleetParameters& parameters);

  void put(std::size_t vehicle, const ForkliftPose& at);
  void set_present(std::size_t blockage, bool present);
  // After all vehicles have been put where they are.
  void look();

  std::uint64_t overlaps() const { return overlaps_; }  // of two vehicles: pairs times steps
  std::uint64_t obstacle_overlaps() const { return obstacle_overlaps_; }  // of a vehicle with an obstacle
  double smallest_gap_m() const {
    return smallest_gap_m_;
  }  // between two vehicles so far; 0 where they overlapped

  struct Outline {
    std::array<body2d::Vec2, 4> corners;  // anticlockwise
    body2d::Vec2 middle;
    double reach_m = 0.0;  // from the middle to the corners
    bool present = true;
  };

 private:
  ForkliftBody body_;
  std::vector<Outline> vehicles_;
  std::vector<Outline> obstacles_;  // walls, then blockages
  std::size_t walls_ = 0;
  std::uint64_t overlaps_ = 0;
  std::uint64_t obstacle_overlaps_ = 0;
  double smallest_gap_m_ = 1e3;  // farther than any floor is long
};

}  // namespace stepwright::assemblies
