#pragma once

// Flattens a robot, its spheres and the world for checks of a few coordinates. Internal to this folder.

#include <span>

#include "supervisor/motion/collision/internal/program.h"
#include "supervisor/motion/collision/world.h"
#include "supervisor/motion/robot/semantics.h"
#include "supervisor/motion/spheres/sphere_model.h"

namespace stepwright::motion::internal {

Program make_program(const Robot& robot, const SphereModel& spheres, const Semantics& semantics,
                     const World& world, std::span<const int> coordinates, std::span<const double> rest,
                     double rounding_m);

}  // namespace stepwright::motion::internal
