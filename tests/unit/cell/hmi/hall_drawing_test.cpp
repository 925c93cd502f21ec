#include "cell/hmi/hall_drawing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <pugixml.hpp>

#include "cell/hmi/plant_picture.h"
#include "hmi_web/drawing/drawing_file.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::hmi {
namespace {

config::PlantConfig tugger(std::size_t trailers) {
  config::PlantConfig plant;
  plant.kind = "tugger";
  plant.tugger.scene = STEPWRIGHT_SOURCE_DIR "/tests/cells/ltl/blocks.geojson";
  plant.tugger.trailers = trailers;
  plant.tugger.most_trailers = trailers;
  plant.tugger.blockages = {{{1, 2, 30, {}}, 2, 1}};
  return plant;
}

server::PointSource source_of_point(const PlantPicture& picture, const std::string& id) {
  const auto found = std::ranges::find(picture.synoptic.points, id, &protocol::Point::id);
  if (found == picture.synoptic.points.end()) return {};
  return picture.sources[static_cast<std::size_t>(found - picture.synoptic.points.begin())].at(0);
}

TEST(HallDrawing, WhenACellHasATrain_ThenThePageGetsADrawingThatItTakes) {
  const auto picture = picture_of(tugger(3));
  ASSERT_TRUE(picture) << result::to_string(picture.error());
  const auto drawing = drawing::read_drawing("hall", picture->drawing);
  ASSERT_TRUE(drawing) << result::to_string(drawing.error());
  EXPECT_GT(drawing->bindings, 3u * 4u);
  EXPECT_EQ(picture->sources.size(), picture->synoptic.points.size());
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(picture->drawing.c_str()));
  EXPECT_EQ(document.select_nodes("//g[@data-pose-x]").size(), 4u);
  // Every binding is to a point that there is.
  for (const pugi::xpath_node& found : document.select_nodes("//@*[starts-with(name(), 'data-')]")) {
    const std::string name = found.attribute().name();
    const std::string point = found.attribute().value();
    if (name.starts_with("data-floor")) continue;
    EXPECT_FALSE(source_of_point(*picture, point).name.empty()) << name << " " << point;
  }
}

TEST(HallDrawing, WhenThereAreNoPorts_ThenPointsAreWhereTerminalsAreByDefault) {
  const PlantPicture picture = picture_of(tugger(3)).value();
  EXPECT_EQ(source_of_point(picture, "tractor.x").name, "%IW0");
  EXPECT_DOUBLE_EQ(source_of_point(picture, "tractor.x").factor, 0.01);
  EXPECT_EQ(source_of_point(picture, "tractor.heading").name, "%IW2");
  EXPECT_EQ(source_of_point(picture, "tractor.bumper").name, "%IX18.0");
  EXPECT_EQ(source_of_point(picture, "trailer_2.x").name, "true_x_2");
  EXPECT_EQ(source_of_point(picture, "block_1").name, "blocked_1");
  EXPECT_EQ(source_of_point(picture, "place_1").name, "%IX19.0");
  EXPECT_EQ(source_of_point(picture, picture.synoptic.floor.estop_ok_point).name, "%IX18.1");
}

TEST(HallDrawing, WhenTerminalsAreNotWired_ThenTheTractorStandsStill) {
  config::PlantConfig plant = tugger(1);
  plant.ports = {{"x", "%IW40", {}}};
  const PlantPicture picture = picture_of(plant).value();
  EXPECT_TRUE(drawing::read_drawing("hall", picture.drawing));
  EXPECT_EQ(picture.drawing.find("tractor.x\""), std::string::npos);
  EXPECT_EQ(picture.synoptic.floor.estop_ok_point, "");
}

TEST(HallDrawing, WhenTheSceneCannotBeRead_ThenItSaysWhy) {
  const support::TemporaryFolder folder;
  config::PlantConfig plant = tugger(1);
  plant.tugger.scene = folder.path() / "none.geojson";
  EXPECT_EQ(picture_of(plant).error().front().code, "E0001");
}

}  // namespace
}  // namespace stepwright::hmi
