#include "cell/runtime/fleet_plant.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "cell/runtime/cell_io.h"
#include "supervisor/map/map_file.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::cell_runtime {
namespace {

using fleet::OccupancyGrid;

const std::filesystem::path kCell = STEPWRIGHT_SOURCE_DIR "/tests/cells/fleet/small_hall.toml";

bool in_a_wall(const std::vector<assemblies::BlockParameters>& walls, double x, double y) {
  for (const assemblies::BlockParameters& wall : walls) {
    const bool inside = std::abs(x - wall.pose.position.x) <= 0.5 * wall.rectangle.size.x &&
                        std::abs(y - wall.pose.position.y) <= 0.5 * wall.rectangle.size.y;
    if (inside) return true;
  }
  return false;
}

TEST(FleetPlant, WhenCellsAreBlocked_ThenFewRectanglesCoverThemAndNoOthers) {
  const OccupancyGrid grid = fleet::read_map(kCell.parent_path() / "map.yaml").value();
  const auto walls = walls_of(grid);
  EXPECT_LT(walls.size(), 20U);
  const fleet::GridFrame& frame = grid.frame();
  for (std::int32_t row = -1; row <= frame.rows; ++row) {
    for (std::int32_t column = -1; column <= frame.columns; ++column) {
      const geometry::Point corner = frame.corner({column, row});
      const double half = 0.5 * frame.resolution_m;
      ASSERT_EQ(in_a_wall(walls, corner.x_m + half, corner.y_m + half), grid.blocked({column, row}))
          << column << " " << row;
    }
  }
}

TEST(FleetPlant, WhenTheCellIsRight_ThenItsPlantAndWiresAreMade) {
  const auto config = config::load_cell_config(kCell);
  ASSERT_TRUE(config) << result::to_string(config.error());
  EXPECT_TRUE(check_cell_io(*config).empty()) << result::to_string(check_cell_io(*config));
  const auto parameters = fleet_parameters(config->plant);
  ASSERT_TRUE(parameters);
  ASSERT_EQ(parameters->starts.size(), 3U);
  EXPECT_NEAR(parameters->starts[1].heading_rad, 1.5708, 1e-4);
  EXPECT_EQ(parameters->blockages.size(), 1U);
  EXPECT_EQ(plant_wires(*config).size(), 3U * 13U + 1U);
}

class WrongFleet : public testing::Test {
 protected:
  // The plant table, and what is said about it.
  result::Diagnostics problems_of(const std::string& plant) {
    const std::filesystem::path file = folder_.path() / "cell.toml";
    std::filesystem::copy_file(kCell.parent_path() / "map.yaml", folder_.path() / "map.yaml",
                               std::filesystem::copy_options::overwrite_existing);
    std::filesystem::copy_file(kCell.parent_path() / "map.pgm", folder_.path() / "map.pgm",
                               std::filesystem::copy_options::overwrite_existing);
    std::ofstream(file) << "[plant]\nkind = \"fleet\"\n" << plant;
    auto reading = config::read_cell_config(file);
    if (reading.problems.empty()) return check_cell_io(reading.config);
    return reading.problems;
  }
  void expect(const std::string& plant, const std::string& code, std::uint32_t line) {
    const result::Diagnostics problems = problems_of(plant);
    ASSERT_FALSE(problems.empty()) << plant;
    EXPECT_EQ(problems.front().code, code) << result::to_string(problems);
    EXPECT_EQ(problems.front().where.line, line) << result::to_string(problems);
  }

  support::TemporaryFolder folder_;
};

TEST_F(WrongFleet, WhenAFigureIsWrong_ThenItsKeyIsNamed) {
  expect("", "C0006", 2);
  expect("[[plant.vehicles]]\nx_m = 4.0\n", "C0005", 3);
  expect("[[plant.vehicles]]\nx_m = 4.0\ny_m = 900.0\n", "C0004", 5);
  expect("[[plant.vehicles]]\nx_m = 4.0\ny_m = 4.0\nangle = 3\n", "C0002", 6);
  expect("map = \"none.yaml\"\n[[plant.vehicles]]\nx_m = 4.0\ny_m = 4.0\n", "C0006", 3);
  expect("[[plant.vehicles]]\nx_m = 4.0\ny_m = 4.0\n[plant.ports]\nx_v2 = \"%IW0\"\n", "C0301", 7);
}

TEST_F(WrongFleet, WhenSomethingStandsWhereItCannot_ThenItsPlaceIsNamed) {
  expect("map = \"map.yaml\"\n[[plant.vehicles]]\nx_m = 18.0\ny_m = 8.0\n", "C0322", 4);
  expect("map = \"map.yaml\"\n[[plant.vehicles]]\nx_m = 50.0\ny_m = 8.0\n", "C0322", 4);
  expect("[[plant.vehicles]]\nx_m = 4.0\ny_m = 4.0\n[[plant.vehicles]]\nx_m = 6.0\ny_m = 4.5\n", "C0322", 6);
  expect(
      "map = \"map.yaml\"\n[[plant.vehicles]]\nx_m = 4.0\ny_m = 4.0\n[[plant.pallets]]\nx_m = 10.0\ny_m = "
      "7.2\n",
      "C0322", 7);
}

}  // namespace
}  // namespace stepwright::cell_runtime
