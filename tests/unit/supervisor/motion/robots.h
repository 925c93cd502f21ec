#pragma once

// Robots of the tests: the tree's own one with two arms, and those of others where STEPWRIGHT_DATA has them.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>

#include "supervisor/motion/robot/srdf_reader.h"
#include "supervisor/motion/robot/urdf_reader.h"

namespace stepwright::motion::tests {

inline std::string file_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline std::filesystem::path own_folder() {
  return std::filesystem::path(STEPWRIGHT_SOURCE_DIR) / "tests/cells/robot_cell";
}

// What does not parse fails the test, and gives an empty robot.
inline Robot robot_of(const std::filesystem::path& urdf) {
  auto robot = read_urdf(file_text(urdf), urdf.filename().string());
  EXPECT_TRUE(robot) << to_string(robot.error());
  return robot ? std::move(*robot) : Robot{};
}
inline Semantics semantics_of(const std::filesystem::path& srdf, const Robot& robot) {
  auto semantics = read_srdf(file_text(srdf), srdf.filename().string(), robot);
  EXPECT_TRUE(semantics) << to_string(semantics.error());
  return semantics ? std::move(*semantics) : Semantics{};
}

inline Robot two_arms() {
  return robot_of(own_folder() / "two_arms.urdf");
}
inline Semantics two_arms_semantics(const Robot& robot) {
  return semantics_of(own_folder() / "two_arms.srdf", robot);
}

// Data of others ("arms/panda/..."): nothing where it is not on this machine.
inline std::optional<std::filesystem::path> data_of_others(const std::string& path) {
  const char* given = std::getenv("STEPWRIGHT_DATA");
  const std::filesystem::path folder =
      given ? std::filesystem::path(given) : std::filesystem::path(STEPWRIGHT_SOURCE_DIR) / "../shared/data";
  std::error_code ignored;
  if (!std::filesystem::exists(folder / path, ignored)) return std::nullopt;
  return folder / path;
}

}  // namespace stepwright::motion::tests
