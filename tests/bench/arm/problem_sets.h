#pragma once

// Robots and planning problems: those of MotionBenchMaker (Chamzas and others 2022) where the data of others
// is on this machine, and some of our own where it is not.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "supervisor/motion/problem/arm_problem.h"

namespace stepwright::bench {

struct ProblemSet {
  std::string name;
  motion::ArmModel model;
  std::vector<motion::ArmProblem> problems;
  std::vector<std::string> names;  // of the problems
  // What spheres look at, made once for all: the robot's rest does not change between problems.
  motion::FalsePairs pairs;
};

// The folder of the data of others: STEPWRIGHT_DATA, else beside the tree. Nothing where it is not.
std::optional<std::filesystem::path> arms_folder();

// The first `per_scenario` problems of each scenario, of "panda" or "ur5". Unpacked beside others' temporary
// files, which are removed again. Throws std::runtime_error where a file is wrong.
ProblemSet problems_of_others(const std::filesystem::path& arms, const std::string& robot,
                              std::size_t per_scenario, double protrusion_m);

// The right arm of our own robot at its table, from home to free configurations that are drawn.
ProblemSet problems_of_our_own(std::size_t count, double protrusion_m);

}  // namespace stepwright::bench
