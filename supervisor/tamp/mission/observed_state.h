#pragma once

// Estimate of the cell's state before a plan is made: joints as measured, things as the camera has them, what
// hands hold by what they feel and by what is seen between their fingers.
//
// Pure functions; any thread.
//
//   const Observed seen = observe(cell, reading, agree(cell, reports, believed), held);
//   if (!seen.wrong.empty()) ...   // "cup1 is not seen"

#include <string>
#include <vector>

#include "supervisor/tamp/mission/arms_reading.h"
#include "supervisor/tamp/mission/sight.h"
#include "supervisor/tamp/scene/geometric_state.h"

namespace stepwright::tamp::mission {

struct Observed {
  scene::GeometricState state;
  std::string wrong;  // why nothing can be planned from it; empty: it can
};

// `held`: the thing that each arm was believed to hold; -1: nothing.
Observed observe(const scene::RobotCell& cell, const ArmsReading& reading, const Sight& sight,
                 const std::vector<int>& held);

// Where the tool of an arm is.
motion::Transform tool_of(const scene::ArmModel& arm, const scene::JointValues& joints);

}  // namespace stepwright::tamp::mission
