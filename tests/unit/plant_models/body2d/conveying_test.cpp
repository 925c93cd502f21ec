// Friction between a box and the belts below it, against what mechanics says.

#include "plant_models/body2d/conveying.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace stepwright::body2d {
namespace {

constexpr double kG = 9.81;
constexpr double kDt = 0.005;

class Conveying : public testing::Test {
 protected:
  Conveying() : world_({.step_s = kDt}) {}

  BodyId add(Vec2 at, double angle = 0.0) {
    return world_.add_box({.rectangle = shape_, .mass_kg = 4.0, .friction = 0.3}, {at, angle});
  }
  void run(BodyId box, const std::vector<Surface>& surfaces, double seconds) {
    pulled_.assign(surfaces.size(), 0.0);
    for (double t = 0.0; t < seconds - kDt / 2; t += kDt) {
      std::fill(pulled_.begin(), pulled_.end(), 0.0);
      convey(world_, box, shape_, surfaces, 0.4, pulled_);
      world_.step();
    }
  }

  World world_;
  Rectangle shape_{{0.3, 0.24}};
  std::vector<double> pulled_;
};

TEST_F(Conveying, WhenABeltCarriesABoxFromRest_ThenItSpeedsUpByGripTimesGravity) {
  const std::vector<Surface> belt = {{{{-5, -1}, {5, 1}}, {2.0, 0.0}, 0.5}};
  const BodyId box = add({-4.0, 0.0});
  run(box, belt, 0.2);
  EXPECT_NEAR(world_.motion(box).velocity.x, 0.5 * kG * 0.2, 1e-3);
  EXPECT_NEAR(pulled_[0], 0.5 * 4.0 * kG, 1e-3);  // what the belt feels
  EXPECT_NEAR(world_.motion(box).velocity.y, 0.0, 1e-6);
}

TEST_F(Conveying, WhenTheBoxHasTheBeltsSpeed_ThenItKeepsItAndPullsNoMore) {
  const std::vector<Surface> belt = {{{{-5, -1}, {5, 1}}, {0.5, 0.0}, 0.5}};
  const BodyId box = add({-4.0, 0.0});
  run(box, belt, 2.0);
  EXPECT_NEAR(world_.motion(box).velocity.x, 0.5, 1e-5);
  EXPECT_NEAR(pulled_[0], 0.0, 0.01);
  EXPECT_NEAR(world_.motion(box).spin, 0.0, 1e-5);
}

TEST_F(Conveying, WhenABoxSlidesOnTheGround_ThenItStopsWhereEnergyAndFrictionSay) {
  const BodyId box = add({0.0, 0.0});
  world_.place(box, {{0.0, 0.0}, 0.0}, {{1.0, 0.0}, 0.0});
  run(box, {}, 1.0);
  EXPECT_NEAR(world_.pose(box).position.x, 1.0 / (2.0 * 0.4 * kG), 0.004);
  EXPECT_LT(world_.kinetic_energy_j(), 1e-10);
}

TEST_F(Conveying, WhenABoxSpinsOnABeltAtRest_ThenItComesToRestAndStaysInItsPlace) {
  const std::vector<Surface> belt = {{{{-5, -1}, {5, 1}}, {}, 0.5}};
  const BodyId box = add({0.0, 0.0});
  world_.place(box, {{0.0, 0.0}, 0.0}, {{0.0, 0.0}, 6.0});
  run(box, belt, 2.0);
  EXPECT_NEAR(world_.motion(box).spin, 0.0, 1e-4);
  EXPECT_NEAR(length(world_.pose(box).position), 0.0, 1e-4);
}

// Half of it lies on a belt that runs, half on one at rest: the friction of both turns it.
TEST_F(Conveying, WhenABoxStraddlesTwoBelts_ThenItTurnsTowardsTheSlowOne) {
  const std::vector<Surface> belts = {{{{-5, 0}, {5, 1}}, {0.5, 0.0}, 0.5}, {{{-5, -1}, {5, 0}}, {}, 0.5}};
  const BodyId box = add({0.0, 0.001});
  run(box, belts, 0.1);
  EXPECT_LT(world_.motion(box).spin, -0.1);
}

TEST_F(Conveying, WhenTheGripIsGone_ThenTheBeltRunsBelowTheBox) {
  const std::vector<Surface> belt = {{{{-5, -1}, {5, 1}}, {0.5, 0.0}, 0.0}};
  const BodyId box = add({0.0, 0.0});
  run(box, belt, 1.0);
  EXPECT_EQ(world_.pose(box).position.x, 0.0);
}

// Belts pull towards their speed and never beyond: no step may add energy to a box that moves with them.
TEST_F(Conveying, WhenABoxIsCarried_ThenItsEnergyNeverExceedsThatOfTheBelt) {
  const std::vector<Surface> belt = {{{{-50, -1}, {50, 1}}, {0.5, 0.0}, 0.9}};
  const BodyId box = add({-4.0, 0.1}, 0.4);
  const double most = 0.5 * 4.0 * 0.25 * 1.001;
  for (int i = 0; i < 400; ++i) {
    run(box, belt, kDt);
    ASSERT_LE(world_.kinetic_energy_j(), most) << "step " << i;
  }
}

}  // namespace
}  // namespace stepwright::body2d
