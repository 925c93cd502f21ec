#pragma once

// The samples of geometric choices: van der Corput's sequence for angles, Halton's for places
// (supervisor/geometry/radical_inverse.h), as Karlsson et al. 2012 take them. Pure functions; any thread.

#include <cstddef>

#include "supervisor/tamp/scene/geometric_state.h"
#include "supervisor/tamp/scene/robot_cell.h"

namespace stepwright::tamp::predicates {

// Of the hand's angle, seen from what it grasps: base 2 over a whole turn.
double grasp_sample(std::size_t k);
// Of a place on a surface: bases 2 and 3 over the places at which all of the thing lies within it; of a thing
// that turns also its angle, base 5.
scene::Pose place_sample(const scene::Surface& surface, const scene::Thing& thing, std::size_t k);
// On a thing: over its middle, of a thing that turns with an angle, base 5.
scene::Pose stack_sample(const scene::RobotCell& cell, int carrier, int thing,
                         const scene::GeometricState& state, std::size_t k);
// A place in the surface's own frame, from its middle.
scene::Pose place_on(const scene::Surface& surface, double along_m, double across_m, double angle_rad);

}  // namespace stepwright::tamp::predicates
