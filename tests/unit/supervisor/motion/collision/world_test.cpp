#include "supervisor/motion/collision/world.h"

#include <gtest/gtest.h>

#include <limits>

namespace stepwright::motion {
namespace {

TEST(World, WhenAPointIsOutside_ThenItsDistanceIsExact) {
  const Shape crate = box("crate", {{}, {1, 0, 0}}, {2, 2, 2}).shape;
  EXPECT_DOUBLE_EQ(distance_to(crate, {1, 0, 0.5}), 0.0);
  EXPECT_DOUBLE_EQ(distance_to(crate, {3, 0, 0}), 1.0);
  EXPECT_DOUBLE_EQ(distance_to(crate, {5, 5, 0.9}), 5.0);
  const Shape post = cylinder("post", {from_rpy(1.5707963267948966, 0, 0), {}}, 1.0, 4.0).shape;  // along y
  EXPECT_NEAR(distance_to(post, {0, 1.9, 0.9}), 0.0, 1e-15);
  EXPECT_NEAR(distance_to(post, {3, 0, 4}), 4.0, 1e-12);
  EXPECT_NEAR(distance_to(post, {4, 6, 0}), 5.0, 1e-12);
  EXPECT_DOUBLE_EQ(distance_to(sphere("ball", {0, 0, 1}, 0.5).shape, {0, 0, 3}), 1.5);
}

TEST(World, WhenAnObstacleIsWrong_ThenItIsRefusedByName) {
  const auto refused = [](Obstacle obstacle) {
    const auto sound = check_world({{std::move(obstacle)}});
    return sound ? "sound"
                 : sound.error()[0].code +
                       (sound.error()[0].message.find("'it'") == std::string::npos ? "?" : "");
  };
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refused(sphere("it", {0, 0, 0}, 1)), "sound");
  EXPECT_EQ(refused(sphere("it", {0, 0, 0}, 0)), "A0301");
  EXPECT_EQ(refused(sphere("it", {0, kInfinite, 0}, 1)), "A0301");
  EXPECT_EQ(refused(box("it", {}, {1, 1, 0})), "A0301");
  EXPECT_EQ(refused(box("it", {}, {1, 1, kInfinite})), "A0301");
  EXPECT_EQ(refused(cylinder("it", {}, 1, -1)), "A0301");
  Obstacle mesh = sphere("it", {}, 1);
  mesh.shape.kind = ShapeKind::Mesh;
  EXPECT_EQ(refused(mesh), "A0301");
}

}  // namespace
}  // namespace stepwright::motion
