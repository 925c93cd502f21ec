// The fast checker's own arithmetic against FCL's: bodies that are the spheres themselves, in worlds that are
// drawn.

#include <gtest/gtest.h>

#include "tests/unit/supervisor/motion/exact_scenes.h"

namespace stepwright::motion {
namespace {

Bodies spheres_as_bodies(const SphereModel& spheres, double larger_m) {
  Bodies bodies;
  for (const LinkSpheres& link : spheres.links) {
    bodies.emplace_back();
    for (const Sphere& each : link.spheres)
      bodies.back().push_back({sphere("", each.centre_m, each.radius_m + larger_m).shape, nullptr});
  }
  return bodies;
}

World draw_world(Random& random) {
  World world;
  for (int k = 0; k < 12; ++k) {
    const Transform place{from_rpy(random.between(-3, 3), random.between(-3, 3), random.between(-3, 3)),
                          {random.between(-0.9, 0.9), random.between(-0.9, 0.9), random.between(0.4, 1.8)}};
    const double a = random.between(0.01, 0.15), b = random.between(0.02, 0.3), c = random.between(0.02, 0.3);
    world.obstacles.push_back(k % 3 == 0   ? box("", place, {a, b, c})
                              : k % 3 == 1 ? cylinder("", place, a, b)
                                           : sphere("", place.position_m, a));
  }
  return world;
}

TEST(FastAgainstExact, WhenWorldsAreDrawn_ThenBothSeeTheSameSpheresCollide) {
  constexpr double kBorder_m = 1e-4;  // rounding of single precision and what it is made up for with
  tests::Scene scene = tests::own_scene("both_arms");
  scene.spheres = cover(scene.bodies, {.protrusion_m = 0.04, .most_per_body = 16});
  Random random(1);
  std::size_t free = 0, colliding = 0;
  for (int k = 0; k < 12; ++k) {
    scene.world = draw_world(random);
    const CollisionChecker fast = scene.checker();
    const auto rows = tests::draw_rows(scene, 50, random);
    const auto found = fast.collisions(rows);
    scene.bodies = spheres_as_bodies(scene.spheres, 0.0);
    const ExactChecker exact = tests::exact_of(scene);
    scene.bodies = spheres_as_bodies(scene.spheres, kBorder_m);
    const ExactChecker larger = tests::exact_of(scene);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const std::span<const double> row(rows.data() + i * fast.columns(), fast.columns());
      if (found[i] == 0) {
        ASSERT_FALSE(exact.contact(row)) << "called free";
      } else {
        ASSERT_TRUE(larger.contact(row)) << "called a collision";
      }
      (found[i] == 0 ? free : colliding) += 1;
    }
  }
  EXPECT_GT(free, 30u);
  EXPECT_GT(colliding, 100u);
}

TEST(TwoArms, WhenPairsAreCalledNeverMeeting_ThenNoConfigurationBringsThemTogether) {
  tests::Scene scene = tests::own_scene("both_arms");
  scene.world = {};
  // Everything is disabled but what the file says never meets.
  const std::string text = tests::file_text(tests::own_folder() / "two_arms.srdf");
  const auto links = static_cast<int>(scene.robot.links.size());
  scene.semantics.disabled.clear();
  for (int a = 0; a < links; ++a)
    for (int b = a + 1; b < links; ++b) {
      const auto named = [&](int first, int second) {
        return text.find("link1=\"" + scene.robot.links[static_cast<std::size_t>(first)].name +
                         "\" link2=\"" + scene.robot.links[static_cast<std::size_t>(second)].name +
                         "\" reason=\"Never\"") != std::string::npos;
      };
      if (!named(a, b) && !named(b, a)) scene.semantics.disabled.emplace_back(a, b);
    }
  const auto pairs = static_cast<std::size_t>(links * (links - 1) / 2);
  EXPECT_EQ(pairs - scene.semantics.disabled.size(), 23u);
  const ExactChecker exact = tests::exact_of(scene);
  Random random(2);
  for (int k = 0; k < 2000; ++k) {
    auto row = tests::draw_rows(scene, 1, random);
    // Extremes are where they would meet.
    for (std::size_t j = 0; j < row.size(); ++j) {
      const Coordinate& limits = scene.robot.coordinates[static_cast<std::size_t>(scene.coordinates[j])];
      if (random.unit() < 0.4) row[j] = random.unit() < 0.5 ? limits.lower : limits.upper;
    }
    const auto contact = exact.contact(row);
    ASSERT_FALSE(contact) << contact->link << " meets " << contact->other;
  }
}

}  // namespace
}  // namespace stepwright::motion
