#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "cell/config/cell_config.h"
#include "cell/hmi/plant_picture.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::hmi {
namespace {

server::PointSource source_of(const PlantPicture& picture, const std::string& id) {
  const auto& points = picture.synoptic.points;
  const auto found = std::ranges::find(points, id, &protocol::Point::id);
  if (found == points.end()) return {};
  return picture.sources[static_cast<std::size_t>(found - points.begin())].at(0);
}

config::PlantConfig two_vehicles() {
  config::PlantConfig plant;
  plant.kind = "fleet";
  plant.fleet.vehicles.resize(2);
  plant.fleet.pallets.resize(1);
  plant.fleet.blockages = {{{20, 12, 90, {}}, 2, 1}};
  return plant;
}

TEST(FloorPicture, WhenACellIsConfigured_ThenItsMapVehiclesAndBlockageAreInIt) {
  const support::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "cell.toml";
  std::ofstream(file)
      << "[plant]\nkind = \"fleet\"\nmap = \"" STEPWRIGHT_SOURCE_DIR
         "/tests/cells/fleet/warehouse.yaml\"\n"
         "[[plant.vehicles]]\nx_m = 3.0\ny_m = 8.0\n[[plant.vehicles]]\nx_m = 3.0\ny_m = 28.0\n"
         "[[plant.blockages]]\nx_m = 20.0\ny_m = 12.0\nlength_m = 2.0\nwidth_m = 2.0\n";
  const auto config = config::load_cell_config(file, {"cell.state_dir=" + folder.path().string()});
  ASSERT_TRUE(config) << result::to_string(config.error());
  const auto picture = picture_of(config->plant);
  ASSERT_TRUE(picture) << result::to_string(picture.error());
  const protocol::Floor& floor = picture->synoptic.floor;
  ASSERT_EQ(floor.maps.size(), 1u);
  EXPECT_EQ(floor.maps[0].columns, 400);
  EXPECT_FALSE(floor.maps[0].outlines.empty());
  ASSERT_EQ(floor.forklifts.size(), 2u);
  EXPECT_EQ(floor.forklifts[1].id, "v2");
  EXPECT_EQ(floor.forklifts[1].wheelbase_m, 1.9);
  ASSERT_EQ(floor.blockages.size(), 1u);  // walls are on the map, not here
  EXPECT_EQ(picture->sources.size(), picture->synoptic.points.size());
}

TEST(FloorPicture, WhenThereAreNoPorts_ThenPointsAreWhereTerminalsAreByDefault) {
  const PlantPicture picture = picture_of(two_vehicles()).value();
  const protocol::Forklift& v2 = picture.synoptic.floor.forklifts.at(1);
  EXPECT_EQ(source_of(picture, v2.x_point).name, "%IW5");
  EXPECT_DOUBLE_EQ(source_of(picture, v2.x_point).factor, 0.01);
  EXPECT_DOUBLE_EQ(source_of(picture, v2.heading_point).factor * 18'000, std::numbers::pi);
  EXPECT_EQ(source_of(picture, v2.bumper_point).name, "%IX21.3");
  EXPECT_EQ(source_of(picture, v2.enable_point).name, "%QX9.0");
  EXPECT_EQ(source_of(picture, v2.true_heading_point).name, "true_heading_v2");
  EXPECT_EQ(source_of(picture, picture.synoptic.floor.estop_ok_point).name, "%IX22.0");
  EXPECT_EQ(source_of(picture, picture.synoptic.floor.pallets.at(0).state_point).name, "state_p1");
  EXPECT_EQ(source_of(picture, picture.synoptic.floor.blockages.at(0).there_point).name, "blocked_1");
  EXPECT_DOUBLE_EQ(picture.synoptic.floor.blockages.at(0).angle_rad * 2, std::numbers::pi);
}

TEST(FloorPicture, WhenATerminalIsNotWired_ThenItsPartHasNoValue) {
  config::PlantConfig plant = two_vehicles();
  plant.ports = {{"x_v1", "%IW40", {}}};
  const PlantPicture picture = picture_of(plant).value();
  EXPECT_EQ(source_of(picture, picture.synoptic.floor.forklifts.at(0).x_point).name, "%IW40");
  EXPECT_EQ(picture.synoptic.floor.forklifts.at(0).y_point, "");
  EXPECT_EQ(picture.synoptic.floor.estop_ok_point, "");
}

TEST(FloorPicture, WhenTheMapCannotBeRead_ThenItSaysWhy) {
  const support::TemporaryFolder folder;
  config::PlantConfig plant = two_vehicles();
  plant.fleet.map = folder.path() / "map.yaml";
  EXPECT_EQ(picture_of(plant).error().front().code, "F0101");
  std::ofstream(plant.fleet.map) << "image: none.pgm\n";
  EXPECT_FALSE(picture_of(plant));
}

}  // namespace
}  // namespace stepwright::hmi
