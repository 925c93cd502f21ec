#include "plant_models/body2d/world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "tests/support/malloc_guard.h"

namespace stepwright::body2d {
namespace {

constexpr BoxBody kBox = {.rectangle = {{0.3, 0.2}}, .mass_kg = 3.0, .friction = 0.3};

constexpr WorldSettings kSettings = {.step_s = 0.005};
constexpr Vec2 kCorners[] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};

// Walls around a square of 2 m and boxes that fly about in it.
struct Arena {
  World world{kSettings};
  std::vector<BodyId> boxes;

  explicit Arena(int count) {
    for (std::size_t i = 0; i < 4; ++i) world.add_wall(kCorners[i], kCorners[(i + 1) % 4], 0.2);
    for (int i = 0; i < count; ++i) {
      boxes.push_back(world.add_box(kBox, {{-0.7 + 0.45 * (i % 4), -0.7 + 0.4 * (i / 4)}, 0.1 * i}));
    }
    world.warm_up(60);
  }
  // `speed` in m/s.
  void kick(double speed) {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const double way = 2.4 * static_cast<double>(i);
      world.push(boxes[i], 3.0 * speed * Vec2{std::cos(way), std::sin(way)}, 0.01 * speed);
    }
  }
};

TEST(World, WhenABoxHasItsMass_ThenItsInertiaIsThatOfARectangle) {
  World world({});
  const BodyId box = world.add_box(kBox, {});
  EXPECT_NEAR(world.mass_kg(box), 3.0, 1e-5);
  EXPECT_NEAR(world.inertia_kg_m2(box), 3.0 * (0.09 + 0.04) / 12.0, 1e-5);
}

TEST(World, WhenTheSameIsDoneTwice_ThenEveryPoseIsBitIdentical) {
  std::uint64_t hashes[2] = {};
  for (std::uint64_t& hash : hashes) {
    Arena arena(12);
    arena.kick(2.0);
    for (int i = 0; i < 1000; ++i) arena.world.step();
    hash = arena.world.hash();
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(World, WhenOneBoxStartsElsewhere_ThenTheHashDiffers) {
  Arena a(4);
  Arena b(4);
  EXPECT_EQ(a.world.hash(), b.world.hash());
  b.world.place(b.boxes[3], {{0.5, 0.5}, 0.0}, {});
  EXPECT_NE(a.world.hash(), b.world.hash());
}

// 40 m/s are 20 cm a step, as long as the box is wide.
TEST(World, WhenBoxesAreFast_ThenNonePassesThroughAWall) {
  Arena arena(12);
  for (int kick = 0; kick < 20; ++kick) {
    arena.kick(40.0);
    for (int i = 0; i < 100; ++i) arena.world.step();
    for (const BodyId box : arena.boxes) {
      const Vec2 at = arena.world.pose(box).position;
      ASSERT_LT(std::abs(at.x), 1.0) << "kick " << kick;
      ASSERT_LT(std::abs(at.y), 1.0) << "kick " << kick;
    }
  }
}

TEST(World, WhenNothingPushes_ThenContactsOnlyTakeEnergy) {
  Arena arena(12);
  arena.kick(2.0);
  double before = arena.world.kinetic_energy_j();
  EXPECT_GT(before, 30.0);
  for (int i = 0; i < 1000; ++i) {
    arena.world.step();
    const double now = arena.world.kinetic_energy_j();
    ASSERT_LE(now, before * 1.02 + 1e-9) << "step " << i;
    before = now;
  }
}

TEST(World, WhenAPaddlePressesABoxAgainstAWall_ThenBothFeelTheForceAndAFreeBoxNone) {
  World world({});
  world.add_wall({0.5, -1.0}, {0.5, 1.0}, 0.2);
  const BodyId box = world.add_box(kBox, {{0.3, 0.0}, 0.0});
  const BodyId free = world.add_box(kBox, {{-2.0, 0.0}, 0.0});
  const BodyId paddle = world.add_paddle({{0.04, 0.4}}, {{0.1, 0.0}, 0.0}, 0.3);
  world.drive(paddle, {0.5, 0.0});
  for (int i = 0; i < 34; ++i) world.step();  // the box meets the wall after 0.16 s
  EXPECT_GT(world.pressed_n(paddle), 10.0);
  EXPECT_GT(world.pressed_n(box), world.pressed_n(paddle));
  EXPECT_EQ(world.pressed_n(free), 0.0);
  const double pressed = world.pressed_n(paddle);
  EXPECT_NEAR(world.force_n(paddle).x, -pressed, 0.01 * pressed);  // back, and not to the side
  EXPECT_NEAR(world.force_n(paddle).y, 0.0, 0.01 * pressed);
}

TEST(World, WhenABodyIsNotThere_ThenOthersPassAndItKeepsItsPose) {
  World world({});
  const BodyId wall = world.add_wall({0.0, -1.0}, {0.0, 1.0}, 0.2);
  const BodyId box = world.add_box(kBox, {{-0.5, 0.0}, 0.0});
  world.set_present(wall, false);
  world.push(box, {3.0, 0.0}, 0.0);
  for (int i = 0; i < 200; ++i) world.step();
  EXPECT_NEAR(world.pose(box).position.x, 0.5, 1e-3);
  EXPECT_FALSE(world.present(wall));
}

TEST(World, WhenItRuns_ThenNothingIsAllocated) {
  if (!support::guard_is_active()) GTEST_SKIP() << "a sanitizer owns the allocator";
  Arena arena(12);
  arena.kick(3.0);
  const support::GuardCounts before = support::guard_counts();
  for (int i = 0; i < 500; ++i) arena.world.step();
  EXPECT_EQ(support::guard_counts(), before);
}

}  // namespace
}  // namespace stepwright::body2d
