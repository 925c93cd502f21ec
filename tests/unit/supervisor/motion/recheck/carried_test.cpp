// What is carried and meshes that stand around: spheres against FCL.

#include <gtest/gtest.h>

#include "supervisor/motion/mesh/solids.h"
#include "tests/unit/supervisor/motion/exact_scenes.h"

namespace stepwright::motion {
namespace {

std::vector<AttachedBody> tray_and_can(const Robot& robot) {
  const auto touching = [&](const std::string& side) {
    return std::vector<int>{robot.link(side + "_hand"), robot.link(side + "_finger_1"),
                            robot.link(side + "_finger_2")};
  };
  return {attach(box("tray", {}, {0.25, 0.3, 0.02}), robot.link("left_tcp"), {from_rpy(0.3, 0, 0), {}},
                 touching("left")),
          attach(mesh("can", {}, std::make_shared<const TriangleMesh>(prism_around_cylinder(0.03, 0.16, 10))),
                 robot.link("right_tcp"), {}, touching("right"))};
}

TEST(Carried, WhenSpheresAreFree_ThenSoAreCarriedThingsByFcl) {
  tests::Scene scene = tests::own_scene("both_arms");
  scene.world.obstacles.push_back(
      mesh("prism", {from_rpy(0.2, 0.5, 0), {0.5, -0.3, 1.1}},
           std::make_shared<const TriangleMesh>(prism_around_cylinder(0.15, 0.4, 12))));
  const auto carried = tray_and_can(scene.robot);
  const auto fast = *CollisionChecker::make(scene.robot, scene.spheres, &scene.semantics, scene.world,
                                            scene.coordinates, scene.rest, carried);
  const ExactChecker bare = tests::exact_of(scene, true);
  const auto exact = *bare.with(scene.world, scene.rest, carried);
  const auto anew = *ExactChecker::make(scene.robot, scene.bodies, &scene.semantics, scene.world,
                                        scene.coordinates, scene.rest, nullptr, carried);
  Random random(1);
  const auto rows = tests::draw_rows(scene, 500, random);
  const auto found = fast.collisions(rows);
  int free = 0, by_carried = 0, by_mesh = 0;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const std::span<const double> row(rows.data() + k * fast.columns(), fast.columns());
    const auto contact = exact.contact(row);
    ASSERT_EQ(contact.has_value(), anew.contact(row).has_value());
    if (found[k] == 0) {
      ASSERT_FALSE(contact) << contact->link << " meets " << contact->other;
    }
    free += found[k] == 0;
    if (!contact) continue;
    by_mesh += contact->other == "prism";
    const bool named = contact->link == "tray" || contact->link == "can" || contact->other == "tray" ||
                       contact->other == "can";
    if (named) {
      ++by_carried;
    } else {
      ASSERT_TRUE(bare.contact(row));
    }
  }
  EXPECT_GT(free, 10);
  EXPECT_GT(by_carried, 5);
  EXPECT_GT(by_mesh, 3);
}

TEST(Carried, WhenAMotionSweepsATrayThroughASheet_ThenItIsFound) {
  tests::Scene scene = tests::own_scene("right_arm");
  scene.world.obstacles.clear();
  const auto home = tests::home_of(scene);
  const int tcp = scene.robot.link("right_tcp");
  const std::vector<AttachedBody> pole{
      attach(box("pole", {}, {0.02, 0.02, 0.6}), tcp, {{}, {0, 0, 0.3}},
             {scene.robot.link("right_hand"), scene.robot.link("right_finger_1"),
              scene.robot.link("right_finger_2")})};
  std::vector<double> there = home;
  there[6] += 0.5;  // about its own axis: the pole stays
  ExactChecker exact = *tests::exact_of(scene, true).with({}, scene.rest, pole);
  ASSERT_EQ(exact.check_motion(home, there).kind, MotionVerdict::Kind::Free);
  there = home;
  there[0] += 0.4;
  ASSERT_EQ(exact.check_motion(home, there).kind, MotionVerdict::Kind::Free);
  // A thread at the far end of the pole, half way.
  std::vector<double> middle = scene.rest;
  for (std::size_t k = 0; k < home.size(); ++k)
    middle[static_cast<std::size_t>(scene.coordinates[k])] = 0.5 * (home[k] + there[k]);
  std::vector<Transform> frames(scene.robot.links.size());
  LinkFrames(scene.robot).place(middle, frames);
  const Vector3 end = frames[static_cast<std::size_t>(tcp)] * Vector3{0, 0, 0.59};
  World world;
  world.obstacles = {sphere("thread", end, 2e-4)};
  exact = *exact.with(world, scene.rest, pole);
  const MotionVerdict verdict = exact.check_motion(home, there);
  EXPECT_EQ(verdict.kind, MotionVerdict::Kind::Collides);
  EXPECT_EQ(verdict.contact.link, "pole");
  EXPECT_EQ(verdict.contact.other, "thread");
}

}  // namespace
}  // namespace stepwright::motion
