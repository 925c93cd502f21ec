#include "cell/missions/tamp/check_cell.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "cell/missions/mission_kinds.h"
#include "cell/missions/tamp/arms_wires.h"
#include "supervisor/tamp/scene/cell_file.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::missions {
namespace {

const config::CellConfig& cell() {
  static const config::CellConfig loaded =
      config::load_cell_config(STEPWRIGHT_SOURCE_DIR "/tests/cells/robot_cell/cell.toml").value();
  return loaded;
}

const tamp::scene::RobotCell& scene() {
  static const tamp::scene::RobotCell loaded =
      tamp::scene::load_cell(STEPWRIGHT_SOURCE_DIR "/tests/cells/robot_cell/orders.toml").value().cell;
  return loaded;
}

TEST(ArmsCellCheck, WhenPlantAndProblemAreOneCell_ThenNothingIsWrong) {
  const auto good = check_agrees(cell().plant, scene(), {});
  EXPECT_TRUE(good) << result::to_string(good.error());
}

TEST(ArmsCellCheck, WhenTheyDiffer_ThenThatIsToldAtItsPlace) {
  const auto code = [](const config::PlantConfig& plant) {
    const auto good = check_agrees(plant, scene(), {});
    return good ? std::string() : good.error().front().code;
  };
  config::PlantConfig plant = cell().plant;
  plant.robot_cell.fixed[1].height_m += 0.01;
  EXPECT_EQ(code(plant), "G0403");
  plant = cell().plant;
  plant.robot_cell.objects.pop_back();
  EXPECT_EQ(code(plant), "G0403");
  plant = cell().plant;
  plant.robot_cell.objects[0].kind = "can";
  EXPECT_EQ(code(plant), "G0403");
  plant = cell().plant;
  plant.robot_cell.blockages[0].height_m = 1.0;
  EXPECT_EQ(code(plant), "G0403");
  plant = cell().plant;
  std::swap(plant.robot_cell.arms[0], plant.robot_cell.arms[1]);
  const auto swapped = check_agrees(plant, scene(), {});
  ASSERT_FALSE(swapped);
  EXPECT_GT(swapped.error().front().where.line, 0u);
}

// The cell of the tests, with a cup that hangs 50 mm above the table in its problem.
config::CellConfig hanging(const support::TemporaryFolder& folder) {
  std::filesystem::copy(STEPWRIGHT_SOURCE_DIR "/tests/cells/robot_cell", folder.path());
  std::stringstream text;
  text << std::ifstream(folder / "orders.toml").rdbuf();
  std::string problem = text.str();
  const std::string floor = "z_m = 0.7\n";
  problem.replace(problem.find(floor, problem.find("name = \"cup2\"")), floor.size(), "z_m = 0.75\n");
  std::ofstream(folder / "orders.toml") << problem;
  return config::load_cell_config((folder / "cell.toml").string()).value();
}

TEST(ArmsCellCheck, WhenAThingHangsInTheAirAtFirst_ThenTheFirstPlanWarnsOfIt) {
  const support::TemporaryFolder folder;
  const auto planner = open(hanging(folder));
  ASSERT_TRUE(planner) << result::to_string(planner.error());
  const auto first = (*planner)->first_plan();
  ASSERT_TRUE(first) << result::to_string(first.error());
  ASSERT_EQ(first->warnings.size(), 1u);
  EXPECT_EQ(first->warnings.front().code, "G0106");
  EXPECT_GT(first->warnings.front().where.line, 0u);
}

TEST(ArmsWires, WhenThereAreNoPorts_ThenTerminalsAreWhereTheSimulatedCellHasThem) {
  const auto row = terminals_of(cell(), scene());
  ASSERT_TRUE(row);
  const config::RobotCellPlantConfig& plant = cell().plant.robot_cell;
  ASSERT_EQ(row->slots.size(), plant.objects.size() + plant.blockages.size() + 2);
  EXPECT_EQ(row->arms[1].pos[0], "%IW8");
}

TEST(ArmsWires, WhenAPortIsMissing_ThenItIsNamed) {
  config::CellConfig named = cell();
  named.plant.ports.push_back({"estop_ok", "%IX0.0", {}});
  const auto wrong = terminals_of(named, scene());
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().front().code, "C0541");
}

}  // namespace
}  // namespace stepwright::missions
