#include "cell/missions/tamp/check_cell.h"

#include <gtest/gtest.h>

#include "cell/missions/tamp/arms_wires.h"
#include "supervisor/tamp/scene/cell_file.h"

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
