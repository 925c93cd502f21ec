#include "programs/hmi/sensor_tare.h"

#include <gtest/gtest.h>

#include "programs/hmi/plant_picture.h"

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
  const PlantPicture picture = picture_of(plant);
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

}  // namespace
}  // namespace stepwright::hmi
