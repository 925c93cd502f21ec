#include "plant_models/core/plant_description.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace stepwright::core {
namespace {

TEST(PlantDescription, WhenWrittenAsJson_ThenEveryPartIsThere) {
  PlantDescription d;
  d.name = "cell \"1\"";
  d.tanks = {{"a1", "Distributor", 3.0, 100.0, -1.0, "", "level_a1_percent", "S2"}};
  d.pumps = {{"b1", "B1", "speed_b1", "flow_b1"}};
  d.pipes = {{"f1", "v1", "b1", "f1"}};
  d.vehicles = {{"v1", "position", "speed", "l", "r", -1.05, 1.05, {{"f1", 0.0, 0.03, "fc1"}}}};
  d.sensors = {{"S2", "percent", "level_a1_percent", -9.3, 37.25}};
  d.regions = {{"dock", RegionKind::Place, {0.0, 1.0, 1.0}, {0.0, 0.0, 1.5}, "at_dock"}};
  d.links = {{"tractor", 0.9, 0.5, "true_x", "true_y", "true_heading", ""}};

  const auto json = nlohmann::json::parse(to_json(d));
  EXPECT_EQ(json["name"], "cell \"1\"");
  EXPECT_EQ(json["tanks"][0]["position"], -1.0);
  EXPECT_EQ(json["pumps"][0]["flow_truth"], "flow_b1");
  EXPECT_EQ(json["pipes"][0]["at_place"], "f1");
  EXPECT_EQ(json["vehicles"][0]["places"][0]["switch_sensor"], "fc1");
  EXPECT_EQ(json["sensors"][0]["counts_per_unit"], 37.25);
  EXPECT_EQ(json["regions"][0]["kind"], "place");
  EXPECT_EQ(json["regions"][0]["y"][2], 1.5);
  EXPECT_EQ(json["links"][0]["heading_truth"], "true_heading");
}

}  // namespace
}  // namespace stepwright::core
