#pragma once

// Test of capsules that are to contain the bodies of an arm: points of the bodies, drawn at random, where
// joints and fingers are drawn at random. A function without state; any thread.
//
//   motion::Random random(3);
//   EXPECT_LE(farthest_outside(cell, arm, model, random, {.places = 12, .points = 20}), 1e-9);

#include <cstddef>

#include "supervisor/motion/spatial/random.h"
#include "supervisor/tamp/scene/robot_cell.h"
#include "supervisor/tamp/schedule/arm_capsules.h"

namespace stepwright::tamp::test {

struct PointsToDraw {
  int places = 12;  // of joints and fingers, within their limits
  int points = 20;  // of each body at each place
};

// How far the worst point is outside of all capsules; below zero: all are inside.
double farthest_outside(const scene::RobotCell& cell, std::size_t arm, const schedule::ArmCapsules& model,
                        motion::Random& random, const PointsToDraw& draw);

}  // namespace stepwright::tamp::test
