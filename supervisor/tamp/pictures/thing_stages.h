#pragma once

// Where things are while a schedule is driven: which hand carries them from which progress of its arm on, and
// where it puts them. Detail of this folder; a pure function.

#include <vector>

#include "supervisor/tamp/pictures/arms_picture.h"
#include "supervisor/tamp/scene/geometric_state.h"
#include "supervisor/tamp/schedule/arm_schedule.h"

namespace stepwright::tamp::pictures {

PicturePlace drawn(const motion::Transform& place);

// By thing. Frames of the picture are the robot's links. `schedule` may be null: they stay where they are.
std::vector<std::vector<ArmsPicture::Stage>> thing_stages(const scene::RobotCell& cell,
                                                          const scene::GeometricState& start,
                                                          const schedule::CellSchedule* schedule);

}  // namespace stepwright::tamp::pictures
