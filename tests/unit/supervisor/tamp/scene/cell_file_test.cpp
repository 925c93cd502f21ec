#include "supervisor/tamp/scene/cell_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tests/support/tamp_cells/paper_cells.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::tamp::scene {
namespace {

std::filesystem::path own_folder() {
  return std::filesystem::path(STEPWRIGHT_SOURCE_DIR) / "tests/cells/robot_cell";
}

// P2 with a part of its text replaced, beside the robot's files.
std::string refusal_of(const std::string& part, const std::string& by) {
  const support::TemporaryFolder folder;
  for (const char* name : {"two_arms.urdf", "two_arms.srdf"})
    std::filesystem::copy_file(own_folder() / name, folder.path() / name);
  std::ifstream in(own_folder() / "tamp_p2.toml");
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  text.replace(at, part.size(), by);
  const std::filesystem::path file = folder.path() / "cell.toml";
  std::ofstream(file) << text;
  const auto loaded = load_cell(file);
  return loaded ? "" : result::to_string(loaded.error());
}

TEST(CellFile, WhenTheTreesProblemsAreRead_ThenAllHaveTheirThings) {
  const std::map<std::string, std::size_t> things = {{"p1", 1}, {"p2", 2}, {"p3", 3},
                                                     {"p4", 4}, {"p5", 2}, {"p6", 3}};
  for (const auto& [name, count] : things) {
    const auto problem = tamp::test::paper_problem(name);
    ASSERT_TRUE(problem) << name;
    EXPECT_EQ(problem->cell.things.size(), count);
    EXPECT_EQ(problem->cell.arms.size(), 2u);
  }
}

TEST(CellFile, WhenSomethingIsWrong_ThenItIsSaidWithItsPlace) {
  EXPECT_EQ(refusal_of("grasps = 16", "grasps = 16"), "");
  EXPECT_NE(refusal_of("grasps = 16", "graps = 16").find("G0002"), std::string::npos);
  EXPECT_NE(refusal_of("radius_m = 0.035", "radius_m = \"wide\"").find("G0003"), std::string::npos);
  EXPECT_NE(refusal_of("radius_m = 0.035", "radius_m = -1").find("G0004"), std::string::npos);
  EXPECT_NE(refusal_of("height_m = 0.12\n", "\n").find("G0005"), std::string::npos);
  EXPECT_NE(refusal_of("two_arms.urdf", "no.urdf").find("G0006"), std::string::npos);
  EXPECT_NE(refusal_of("name = \"can2\"", "name = \"can1\"").find("G0101"), std::string::npos);
  const std::string sunk = refusal_of("y_m = -0.48\nz_m = 0.7", "y_m = -0.48\nz_m = 0.67");
  EXPECT_NE(sunk.find("G0102"), std::string::npos) << sunk;
  EXPECT_NE(sunk.find("'can1' overlaps with 'board'"), std::string::npos) << sunk;
  EXPECT_NE(sunk.find("cell.toml:"), std::string::npos) << sunk;
  EXPECT_NE(refusal_of("radius_m = 0.035", "radius_m = 0.05").find("do not go around 'can1'"),
            std::string::npos);
  EXPECT_NE(refusal_of("group = \"left_arm\"", "group = \"left\"").find("G0103"), std::string::npos);
}

}  // namespace
}  // namespace stepwright::tamp::scene
