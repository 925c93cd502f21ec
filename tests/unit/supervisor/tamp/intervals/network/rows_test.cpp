#include <gtest/gtest.h>

#include <numbers>

#include "supervisor/tamp/intervals/network/network.h"
#include "tests/support/tamp/certificate_check.h"
#include "tests/support/tamp/experiments.h"

namespace stepwright::tamp {
namespace {

using testing::kRight;

constexpr double kHalfTurn = std::numbers::pi;

const testing::TwoArms& two_hands() {
  static const testing::TwoArms two = testing::two_arms(0.05);
  return two;
}

// Two cups on one turned tray, the second beyond the first one in two directions.
struct Pair {
  WorkCell cell;
  std::vector<Action> sequence;
};
Pair pair_on_tray(double first_m, double second_m, double heading_rad) {
  Pair pair;
  pair.cell.arms = {{"right", &two_hands().right_table}};
  pair.cell.grasps = {{"top", 0.34, 0.0, {}}};
  pair.cell.regions = {{"tray", 0.5, -0.2, 0.05, 0.2, 0.2, heading_rad}};
  pair.cell.objects = {{"cup1", {0.45, -0.3, 0.05, 0.0}, 0.1}, {"cup2", {0.45, -0.1, 0.05, 0.0}, 0.1}};
  Action last = place(kRight, 1, 0);
  last.beyond = {{0, 0.25 * kHalfTurn, first_m}, {0, -0.25 * kHalfTurn, second_m}};
  pair.sequence = {pick(kRight, 0), place(kRight, 0, 0), pick(kRight, 1), last};
  return pair;
}

Network pushed(const Pair& pair) {
  Network network(pair.cell);
  for (const Action& action : pair.sequence) network.push(action);
  return network;
}

TEST(Rows, WhenOnlySumsOfRowsConflict_ThenTheProgramRefutesAndItsMultipliersProve) {
  // On an upright tray of 0.2 m: 0.14 m on both diagonals are 0.198 m along x; 0.15 m are 0.212 m.
  const Pair room = pair_on_tray(0.14, 0.14, 0.0), tight = pair_on_tray(0.15, 0.15, 0.0);
  EXPECT_FALSE(pushed(room).refuted());
  const Network network = pushed(tight);
  ASSERT_TRUE(network.refuted());
  EXPECT_EQ(testing::wrong_with(network, network.certificate()), "");
  Certificate none = network.certificate();
  if (none.multipliers.empty()) return;
  for (double& multiplier : none.multipliers) multiplier = 0.0;
  EXPECT_NE(testing::wrong_with(network, none), "");
}

TEST(Rows, WhenATrayIsTurned_ThenItsSidesCount) {
  // Along the diagonal of its box, which is the width of the turned tray: 0.2 m.
  for (const double distance_m : {0.05, 0.19, 0.21, 0.27}) {
    const Pair pair = pair_on_tray(distance_m, 0.0, 0.25 * kHalfTurn);
    const Network network = pushed(pair);
    ASSERT_EQ(network.refuted(), distance_m > 0.2) << distance_m;
    if (!network.refuted()) continue;
    EXPECT_EQ(testing::wrong_with(network, network.certificate()), "") << distance_m;
  }
}

TEST(Rows, WhenDistancesAreRandom_ThenRefutationsAreProvedAndPopGivesBack) {
  testing::Random random(5);
  int by_program = 0, refuted = 0;
  for (int round = 0; round < 60; ++round) {
    const Pair pair =
        pair_on_tray(random.from_to(0.0, 0.25), random.from_to(0.0, 0.25), random.from_to(-1.5, 1.5));
    Network network(pair.cell);
    for (const Action& action : pair.sequence) network.push(action);
    if (network.refuted()) {
      ++refuted;
      if (!network.certificate().multipliers.empty()) ++by_program;
      EXPECT_EQ(testing::wrong_with(network, network.certificate()), "") << round;
    } else {
      EXPECT_TRUE(network.point()) << round;
    }
    network.pop();
    EXPECT_FALSE(network.refuted());
    const bool again = network.push(pair.sequence.back());
    EXPECT_EQ(again, pushed(pair).refuted() == false) << round;
  }
  EXPECT_GT(refuted, 5);
  EXPECT_GT(by_program, 0);
}

TEST(LinearProgram, WhenBoundsChange_ThenItStartsFromTheLastBasis) {
  LinearProgram program(2, {{{{0, 1.0}, {1, 1.0}}, 3.0}, {{{0, -1.0}, {1, 1.0}}, 1.0}});
  program.bound(0, 0.0, 5.0);
  program.bound(1, 0.0, 5.0);
  EXPECT_FALSE(program.refute());
  EXPECT_NEAR(*program.largest(1), 2.0, 1e-9);
  EXPECT_NEAR(*program.least(0), 0.0, 1e-9);
  program.bound(0, 2.0, 5.0);
  program.bound(1, 2.0, 5.0);
  const auto multipliers = program.refute();
  ASSERT_TRUE(multipliers);
  EXPECT_GT((*multipliers)[0], 0.0);
  EXPECT_NEAR((*multipliers)[1], 0.0, 1e-9);
}

}  // namespace
}  // namespace stepwright::tamp
