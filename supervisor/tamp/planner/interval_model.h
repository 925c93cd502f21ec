#pragma once

// The cell as intervals see it (supervisor/doc/intervals.md): the reach of its arms at the heights at which
// tools grasp in it, and of each surface the places at which all of a thing lies within it.
//
// Made once for a cell; does not change; any thread. The cell outlives it.

#include <memory>
#include <vector>

#include "supervisor/tamp/intervals/sequence/work_cell.h"
#include "supervisor/tamp/scene/tamp_plan.h"

namespace stepwright::tamp::planner {

class IntervalModel {
 public:
  // Cells of this width. Arms of which no bounds are made reach everywhere.
  explicit IntervalModel(const scene::RobotCell& cell, double cell_m = 0.05);

  const WorkCell& cell() const { return cell_; }
  Action action_of(const scene::ActionSpec& action) const;

 private:
  std::vector<std::unique_ptr<const ReachTable>> reaches_;
  std::vector<std::unique_ptr<const ExactReach>> exacts_;
  WorkCell cell_;
  std::size_t things_ = 0;
  std::vector<bool> turns_;
  std::vector<double> angles_;
};

}  // namespace stepwright::tamp::planner
