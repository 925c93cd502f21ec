#include "cell/hmi/model_drawing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <pugixml.hpp>
#include <string>
#include <utility>
#include <vector>

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
  EXPECT_TRUE(document.select_node("//g[title='a1 (tank)']/g/path")) << "has its symbol";
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

// x and y of the corners of a path of M, H and V.
std::vector<std::pair<double, double>> corners(const std::string& path) {
  std::vector<std::pair<double, double>> found;
  double x = 0.0, y = 0.0;
  for (std::size_t at = 0; at < path.size();) {
    const char letter = path[at];
    char* end = nullptr;
    double value = std::strtod(path.c_str() + at + 1, &end);
    (letter == 'V' ? y : x) = value;
    if (letter == 'M') y = std::strtod(end, &end);
    found.emplace_back(x, y);
    at = static_cast<std::size_t>(end - path.c_str());
  }
  return found;
}

TEST(ModelDrawing, WhenALineLeadsPastOtherComponents_ThenItDoesNotRunBehindThem) {
  for (const char* cell : {"bench_model", "batch_mixer", "pump_station", "pick_place"}) {
    config::PlantConfig plant;
    plant.kind = "model";
    plant.file = STEPWRIGHT_SOURCE_DIR "/tests/cells/" + std::string(cell) + "/plant.toml";
    const auto picture = picture_of(plant);
    ASSERT_TRUE(picture) << result::to_string(picture.error());
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(picture->drawing.c_str()));
    int lines = 0;
    for (const pugi::xpath_node& line : document.select_nodes("/svg/path")) {
      const auto path = corners(line.node().attribute("d").value());
      ASSERT_GE(path.size(), 2u);
      ++lines;
      for (std::size_t i = 1; i < path.size(); ++i) {
        const auto [x0, x1] = std::minmax(path[i - 1].first, path[i].first);
        const auto [y0, y1] = std::minmax(path[i - 1].second, path[i].second);
        for (const pugi::xpath_node& box : document.select_nodes("//g/rect[not(@data-fill)]")) {
          const double left = box.node().attribute("x").as_double();
          const double top = box.node().attribute("y").as_double();
          const double wide = box.node().attribute("width").as_double();
          const double high = box.node().attribute("height").as_double();
          const bool behind =
              x1 > left + 1.0 && x0 < left + wide - 1.0 && y1 > top + 1.0 && y0 < top + high - 1.0;
          EXPECT_FALSE(behind) << cell << ": " << line.node().attribute("d").value();
        }
      }
    }
    EXPECT_GT(lines, 5);
  }
}

}  // namespace
}  // namespace stepwright::hmi
