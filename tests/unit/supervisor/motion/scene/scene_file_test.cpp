#include "supervisor/motion/scene/scene_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <random>

namespace stepwright::motion {
namespace {

namespace fs = std::filesystem;

const std::string kCell = R"([[box]]
name = "table"
at_m = [0.6, 0, 0.68]
size_m = [0.8, 1.4, 0.04]

[[cylinder]]
name = "can"
at_m = [0.6, 0.2, 0.76]
turn_deg = [0, 90, 0]
radius_m = 0.03
length_m = 0.12

[[sphere]]
name = "ball"
at_m = [0, 0, 2]
radius_m = 0.1

[[mesh]]
name = "pyramid"
file = "pyramid.obj"
at_m = [0, 1, 0]
quaternion = [0, 0, 0.70710678, 0.70710678]
scale = 0.001

[[allowed]]
link = "hand"
thing = "can"
)";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  EXPECT_NE(text.find(what), std::string::npos) << what;
  return text.replace(text.find(what), what.size(), by);
}

class SceneFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_);
    std::ofstream(folder_ / "pyramid.obj")
        << "v 0 0 0\nv 200 0 0\nv 0 100 0\nv 0 0 300\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  }
  void TearDown() override { fs::remove_all(folder_); }

  result::Result<SceneFile> read(const std::string& text) const {
    return read_scene(text, "f.toml", folder_);
  }
  std::string wrong(const std::string& what, const std::string& by) const {
    const auto scene = read(replaced(kCell, what, by));
    if (scene) return "none";
    const auto& first = scene.error().front();
    return std::to_string(first.where.line) + " " + first.code;
  }

  fs::path folder_ = fs::temp_directory_path() / ("stepwright_scene_files_" + std::to_string(getpid()));
};

TEST_F(SceneFiles, WhenItIsSound_ThenThingsStandWhereItSays) {
  const auto scene = read(kCell);
  ASSERT_TRUE(scene) << to_string(scene.error());
  const World& world = scene->world;
  EXPECT_TRUE(scene->warnings.empty()) << to_string(scene->warnings);
  EXPECT_TRUE(check_world(world));
  ASSERT_EQ(world.obstacles.size(), 4u);
  EXPECT_EQ(world.obstacles[0].name, "table");
  EXPECT_EQ(world.obstacles[0].shape.size_m, (Vector3{0.8, 1.4, 0.04}));
  // Lying along x: its upper side is a radius above its middle.
  EXPECT_NEAR(distance_to(world.obstacles[1].shape, {0.6 + 0.06, 0.2, 0.76}), 0.0, 1e-9);
  EXPECT_NEAR(distance_to(world.obstacles[1].shape, {0.6, 0.2, 0.80}), 0.01, 1e-9);
  EXPECT_EQ(world.obstacles[2].shape.radius_m, 0.1);
  const Obstacle& pyramid = world.obstacles[3];
  EXPECT_EQ(pyramid.mesh->triangles.size(), 4u);
  const Vector3 tip = pyramid.shape.origin * Vector3{0.2, 0, 0};
  EXPECT_LT(distance(tip, {0, 1.2, 0}), 1e-7);
  EXPECT_EQ(distance_below(pyramid, tip), 0.0);
  EXPECT_TRUE(world.may_touch("can", "hand"));
}

TEST_F(SceneFiles, WhenItIsWrong_ThenPlaceAndKindAreSaid) {
  EXPECT_EQ(wrong("size_m = [0.8, 1.4, 0.04]", "size_m = [800, 1400, 40]"), "4 A0601");
  EXPECT_EQ(wrong("at_m = [0.6, 0, 0.68]", "at_m = [600, 0, 680]"), "3 A0601");
  EXPECT_EQ(wrong("radius_m = 0.1", "radius_m = 100"), "16 A0601");
  EXPECT_EQ(wrong("scale = 0.001", "scale = 1"), "20 A0601");
  EXPECT_EQ(wrong("scale = 0.001", "scale = 0.000001"), "20 A0601");
  EXPECT_EQ(wrong("size_m = [0.8, 1.4, 0.04]", "size_m = [0.8, 0, 0.04]"), "4 A0004");
  EXPECT_EQ(wrong("at_m = [0.6, 0, 0.68]", "at_m = [0.6, 0]"), "3 A0006");
  EXPECT_EQ(wrong("at_m = [0.6, 0, 0.68]\n", ""), "1 A0005");
  EXPECT_NE(wrong("radius_m = 0.03", "radius = 0.03").find("A000"), std::string::npos);
  EXPECT_EQ(wrong("turn_deg = [0, 90, 0]", "turn_deg = [0, 900, 0]"), "9 A0004");
  EXPECT_EQ(wrong("scale = 0.001", "turn_deg = [0, 0, 1]"), "22 A0603");
  EXPECT_EQ(wrong("0.70710678, 0.70710678]", "0.70710678, 0]"), "22 A0603");
  EXPECT_EQ(wrong("pyramid.obj", "none.obj"), "20 A0201");
  EXPECT_EQ(wrong("[[box]]", "[[box"), "1 A0001");
  EXPECT_NE(wrong("name = \"table\"", "nmae = \"table\"").find("A000"), std::string::npos);
}

TEST_F(SceneFiles, WhenThingsStandInEachOther_ThenBothAreNamedAndTouchingOnesAreNot) {
  // The can stands on the table: its underside at its upper side.
  const auto standing = read(replaced(kCell, "turn_deg = [0, 90, 0]\n", ""));
  ASSERT_TRUE(standing);
  EXPECT_TRUE(standing->warnings.empty()) << to_string(standing->warnings);
  const auto sunk =
      read(replaced(replaced(kCell, "turn_deg = [0, 90, 0]\n", ""), "0.2, 0.76]", "0.2, 0.75]"));
  ASSERT_TRUE(sunk);
  ASSERT_EQ(sunk->warnings.size(), 1u);
  EXPECT_EQ(sunk->warnings[0].code, "A0604");
  EXPECT_EQ(sunk->warnings[0].message, "'table' and 'can' stand in each other");
  // A mesh inside of a box, and parts of one thing.
  const auto in_box = read(kCell + "[[box]]\nname = \"crate\"\nat_m = [0, 1, 0]\nsize_m = [1, 1, 1]\n");
  ASSERT_TRUE(in_box);
  ASSERT_EQ(in_box->warnings.size(), 1u);
  EXPECT_EQ(in_box->warnings[0].message, "'crate' and 'pyramid' stand in each other");
  const std::string part = "[[box]]\nname = \"table\"\nsize_m = [0.1, 0.1, 0.7]\nat_m = [0.6, 0, 0.4]\n";
  const auto parts = read(kCell + part);
  ASSERT_TRUE(parts);
  EXPECT_TRUE(parts->warnings.empty());
  const auto twice = read(kCell + part + part);
  ASSERT_FALSE(twice);
  EXPECT_EQ(twice.error()[0].code, "A0602");
}

TEST_F(SceneFiles, WhenTheyAreDamaged_ThenTheyAreReadOrRefused) {
  std::mt19937 random(3);
  const auto below = [&](std::size_t end) {
    return std::uniform_int_distribution<std::size_t>(0, end - 1)(random);
  };
  int refused = 0;
  for (int k = 0; k < 150; ++k) {
    std::string text = kCell;
    for (int n = 0; n < 2; ++n) {
      if (below(2) == 0)
        text[below(text.size())] = static_cast<char>(below(256));
      else
        text.erase(below(text.size()), 1 + below(20));
    }
    refused += !read(text);
  }
  EXPECT_GT(refused, 60);
}

}  // namespace
}  // namespace stepwright::motion
