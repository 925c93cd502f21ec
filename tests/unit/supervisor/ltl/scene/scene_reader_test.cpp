#include "supervisor/ltl/scene/scene_reader.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <random>

namespace stepwright::ltl {
namespace {

std::string feature(const std::string& kind, const std::string& name, const std::string& points) {
  return R"({"type": "Feature", "properties": {"kind": ")" + kind + R"(", "name": ")" + name +
         R"("}, "geometry": {"type": "Polygon", "coordinates": [[)" + points + "]]}}";
}
std::string scene(const std::string& features) {
  return R"({"type": "FeatureCollection", "features": [)" + features + "]}";
}
const std::string kBorder = feature("border", "", "[0,0],[9,0],[9,9],[0,9],[0,0]");

// "CODE message" of each error.
std::vector<std::string> scene_errors(const std::string& text) {
  const auto floor = read_scene(text, "hall.geojson");
  std::vector<std::string> found;
  if (floor) return found;
  for (const auto& each : floor.error()) {
    EXPECT_EQ(each.where.file, "hall.geojson");
    found.push_back(each.code + " " + each.message);
  }
  return found;
}

TEST(SceneReader, WhenASceneIsSound_ThenItsPolygonsAreTheFloor) {
  const auto floor = read_scene(scene(kBorder + "," + feature("obstacle", "post", "[1,1],[2,1],[1,2],[1,1]") +
                                      "," + feature("proposition", "press", "[4,4],[5,4,0.5],[5,5],[4,4]")),
                                "hall.geojson");
  ASSERT_TRUE(floor) << to_string(floor.error());
  EXPECT_EQ(floor->border.ring.size(), 4u);
  ASSERT_EQ(floor->obstacles.size(), 1u);
  EXPECT_EQ(floor->obstacles[0].name, "post");
  ASSERT_EQ(floor->propositions.size(), 1u);
  EXPECT_EQ(floor->propositions[0].ring[1], (geometry::Point{5, 4}));
}

TEST(SceneReader, WhenItIsNoJson_ThenTheErrorHasItsLineAndColumn) {
  const auto floor = read_scene("{\"features\":\n [1,]}", "hall.geojson");
  ASSERT_FALSE(floor);
  EXPECT_EQ(floor.error()[0].code, "L0401");
  EXPECT_EQ(floor.error()[0].where.line, 2u);
  EXPECT_EQ(floor.error()[0].where.column, 5u);
  EXPECT_EQ(read_scene("", "x").error()[0].code, "L0401");
  EXPECT_EQ(read_scene("[1e999]", "x").error()[0].code, "L0403");
}

TEST(SceneReader, WhenMembersAreWrong_ThenAllOfThemAreToldWithTheirPlace) {
  using Texts = std::vector<std::string>;
  EXPECT_EQ(scene_errors("[]"), Texts{"L0402 features: is missing or no list"});
  EXPECT_EQ(scene_errors(R"({"type": "FeatureCollection", "features": {}})"),
            Texts{"L0402 features: is missing or no list"});
  EXPECT_EQ(scene_errors(R"({"type": "Feature", "features": []})"),
            Texts{"L0402 type: is missing or not \"FeatureCollection\""});
  EXPECT_EQ(scene_errors(scene(R"({"type": "feature", "properties": {"kind": "border"}})")),
            Texts{"L0402 features[0].type: is missing or not \"Feature\""});
  EXPECT_EQ(scene_errors(scene("")), Texts{"L0402 features: there is no border"});
  EXPECT_EQ(scene_errors(scene("1," + kBorder + "," + kBorder)),
            (Texts{"L0402 features[0].type: is missing or not \"Feature\"",
                   "L0405 features[2]: is a second border"}));
  EXPECT_EQ(scene_errors(scene(feature("shelf", "", "[0,0],[1,0],[1,1],[0,0]"))),
            Texts{"L0402 features[0].properties.kind: is none of border, obstacle, proposition"});
  EXPECT_EQ(scene_errors(scene(kBorder + "," + feature("proposition", "", "[0,0],[1,0],[1,1],[0,0]"))),
            Texts{"L0402 features[1].properties.name: is missing"});
}

TEST(SceneReader, WhenPolygonsAreWrong_ThenAllOfThemAreToldWithTheirPlace) {
  using Texts = std::vector<std::string>;
  const std::string at = "features[1].geometry.coordinates";
  const auto wrong = [](const std::string& points) {
    return scene_errors(scene(kBorder + "," + feature("obstacle", "", points)));
  };
  EXPECT_EQ(wrong("[0,0],[1,0],[1,1],[0,1]"), Texts{"L0404 " + at + ": the polygon is open"});
  EXPECT_EQ(wrong("[0,0],[1,0],[0,0]"), Texts{"L0201 " + at + ": the polygon has fewer than three points"});
  EXPECT_EQ(wrong(""), Texts{"L0404 " + at + ": the polygon is open"});
  EXPECT_EQ(wrong("[0,0],[1]"), Texts{"L0402 " + at + "[0][1]: is no point"});
  EXPECT_EQ(wrong("[0,0],[1,\"2\"]"), Texts{"L0402 " + at + "[0][1][1]: is no number"});
  EXPECT_EQ(wrong("[0,0],[1e7,2]"), Texts{"L0403 " + at + "[0][1][0]: is out of range"});
  EXPECT_EQ(scene_errors(scene(kBorder + "," + feature("proposition", "a", "[0,0],[1,0],[1,1],[0,0]") + "," +
                               feature("proposition", "a", "[0,0],[1,0],[1,1],[0,0]"))),
            Texts{"L0405 features[2]: the place 'a' is there twice"});
}

TEST(SceneReader, WhenAMemberIsThereTwice_ThenTheSecondIsTold) {
  const auto twice =
      read_scene("{\"type\": \"FeatureCollection\",\n \"features\": [], \"features\" : []}", "x");
  ASSERT_FALSE(twice);
  EXPECT_EQ(twice.error()[0].where.line, 2u);
  EXPECT_EQ(twice.error()[0].where.column, 18u);
  EXPECT_EQ(twice.error()[0].code, "L0405");
  EXPECT_EQ(twice.error()[0].message, "the member \"features\" is there twice");
  EXPECT_EQ(
      scene_errors(scene(R"({"type": "Feature", "properties": {"kind": "border", "kind": "obstacle"}})")),
      std::vector<std::string>{"L0405 the member \"kind\" is there twice"});
  // Names as values, in other objects and within texts are none.
  EXPECT_TRUE(read_scene(scene(feature("border", "a\\\":{\\\"", "[0,0],[9,0],[9,9],[0,0]")), "x"));
}

TEST(SceneReader, WhenJsonIsNestedDeeply_ThenItDoesNotRecurse) {
  const std::string deep = std::string(200'000, '[') + std::string(200'000, ']');
  EXPECT_FALSE(scene_errors(scene(R"({"type": "Feature", "properties": {"kind": )" + deep + "}}")).empty());
  EXPECT_FALSE(
      scene_errors(scene(R"({"type": "Feature", "properties": {"kind": "border"}, "geometry": {"type": )"
                         R"("Polygon", "coordinates": )" +
                         deep + "}}"))
          .empty());
}

TEST(SceneReader, WhenTheTextIsBroken_ThenItIsRefusedOrRead) {
  std::ifstream in(std::string(STEPWRIGHT_SOURCE_DIR) + "/tests/cells/ltl/walls.geojson");
  const std::string sound{std::istreambuf_iterator<char>(in), {}};
  ASSERT_TRUE(read_scene(sound, "walls.geojson"));
  std::mt19937 dice(8);
  const std::string marks = "{}[],:\"0-e. nul";
  int refused = 0;
  for (int round = 0; round < 1000; ++round) {
    std::string text = sound;
    for (std::uint32_t k = 0; k <= dice() % 3; ++k) {
      const std::size_t at = dice() % text.size();
      if (dice() % 2 == 0)
        text[at] = marks[dice() % marks.size()];
      else
        text.erase(at, 1 + dice() % 30);
    }
    const auto floor = read_scene(text, "walls.geojson");
    if (floor) continue;
    ++refused;
    EXPECT_FALSE(floor.error().empty());
  }
  EXPECT_GT(refused, 300);
}

}  // namespace
}  // namespace stepwright::ltl
