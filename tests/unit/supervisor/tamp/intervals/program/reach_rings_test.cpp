#include "supervisor/tamp/intervals/program/reach_rings.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "supervisor/tamp/intervals/arm/srs_reach.h"
#include "supervisor/tamp/intervals/reach/column_arm.h"
#include "tests/support/compiled_program.h"
#include "tests/unit/supervisor/motion/kinematics/arms.h"

namespace stepwright::tamp {
namespace {

constexpr double kPi = std::numbers::pi;

// The block in the scan, asked for one pose after the other.
class ReachProgram {
 public:
  explicit ReachProgram(const std::string& block)
      : program_({.texts = {{"reach.st", block + R"(
PROGRAM main
VAR x, y, z, angle : LREAL; check : arm_REACH; ok : BOOL; END_VAR
  check(X := x, Y := y, Z := z, Angle := angle);
  ok := check.Ok;
END_PROGRAM
)"}}}) {}

  bool reaches(const std::array<double, 3>& at, double angle) {
    set("main.x", at[0]);
    set("main.y", at[1]);
    set("main.z", at[2]);
    set("main.angle", angle);
    program_.scan();
    return program_.get("main.ok") != 0;
  }

 private:
  void set(const char* path, double value) { program_.set(path, std::bit_cast<std::int64_t>(value)); }

  support::CompiledProgram program_;
};

TEST(ReachRings, WhenAnArmIsThatOfARobot_ThenNothingThatItReachesIsRefused) {
  const motion::Chain chain = motion::tests::own_arm("right");
  const auto arm = motion::SrsArm::recognise(chain);
  const auto reach = SrsReach::make(chain);
  ASSERT_TRUE(arm && reach);
  const ReachRings rings = rings_of(reach->table(0.05), reach->shoulder());
  EXPECT_LE(rings.rings.size(), ReachRings::kMost);
  ReachProgram program(reach_block("arm", rings));
  motion::Random random(31);
  int reached = 0, refused = 0, passed = 0, poses = 0;
  for (; poses < 4'000; ++poses) {
    const std::array<double, 3> at{random.between(-0.5, 1.0), random.between(-1.1, 0.6),
                                   random.between(0.4, 1.6)};
    const double angle = random.between(-kPi, kPi), c = std::cos(angle), s = std::sin(angle);
    const motion::Transform tip{motion::from_columns({c, s, 0}, {s, -c, 0}, {0, 0, -1}),
                                {at[0], at[1], at[2]}};
    const bool can = !arm->arcs(tip).empty(), says = program.reaches(at, angle + 4.0 * kPi);
    reached += can;
    refused += can && !says;
    passed += says;
  }
  EXPECT_EQ(refused, 0);
  EXPECT_GT(reached, 300);
  EXPECT_LT(passed, 4 * reached) << "bounds that say something";
}

TEST(ReachRings, WhenItIsAFormula_ThenRingsAreItsTurns) {
  const ColumnArm arm{.x_m = 0.1, .y_m = -0.3, .z_m = 0.6, .turn_rad = 1.0, .flip_rad = 0.3};
  const Shoulder shoulder{{arm.x_m, arm.y_m, arm.z_m}, 0.0};
  const ReachRings rings = rings_of(reach_table(arm, 0.02), shoulder);
  EXPECT_NEAR(rings.least_m, arm.least_m, 0.04);
  EXPECT_GE(rings.most_m, arm.most_m);
  EXPECT_NEAR(rings.most_m, arm.most_m, 0.04);
  EXPECT_GE(rings.rings.size(), 10u) << "two ranges of turns in most of eight rings";
  ReachProgram program(reach_block("arm", rings));
  motion::Random random(32);
  int reached = 0, refused = 0, passed = 0;
  for (int pose = 0; pose < 3'000; ++pose) {
    const std::array<double, 3> at{random.between(-0.9, 1.1), random.between(-1.3, 0.7),
                                   random.between(-0.4, 1.6)};
    const double angle = random.between(-kPi, kPi);
    const Point3 point{nanometres_of(at[0]), nanometres_of(at[1]), nanometres_of(at[2])};
    const bool can = arcs_at(arm, point).contains(angle_of(angle)), says = program.reaches(at, angle);
    reached += can;
    refused += can && !says;
    passed += says;
  }
  EXPECT_EQ(refused, 0);
  EXPECT_GT(reached, 150);
  EXPECT_LT(passed, 3 * reached);
}

TEST(ReachRings, WhenNothingIsReached_ThenTheBlockSaysThatThereAreNoBounds) {
  const ReachTable none = ReachTable::fill({{0, 0, 0}, {100'000'000, 100'000'000, 100'000'000}, {2, 2, 2}},
                                           [](const Box&) { return ArcSet{}; });
  const ReachRings rings = rings_of(none, {});
  EXPECT_TRUE(rings.rings.empty());
  EXPECT_FALSE(ReachProgram(reach_block("arm", rings)).reaches({0.05, 0.05, 0.05}, 0.0));
}

TEST(ReachRings, WhenANameIsNone_ThenItBecomesOne) {
  EXPECT_NE(reach_block("left-arm", {}).find("FUNCTION_BLOCK left_arm_REACH\n"), std::string::npos);
}

}  // namespace
}  // namespace stepwright::tamp
