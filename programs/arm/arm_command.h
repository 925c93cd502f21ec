#pragma once

// `stepwright arm ROBOT.urdf SCENE REQUEST [--srdf F] [--planner NAME] [--seed N] [--time S] [--json F]
// [--svg F]`: a free path of an arm, every motion of it judged by the bodies themselves.

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/ground/result/exit_code.h"

namespace stepwright::arm_program {

struct ArmArguments {
  std::string urdf, scene, request;
  std::string srdf;                   // empty: none
  std::string instead;                // empty: none; bodies for meshes that are not found
  std::vector<std::string> packages;  // BEGINNING=FOLDER
  std::string planner;
  std::uint64_t seed = 1;
  double time_s = 10.0;
  double protrusion_m = 0.015;
  std::string json_file, svg_file;  // empty: none
};

// NoPlan: an end collides or is beyond a limit. BudgetExhausted: no path was found.
result::ExitCode run_arm(const ArmArguments& arguments);

}  // namespace stepwright::arm_program
