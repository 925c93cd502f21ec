#include "cell/hmi/terminal_drawing.h"

#include <gtest/gtest.h>

#include "cell/hmi/plant_picture.h"
#include "hmi_web/drawing/drawing_file.h"

namespace stepwright::hmi {
namespace {

config::PlantConfig plant_of(std::size_t sensors) {
  config::PlantConfig plant;
  plant.kind = "shared";
  plant.stepped.actuators = {
      {.name = "valve <A&B>", .address = "%QX0.0", .is_switch = true},
      {.name = "speed", .address = "%QW1", .at_zero = 1.0, .per_count = 0.5, .unit = "m/s"}};
  for (std::size_t i = 0; i < sensors; ++i) {
    plant.stepped.sensors.push_back(
        {.name = "level" + std::to_string(i), .address = "%IW" + std::to_string(i), .unit = "m"});
  }
  plant.stepped.values = {{"volume", "l"}};
  for (const auto* list : {&plant.stepped.actuators, &plant.stepped.sensors}) {
    for (const auto& each : *list) plant.ports.push_back({each.name, each.address, {}});
  }
  return plant;
}

TEST(TerminalDrawing, WhenAPlantRunsInAProcessOfItsOwn_ThenItsPictureIsADrawingOfItsTerminals) {
  const PlantPicture picture = picture_of(plant_of(2)).value();
  const auto drawn = drawing::read_drawing("picture", picture.drawing);
  ASSERT_TRUE(drawn) << result::to_string(drawn.error());
  EXPECT_NE(drawn->svg.find("valve &lt;A&amp;B&gt;"), std::string::npos) << drawn->svg;
  ASSERT_EQ(picture.synoptic.points.size(), 5u);
  EXPECT_EQ(picture.synoptic.points[1].id, "speed");
  EXPECT_EQ(picture.sources[1][0].factor, 0.5);
  EXPECT_EQ(picture.sources[1][0].offset, 1.0);
  EXPECT_EQ(picture.sources[2][0].kind, server::PointSourceKind::PlantTruth);
  EXPECT_EQ(picture.synoptic.points[4].unit, "l");
}

TEST(TerminalDrawing, WhenThereAreMoreTerminalsThanItDraws_ThenItSaysHowMany) {
  const PlantPicture picture = picture_of(plant_of(100)).value();
  ASSERT_TRUE(drawing::read_drawing("picture", picture.drawing));
  EXPECT_NE(picture.drawing.find("+ 61"), std::string::npos);
  EXPECT_EQ(picture.synoptic.points.size(), 103u);
}

}  // namespace
}  // namespace stepwright::hmi
