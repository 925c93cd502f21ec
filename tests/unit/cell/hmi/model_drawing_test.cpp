#include "cell/hmi/model_drawing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <pugixml.hpp>

#include "cell/hmi/plant_picture.h"
#include "hmi_web/drawing/drawing_file.h"

namespace stepwright::hmi {
namespace {

TEST(ModelDrawing, WhenACellHasADescribedPlant_ThenThePageGetsADrawingOfItsComponents) {
  config::PlantConfig plant;
  plant.kind = "model";
  plant.file = STEPWRIGHT_SOURCE_DIR "/tests/cells/bench_model/plant.toml";
  const auto picture = picture_of(plant);
  ASSERT_TRUE(picture) << result::to_string(picture.error());
  const auto drawing = drawing::read_drawing("plant", picture->drawing);
  ASSERT_TRUE(drawing) << result::to_string(drawing.error());
  EXPECT_EQ(picture->sources.size(), picture->synoptic.points.size());
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(picture->drawing.c_str()));
  EXPECT_EQ(document.select_nodes("//rect[@data-fill]").size(), 4u);  // the tanks
  EXPECT_TRUE(document.select_node("//text[@data-text='b1.turning']"));
  EXPECT_EQ(std::string(
                document.select_node("//text[@data-text='a1.level']").node().attribute("data-unit").value()),
            "%");
  // Every binding is to a point that there is, and no two components stand on each other.
  for (const pugi::xpath_node& found : document.select_nodes("//@data-text | //@data-fill | //@data-on")) {
    const std::string point = found.attribute().value();
    EXPECT_NE(std::ranges::find(picture->synoptic.points, point, &protocol::Point::id),
              picture->synoptic.points.end())
        << point;
  }
  std::vector<std::string> places;
  for (const pugi::xpath_node& found : document.select_nodes("//g/rect[not(@data-fill)]"))
    places.push_back(std::string(found.node().attribute("x").value()) + " " +
                     found.node().attribute("y").value());
  std::ranges::sort(places);
  EXPECT_GT(places.size(), 15u);
  EXPECT_EQ(std::ranges::adjacent_find(places), places.end());
}

}  // namespace
}  // namespace stepwright::hmi
