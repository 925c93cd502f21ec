#include "supervisor/motion/collision/attached_body.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "supervisor/motion/kinematics/link_frames.h"
#include "supervisor/motion/mesh/solids.h"
#include "tests/unit/supervisor/motion/scenes.h"

namespace stepwright::motion {
namespace {

std::vector<int> hand_of(const Robot& robot, const std::string& side) {
  std::vector<int> links;
  for (const char* each : {"_hand", "_finger_1", "_finger_2", "_tcp"})
    links.push_back(robot.link(side + each));
  return links;
}

Transform frame_of(const tests::Scene& scene, std::span<const double> row, int link) {
  std::vector<double> all = scene.rest;
  for (std::size_t k = 0; k < row.size(); ++k) all[static_cast<std::size_t>(scene.coordinates[k])] = row[k];
  std::vector<Transform> frames(scene.robot.links.size());
  LinkFrames(scene.robot).place(all, frames);
  return frames[static_cast<std::size_t>(link)];
}

CollisionChecker checker_of(const tests::Scene& scene, const std::vector<AttachedBody>& attached) {
  auto made = CollisionChecker::make(scene.robot, scene.spheres, &scene.semantics, scene.world,
                                     scene.coordinates, scene.rest, attached);
  EXPECT_TRUE(made) << to_string(made.error());
  return std::move(*made);
}

// By hand: the ball's place from the link's frame, its distances to obstacles and to the spheres of links.
double gap_of_ball(const tests::Scene& scene, std::span<const double> row, int link, Vector3 at,
                   double radius, const std::vector<int>& touching) {
  std::vector<double> all = scene.rest;
  for (std::size_t k = 0; k < row.size(); ++k) all[static_cast<std::size_t>(scene.coordinates[k])] = row[k];
  std::vector<Transform> frames(scene.robot.links.size());
  LinkFrames(scene.robot).place(all, frames);
  const Vector3 centre = frames[static_cast<std::size_t>(link)] * at;
  double gap = 1e9;
  for (const Obstacle& each : scene.world.obstacles)
    gap = std::min(gap, distance_to(each.shape, centre) - radius);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    if (std::find(touching.begin(), touching.end(), static_cast<int>(k)) != touching.end()) continue;
    for (const Sphere& each : scene.spheres.links[k].spheres)
      gap = std::min(gap, distance(frames[k] * each.centre_m, centre) - radius - each.radius_m);
  }
  return gap;
}

TEST(AttachedBody, WhenABallIsCarried_ThenCollisionsAreThoseOfItsPlaceByHand) {
  const tests::Scene scene = tests::own_scene("right_arm");
  const CollisionChecker empty = checker_of(scene, {});
  const auto touching = hand_of(scene.robot, "right");
  const int tcp = scene.robot.link("right_tcp");
  const Vector3 at{0.02, -0.01, 0.12};
  constexpr double kRadius_m = 0.09, kBorder_m = 1e-4;
  const auto holding = checker_of(scene, {attach(sphere("ball", {}, kRadius_m), tcp, {{}, at}, touching)});
  Random random(4);
  const auto rows = tests::draw_rows(scene, 2000, random);
  const auto before = empty.collisions(rows), after = holding.collisions(rows);
  int by_ball = 0, free = 0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    const double gap = gap_of_ball(scene, {rows.data() + 7 * k, 7}, tcp, at, kRadius_m, touching);
    if (before[k] != 0 || gap < -kBorder_m) {
      ASSERT_EQ(after[k], 1) << k;
      by_ball += before[k] == 0;
    } else if (gap > kBorder_m) {
      ASSERT_EQ(after[k], 0) << k;
      ++free;
    }
  }
  EXPECT_GT(by_ball, 20);
  EXPECT_GT(free, 50);
}

TEST(AttachedBody, WhenThingsAreCarriedAndMeshesStandAround_ThenAllInstructionSetsAgree) {
  tests::Scene scene = tests::own_scene("both_arms");
  scene.world.obstacles.push_back(mesh(
      "prism", {from_rpy(0.2, 0.5, 0), {0.5, -0.3, 1.1}},
      std::make_shared<const TriangleMesh>(prism_around_cylinder(0.15, 0.4, 12)), {.most_per_body = 24}));
  const Robot& robot = scene.robot;
  const auto checker = checker_of(
      scene, {attach(box("tray", {}, {0.2, 0.3, 0.03}), robot.link("left_tcp"), {}, hand_of(robot, "left")),
              attach(cylinder("can", {}, 0.03, 0.15), robot.link("right_tcp"), {}, hand_of(robot, "right"))});
  Random random(5);
  const auto rows = tests::draw_rows(scene, 700, random);
  std::vector<std::uint8_t> wanted(700);
  internal::check_scalar(checker.program(), rows.data(), wanted.size(), false, wanted.data());
  EXPECT_GT(std::count(wanted.begin(), wanted.end(), 0), 5);
  for (const std::int64_t target : internal::simd_targets()) {
    internal::choose_simd_target(target);
    EXPECT_EQ(checker.collisions(rows), wanted) << internal::simd_target_name(target);
  }
  internal::choose_simd_target(0);
}

TEST(AttachedBody, WhenAPairIsAllowed_ThenItMayTouch) {
  tests::Scene scene = tests::own_scene("right_arm");
  scene.world.obstacles.clear();
  const int tcp = scene.robot.link("right_tcp");
  const auto home = [&] {
    std::vector<double> q;
    for (const int each : scene.coordinates) q.push_back(scene.rest[static_cast<std::size_t>(each)]);
    return q;
  }();
  const Transform hand = frame_of(scene, home, tcp);
  const AttachedBody can = attach(cylinder("can", {}, 0.03, 0.1), tcp, {}, hand_of(scene.robot, "right"));
  EXPECT_TRUE(checker_of(scene, {can}).is_free(home));
  // A pole that goes back through wrist and forearm.
  std::vector<int> all;
  for (std::size_t k = 0; k < scene.robot.links.size(); ++k) all.push_back(static_cast<int>(k));
  const Obstacle pole = box("pole", {}, {0.02, 0.02, 0.6});
  EXPECT_FALSE(checker_of(scene, {attach(pole, tcp, {{}, {0, 0, -0.3}}, {})}).is_free(home));
  EXPECT_TRUE(checker_of(scene, {attach(pole, tcp, {{}, {0, 0, -0.3}}, all)}).is_free(home));
  // A tray in which the can stands: the can may touch it, the fingers too, once both are said.
  scene.world.obstacles = {box("tray", hand, {0.01, 0.01, 0.01})};
  EXPECT_FALSE(checker_of(scene, {can}).is_free(home));
  scene.world.allowed = {{"can", "tray"}};
  for (const int link : hand_of(scene.robot, "right"))
    scene.world.allowed.emplace_back("tray", scene.robot.links[static_cast<std::size_t>(link)].name);
  EXPECT_TRUE(checker_of(scene, {can}).is_free(home));
}

TEST(AttachedBody, WhenTheOtherArmCarriesATray_ThenThisArmDoesNotPassThroughIt) {
  tests::Scene scene = tests::own_scene("right_arm");
  scene.world.obstacles.clear();
  const int tcp = scene.robot.link("left_tcp");
  const auto holding =
      checker_of(scene, {attach(box("tray", {}, {0.9, 0.9, 0.02}), tcp, {}, hand_of(scene.robot, "left"))});
  const CollisionChecker empty = checker_of(scene, {});
  Random random(6);
  const auto rows = tests::draw_rows(scene, 3000, random);
  const auto before = empty.collisions(rows), after = holding.collisions(rows);
  int more = 0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    ASSERT_GE(after[k], before[k]);
    more += after[k] - before[k];
  }
  EXPECT_GT(more, 5);
}

TEST(AttachedBody, WhenItIsMoved_ThenItIsTheOneThatWasAttachedThere) {
  const tests::Scene scene = tests::own_scene("right_arm");
  const Transform place{from_rpy(0.3, -0.2, 1.0), {0.02, 0.01, 0.1}};
  const auto touching = hand_of(scene.robot, "right");
  const int tcp = scene.robot.link("right_tcp");
  const AttachedBody there = attach(box("tray", {}, {0.2, 0.3, 0.03}), tcp, place, touching);
  const AttachedBody moved_there =
      moved(attach(box("tray", {}, {0.2, 0.3, 0.03}), 0, {}), tcp, place, touching);
  EXPECT_EQ(moved_there.bodies[0].shape.origin, there.bodies[0].shape.origin);
  Random random(7);
  const auto rows = tests::draw_rows(scene, 500, random);
  EXPECT_EQ(checker_of(scene, {moved_there}).collisions(rows), checker_of(scene, {there}).collisions(rows));
}

TEST(AttachedBody, WhenItIsWrong_ThenItIsRefusedByName) {
  const tests::Scene scene = tests::own_scene("right_arm");
  const auto refused = [&](const AttachedBody& body) {
    const auto made = CollisionChecker::make(scene.robot, scene.spheres, &scene.semantics, scene.world,
                                             scene.coordinates, scene.rest, {body});
    return made ? "sound"
                : made.error()[0].code +
                      (made.error()[0].message.find("'it'") == std::string::npos ? "?" : "");
  };
  EXPECT_EQ(refused(attach(sphere("it", {}, 0.1), 3, {})), "sound");
  EXPECT_EQ(refused(attach(sphere("it", {}, 0.1), 300, {})), "A0302");
  EXPECT_EQ(refused(attach(sphere("it", {}, 0.1), 3, {}, {-1})), "A0302");
  EXPECT_EQ(refused(attach(sphere("it", {}, 0.0), 3, {})), "A0302");
  EXPECT_EQ(refused(attach("it", 3, std::vector<Body>{})), "A0302");
}

}  // namespace
}  // namespace stepwright::motion
