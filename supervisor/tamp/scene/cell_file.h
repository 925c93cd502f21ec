#pragma once

// A cell and its problem as a TOML file (supervisor/doc/tamp.md, The file): the robot's files, the HDDL
// domain and problem, furniture, surfaces and things. Names of files are relative to it.
//
// A function without state; any thread. The file is not trusted; all that is wrong with it is said at once.
//
//   auto file = load_cell("p1.toml");
//   if (!file) print(to_string(file.error()));

#include <filesystem>
#include <string>

#include "runtime/ground/result/result.h"
#include "supervisor/tamp/scene/robot_cell.h"

namespace stepwright::tamp::scene {

struct CellFile {
  RobotCell cell;
  std::filesystem::path domain, problem;  // HDDL
  result::Diagnostics warnings;           // G0106: a thing that hangs in the air
};

// G0001 to G0006: the file itself (no TOML, unknown key, wrong type, out of range, missing, rejected); G0101:
// a name twice; G0102: things that overlap with each other or with furniture; G0103 of add_arms(); A0101 to
// A0111: what is wrong with the robot.
[[nodiscard]] result::Result<CellFile> load_cell(const std::filesystem::path& file);

}  // namespace stepwright::tamp::scene
