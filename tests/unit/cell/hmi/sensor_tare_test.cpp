#include "cell/hmi/sensor_tare.h"

#include <gtest/gtest.h>

#include "cell/hmi/plant_picture.h"

namespace stepwright::hmi {
namespace {

TEST(SensorTare, WhenThePlanDocumentHasOne_ThenItIsReadBySensor) {
  const server::Tare tare = tare_of(R"({"phase": "executing", "tare": {"S1": -12.5, "S3": 41, "S2": "no"}})");
  EXPECT_EQ(tare, (server::Tare{{"S1", -12.5}, {"S3", 41.0}}));
}

TEST(SensorTare, WhenTheDocumentIsAnythingElse_ThenThereIsNone) {
  for (const char* text : {"", "{", "[]", "null", "{}", R"({"tare": 3})", R"({"tare": [1, 2]})"}) {
    EXPECT_TRUE(tare_of(text).empty()) << text;
  }
}

TEST(PlantPicture, WhenALevelIsMeasured_ThenItsSourcesNameTheSensor) {
  config::PlantConfig plant;
  plant.ports = {{"S3", "%IW3", {}}};
  const PlantPicture picture = picture_of(plant).value();
  std::size_t measured = 0;
  for (std::size_t i = 0; i < picture.sources.size(); ++i) {
    if (picture.synoptic.points[i].id != "a2.level") continue;
    ASSERT_EQ(picture.sources[i].size(), 2u);
    for (const server::PointSource& source : picture.sources[i]) {
      EXPECT_EQ(source.sensor, "S3");
      ++measured;
    }
  }
  EXPECT_EQ(measured, 2u);
}

TEST(PlantPicture, WhenThePlantIsASortingLine_ThenItsPartsLiveFromTerminalsAndTruths) {
  config::PlantConfig plant;
  plant.kind = "sorting_line";
  plant.ports = {{"belt_r", "%QX0.1", {}}, {"eye_r", "%IX0.1", {}}, {"push_1", "%QX1.0", {}}};
  const PlantPicture picture = picture_of(plant).value();
  const protocol::Synoptic& s = picture.synoptic;
  EXPECT_EQ(picture.sources.size(), s.points.size());
  ASSERT_EQ(s.boxes.size(), 5u);
  EXPECT_EQ(s.belts.size(), 9u);  // six belts, three chutes
  EXPECT_EQ(s.beams.size(), 7u);
  EXPECT_EQ(s.pushers.size(), 4u);
  const auto source_of = [&](const std::string& id) {
    for (std::size_t i = 0; i < s.points.size(); ++i) {
      if (s.points[i].id == id) return picture.sources[i][0];
    }
    return server::PointSource{};
  };
  EXPECT_EQ(source_of(s.belts[1].running_point).name, "%QX0.1");
  EXPECT_EQ(source_of(s.beams[1].dark_point).name, "%IX0.1");
  EXPECT_TRUE(s.belts[0].running_point.empty());  // not wired
  EXPECT_EQ(source_of(s.boxes[2].x_point).name, "box_3_x");
  EXPECT_EQ(source_of(s.pushers[0].travel_point).name, "travel_1");
}

}  // namespace
}  // namespace stepwright::hmi
