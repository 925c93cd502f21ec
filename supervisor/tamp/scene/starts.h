#pragma once

// Where the things of a cell stand at first: in each other, or on nothing. Functions without state; any
// thread.

#include <string>
#include <vector>

#include "supervisor/tamp/scene/robot_cell.h"

namespace stepwright::tamp::scene {

struct StartOverlap {
  std::size_t thing = 0;
  std::string other;  // furniture, or a thing of a lesser number
};

std::vector<StartOverlap> overlaps_of(const RobotCell& cell);

// By how much the thing's underside is above what is next below it, or the floor; infinite where there is
// nothing.
double above_ground_m(const RobotCell& cell, std::size_t thing);

// Whether its middle is on the surface or thing of that name.
bool starts_on(const RobotCell& cell, std::size_t thing, const std::string& place);

}  // namespace stepwright::tamp::scene
