#include "supervisor/motion/recheck/exact_checker.h"

#include <gtest/gtest.h>

#include "tests/unit/supervisor/motion/exact_scenes.h"

namespace stepwright::motion {
namespace {

void expect_never_called_free(const tests::Scene& scene, std::uint64_t seed, std::size_t count) {
  const CollisionChecker fast = scene.checker();
  const ExactChecker exact = tests::exact_of(scene);
  Random random(seed);
  const auto rows = tests::draw_rows(scene, count, random);
  const auto by_spheres = fast.collisions(rows);
  std::size_t free = 0, both = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const std::span<const double> row(rows.data() + k * fast.columns(), fast.columns());
    const auto contact = exact.contact(row);
    if (by_spheres[k] == 0) {
      ++free;
      ASSERT_FALSE(contact) << k << ": " << contact->link << " meets " << contact->other;
    }
    both += contact.has_value();
  }
  EXPECT_GT(free, count / 50);
  EXPECT_GT(both, count / 50);
}

TEST(ExactChecker, WhenSpheresAreFree_ThenSoAreTheBodiesByFcl) {
  expect_never_called_free(tests::own_scene("right_arm"), 1, 1500);
  expect_never_called_free(tests::own_scene("both_arms"), 2, 800);
}

TEST(ExactChecker, WhenARobotHasMeshes_ThenSpheresAreNeverLessCareful) {
  auto scene = tests::panda_scene();
  if (!scene) GTEST_SKIP() << "data/arms is not on this machine";
  expect_never_called_free(*scene, 3, 600);
}

TEST(ExactChecker, WhenBodiesMeet_ThenTheyAreNamed) {
  tests::Scene scene = tests::own_scene("right_arm");
  scene.world.obstacles = {box("block", {{}, {0, -0.3, 1.3}}, {0.6, 0.6, 0.6})};
  const auto contact = tests::exact_of(scene).contact(tests::home_of(scene));
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->other, "block");
  EXPECT_EQ(contact->link.substr(0, 6), "right_");
  scene.world.obstacles.clear();
  EXPECT_FALSE(tests::exact_of(scene).contact(tests::home_of(scene)));
}

TEST(ExactChecker, WhenASolidIsInsideOfAMesh_ThenTheyMeet) {
  auto scene = tests::panda_scene();
  if (!scene) GTEST_SKIP() << "data/arms is not on this machine";
  std::vector<Transform> frames(scene->robot.links.size());
  std::vector<double> q(scene->robot.coordinates.size());
  q[3] = -1.5;
  LinkFrames(scene->robot).place(q, frames);
  const auto link = static_cast<std::size_t>(scene->robot.link("panda_link2"));
  scene->world.obstacles = {box("seed", {{}, frames[link].position_m}, {1e-3, 1e-3, 1e-3})};
  const auto contact = tests::exact_of(*scene).contact(std::span(q).first(7));
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->other, "seed");
}

}  // namespace
}  // namespace stepwright::motion
