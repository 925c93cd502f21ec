#include "supervisor/motion/collision/collision_checker.h"

#include <gtest/gtest.h>

#include "supervisor/motion/kinematics/link_frames.h"
#include "tests/unit/supervisor/motion/scenes.h"

namespace stepwright::motion {
namespace {

// In double precision, without any shortcut: the least gap between spheres and what they must not meet.
double least_gap(const tests::Scene& scene, const std::vector<double>& row) {
  std::vector<double> q = scene.rest;
  for (std::size_t k = 0; k < row.size(); ++k) q[static_cast<std::size_t>(scene.coordinates[k])] = row[k];
  std::vector<Transform> frames(scene.robot.links.size());
  LinkFrames(scene.robot).place(q, frames);
  const auto moves = [&](int link) {
    for (; link > 0; link = scene.robot.parent_link(link)) {
      const int coordinate = scene.robot.joints[static_cast<std::size_t>(link - 1)].coordinate;
      if (std::find(scene.coordinates.begin(), scene.coordinates.end(), coordinate) !=
          scene.coordinates.end())
        return true;
    }
    return false;
  };
  const auto fixed_joint = [&](int link) {
    return scene.robot.joints[static_cast<std::size_t>(link - 1)].coordinate < 0;
  };
  double least = 1e9;
  const auto links = static_cast<int>(frames.size());
  for (int a = 0; a < links; ++a)
    for (const Sphere& one : scene.spheres.links[static_cast<std::size_t>(a)].spheres) {
      if (!moves(a)) continue;
      const Vector3 centre = frames[static_cast<std::size_t>(a)] * one.centre_m;
      for (const Obstacle& each : scene.world.obstacles)
        least = std::min(least, distance_to(each.shape, centre) - one.radius_m);
      for (int b = 0; b < links; ++b) {
        if (a == b || scene.semantics.is_disabled(a, b)) continue;
        if ((a > 0 && fixed_joint(a) && scene.robot.parent_link(a) == b) ||
            (b > 0 && fixed_joint(b) && scene.robot.parent_link(b) == a))
          continue;
        for (const Sphere& other : scene.spheres.links[static_cast<std::size_t>(b)].spheres)
          least = std::min(least, distance(centre, frames[static_cast<std::size_t>(b)] * other.centre_m) -
                                      one.radius_m - other.radius_m);
      }
    }
  return least;
}

TEST(CollisionChecker, WhenConfigurationsAreDrawn_ThenExactlyThoseWithTouchingSpheresCollide) {
  for (const char* group : {"left_arm", "both_arms"}) {
    const tests::Scene scene = tests::own_scene(group);
    const CollisionChecker checker = scene.checker();
    Random random(4);
    int decided = 0;
    for (int k = 0; k < 400; ++k) {
      const auto row = tests::draw_rows(scene, 1, random);
      const double gap = least_gap(scene, row);
      const bool collides = !checker.is_free(row);
      if (gap > 0.0 && gap <= 3.0 * CollisionChecker::kRounding_m) continue;
      ASSERT_EQ(collides, gap <= 0.0) << gap;
      decided += gap > 3.0 * CollisionChecker::kRounding_m;
    }
    EXPECT_GT(decided, 20);
  }
}

TEST(CollisionChecker, WhenLinksAreNotCheckedWithTheWorld_ThenOnlyTheirContactsWithItAreMissed) {
  const tests::Scene scene = tests::own_scene("left_arm");
  std::vector<std::uint8_t> links(scene.robot.links.size(), 0);
  tests::Scene allowed = scene;
  for (std::size_t k = 0; k < links.size(); k += 2) {
    links[k] = 1;
    for (const Obstacle& each : scene.world.obstacles)
      allowed.world.allowed.emplace_back(scene.robot.links[k].name, each.name);
  }
  const CollisionChecker all = scene.checker(), some = all.without_world(links), other = allowed.checker();
  Random random(7);
  const auto rows = tests::draw_rows(scene, 600, random);
  EXPECT_EQ(some.collisions(rows), other.collisions(rows));
  EXPECT_NE(some.collisions(rows), all.collisions(rows));
}

TEST(CollisionChecker, WhenTheRobotIsAtHome_ThenNothingMeets) {
  const tests::Scene scene = tests::own_scene("both_arms");
  const CollisionChecker checker = scene.checker();
  std::vector<double> home;
  for (const int each : scene.coordinates) home.push_back(scene.rest[static_cast<std::size_t>(each)]);
  EXPECT_TRUE(checker.is_free(home));
}

TEST(CollisionChecker, WhenAMotionGoesThroughAThing_ThenItIsNotFree) {
  const auto robot = read_urdf(
      R"(<robot name="r"><link name="a"/><link name="b"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
    <joint name="j" type="prismatic"><parent link="a"/><child link="b"/><axis xyz="1 0 0"/><limit lower="-4" upper="4"/></joint></robot>)",
      "r.urdf");
  ASSERT_TRUE(robot);
  const auto spheres = cover(*read_bodies(*robot, MeshLocator(".")));
  World world;
  world.obstacles = {box("wall", {{}, {1, 0, 0}}, {0.1, 1, 1})};
  const std::vector<int> coordinates{0};
  const std::vector<double> rest{0.0};
  const auto checker = CollisionChecker::make(*robot, spheres, nullptr, world, coordinates, rest);
  ASSERT_TRUE(checker);
  const auto free = [&](double from, double to) {
    return checker->motion_is_free(std::vector{from}, std::vector{to}, 0.05);
  };
  EXPECT_TRUE(free(-2, 0.8));
  EXPECT_FALSE(free(-2, 3));
  EXPECT_FALSE(free(0, 0.9));  // its end
  EXPECT_FALSE(free(0.9, 0));
  EXPECT_TRUE(free(0.5, 0.5));
  EXPECT_FALSE(free(1, 1));
  EXPECT_TRUE(checker->all_free({}));
  EXPECT_EQ(checker->collisions(std::vector{0.0, 1.0, 2.0}), (std::vector<std::uint8_t>{0, 1, 0}));
}

TEST(CollisionChecker, WhenLinksStandStill_ThenOnlyWhatMovesIsChecked) {
  tests::Scene scene = tests::own_scene("right_arm");
  scene.world.obstacles = {sphere("in the torso", {0, 0, 0.6}, 0.05)};
  std::vector<double> home;
  for (const int each : scene.coordinates) home.push_back(scene.rest[static_cast<std::size_t>(each)]);
  EXPECT_TRUE(scene.checker().is_free(home));
  // The other arm, where it stands, counts for the moving one: as a whole a motion through it is refused.
  scene.world.obstacles.clear();
  const CollisionChecker checker = scene.checker();
  EXPECT_FALSE(checker.program().pairs.empty());
}

}  // namespace
}  // namespace stepwright::motion
