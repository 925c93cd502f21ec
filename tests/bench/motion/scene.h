#pragma once

// The scene that arms are measured in: the robot with two arms at a table with things on it.

#include <filesystem>
#include <string>
#include <vector>

#include "supervisor/motion/collision/collision_checker.h"
#include "supervisor/motion/recheck/exact_checker.h"

namespace stepwright::bench {

struct MotionScene {
  motion::Robot robot;
  motion::Semantics semantics;
  motion::Bodies bodies;
  motion::SphereModel spheres;
  motion::World world;
  std::vector<int> coordinates;  // of the right arm
  std::vector<double> rest;
};

std::string text_of(const std::filesystem::path& path);

// Throws std::runtime_error where the files of the robot are not in `folder`.
MotionScene motion_scene(const std::string& folder);

}  // namespace stepwright::bench
