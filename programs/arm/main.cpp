// The process behind `stepwright arm`.

#include <CLI/CLI.hpp>

#include <string>

#include "programs/arm/arm_command.h"
#include "runtime/ground/process/command_line.h"
#include "supervisor/motion/problem/plan_arm.h"

namespace {

using namespace stepwright;

std::string is_file_name(const std::string& text) {
  return text.empty() ? "a file has a name" : "";
}

std::string is_package(const std::string& text) {
  const auto equals = text.find('=');
  return equals == std::string::npos || equals == 0 || equals + 1 == text.size() ? "BEGINNING=FOLDER" : "";
}

// From 2 mm, of which there are many spheres, to half a metre.
std::string is_protrusion(const std::string& text) {
  double value = 0.0;
  return CLI::detail::lexical_cast(text, value) && value >= 0.002 && value <= 0.5
             ? ""
             : "a number from 0.002 to 0.5";
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Plans a path of a robot's arm, and has every motion of it judged by the bodies themselves",
               "stepwright arm");
  arm_program::ArmArguments arguments;
  arguments.planner = motion::kOwnPlanner;
  app.add_option("robot", arguments.urdf, "the robot, URDF (supervisor/doc/motion.md)")->required();
  app.add_option("scene", arguments.scene, "what stands around it: TOML of ours, or a scene of MoveIt (YAML)")
      ->required();
  app.add_option("request", arguments.request, "a request of MoveIt (YAML): group, start, goal")->required();
  app.add_option("--srdf", arguments.srdf, "groups, and pairs of links that are not checked")
      ->check(is_file_name);
  app.add_option("--planner", arguments.planner,
                 "stepwright (default), or a geometric planner of OMPL by its name");
  app.add_option("--seed", arguments.seed, "of the planner's random numbers (default 1)")
      ->check(CLI::Validator(process::refuse_seed, "NUMBER"));
  app.add_option("--time", arguments.time_s, "time budget in seconds (default 10)")
      ->check(CLI::Validator(process::refuse_seconds, "SECONDS"));
  app.add_option("--package", arguments.packages,
                 "where names of meshes that begin so are: package://NAME=FOLDER (may be given again)")
      ->allow_extra_args(false)
      ->check(is_package);
  app.add_option("--instead", arguments.instead,
                 "another URDF of the robot, whose bodies stand for meshes that are not found")
      ->check(is_file_name);
  app.add_option("--protrusion", arguments.protrusion_m,
                 "how far in metres the spheres of the fast checks may stand out of bodies (default 0.015)")
      ->check(CLI::Validator(is_protrusion, "METRES"));
  app.add_option("--json", arguments.json_file, "write path and figures as JSON")->check(is_file_name);
  app.add_option("--svg", arguments.svg_file, "draw the path from the side and from above")
      ->check(is_file_name);
  app.footer(
      "Exit codes: 0 a path was found and judged, 1 wrong input, 2 wrong usage, 3 start or goal cannot be "
      "(the "
      "cause is said), 4 the budget ended, or Ctrl-C or SIGTERM came, before there was a path.");
  if (const auto exit = process::parse(app, argc, argv)) return *exit;
  return result::to_int(arm_program::run_arm(arguments));
}
