// Boxes on the sorting line: where they get, what becomes of them, how hard they are handled.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "plant_models/core/counter_random.h"
#include "tests/unit/plant_models/assemblies/line_rig.h"

namespace stepwright::assemblies {
namespace {

// Which chute each box is for; the way leads past the reader and over the diverters before it.
bool deliver(LineRig& rig, int chute) {
  if (!rig.feed() || !rig.convey("in", "r") || !rig.convey("r", "d1")) return false;
  if (chute == 1) return rig.divert(1);
  if (!rig.convey("d1", "d2")) return false;
  if (chute == 2) return rig.divert(2);
  return rig.convey("d2", "e") && rig.run_off(3);
}

class SortingLineSeeds : public testing::TestWithParam<std::uint64_t> {};

TEST_P(SortingLineSeeds, WhenBoxesAreSentToChutes_ThenEachIsWhereItWasSentInThatOrder) {
  LineRig rig({.seed = GetParam()});
  const int wanted[5] = {2, 1, 3, 2, 1};
  const int rank[5] = {1, 1, 1, 2, 2};
  for (int box = 0; box < 5; ++box) {
    ASSERT_TRUE(deliver(rig, wanted[box])) << "box " << box + 1 << " at " << rig.time_s() << " s";
  }
  // One box after the other, without overlap: five a minute at least.
  EXPECT_LT(rig.time_s(), 60.0);
  rig.run(5.0);
  for (int box = 0; box < 5; ++box) {
    const std::string name = "box_" + std::to_string(box + 1);
    EXPECT_EQ(rig.truth(name + "_state"), 2) << name;
    EXPECT_EQ(rig.truth(name + "_chute"), wanted[box]) << name;
    EXPECT_EQ(rig.truth(name + "_rank"), rank[box]) << name;
  }
  EXPECT_EQ(rig.truth("delivered"), 5);
  EXPECT_EQ(rig.truth("collisions"), 0);
  // The hardest blow there can be: a paddle at 0.5 m/s meets 5 kg within a step of 5 ms.
  EXPECT_LT(rig.truth("greatest_force"), 550.0);
}

TEST_P(SortingLineSeeds, WhenABoxGoesThroughTheLane_ThenItStandsAtTheReaderAgain) {
  LineRig rig({.seed = GetParam()});
  EXPECT_EQ(rig.read("reader_length"), 0);
  EXPECT_EQ(rig.read("reader_colour"), 0);
  ASSERT_TRUE(rig.feed() && rig.convey("in", "r"));
  const BoxData box = make_boxes({.seed = GetParam()})[0];
  EXPECT_NEAR(rig.read("reader_length"), 1e3 * box.rectangle.size.x, 0.5);
  EXPECT_EQ(rig.read("reader_colour"), box.colour);
  for (int round = 0; round < 3; ++round) {
    EXPECT_EQ(rig.read("reader"), 1);
    ASSERT_TRUE(rig.convey("r", "d1") && rig.convey("d1", "d2") && rig.convey("d2", "e"));
    EXPECT_EQ(rig.read("reader"), 0);
    ASSERT_TRUE(rig.recirculate()) << "round " << round << ", x " << rig.truth("box_1_x") << " y "
                                   << rig.truth("box_1_y");
    EXPECT_LT(std::abs(rig.truth("box_1_angle")), 0.35);
    EXPECT_LT(std::abs(rig.truth("box_1_y")), 0.12);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, SortingLineSeeds, testing::Range(std::uint64_t{1}, std::uint64_t{13}));

TEST(SortingLineMotion, WhenTheContactorIsOpen_ThenNothingMoves) {
  LineRig rig;
  rig.set("contactor", false);
  rig.run(3.0);
  ASSERT_EQ(rig.truth("box_1_state"), 1);
  const double x = rig.truth("box_1_x");
  rig.set("belt_in", true);
  rig.set("push_1", true);
  rig.run(2.0);
  EXPECT_EQ(rig.read("contactor_closed"), 0);
  EXPECT_EQ(rig.truth("speed_in"), 0.0);
  EXPECT_EQ(rig.truth("travel_1"), 0.0);
  EXPECT_EQ(rig.truth("box_1_x"), x);
}

TEST(SortingLineMotion, WhenABeltRuns_ThenABoxGetsItsSpeedAndNoMore) {
  LineRig rig({.variety = false});
  rig.run(1.5);
  rig.set("belt_in", true);
  rig.set("belt_r", true);
  rig.set("belt_d1", true);
  double fastest = 0.0;
  double belt = 0.0;
  double before = rig.truth("box_1_x");
  for (int scan = 0; scan < 200; ++scan) {
    rig.run(0.01);
    const double x = rig.truth("box_1_x");
    fastest = std::max(fastest, (x - before) / 0.01);
    belt = std::max(belt, rig.truth("speed_in"));
    before = x;
  }
  EXPECT_NEAR(fastest, 0.5, 0.5 * 0.05);  // the drive overshoots a little
  EXPECT_LE(fastest, belt + 1e-4);        // friction carries along, it does not throw
  EXPECT_NEAR(rig.truth("box_1_y"), 0.0, 1e-6);
}

TEST(SortingLineMotion, WhenAllBeltsStop_ThenTheEnergyIsGoneWithinASecond) {
  LineRig rig;
  rig.run(1.5);
  rig.set("belt_in", true);
  rig.run(1.0);
  EXPECT_GT(rig.truth("energy"), 0.1);
  rig.set("belt_in", false);
  rig.run(1.0);
  EXPECT_LT(rig.truth("energy"), 1e-9);
}

// Conservation and no tunnelling: belts and pushers do what they like, boxes stay boxes.
TEST_P(SortingLineSeeds, WhenOutputsAreSwitchedAtRandom_ThenNoBoxVanishesOrPassesThroughAnything) {
  LineRig rig({.boxes = 9, .arrival_s = 0.4, .seed = GetParam()});
  const core::CounterRandom random(GetParam(), 77);
  std::uint64_t draw = 0;
  const auto& layout = rig.plant().layout();
  for (int turn = 0; turn < 150; ++turn) {
    for (const core::Port& port : rig.plant().actuators()) {
      if (port.name != "contactor" && random.bits(draw++) % 4 == 0)
        rig.set(port.name, random.bits(draw++) % 2 == 0);
    }
    rig.run(0.4);
    int sum[5] = {};
    for (int box = 1; box <= 9; ++box) {
      const std::string name = "box_" + std::to_string(box);
      const auto state = static_cast<int>(rig.truth(name + "_state"));
      ++sum[state];
      if (state != 1) continue;
      EXPECT_TRUE(layout.bounds.contains({rig.truth(name + "_x"), rig.truth(name + "_y")})) << name;
    }
    ASSERT_EQ(sum[0] + sum[1] + sum[2], 9);
    ASSERT_EQ(sum[4], 0) << "a box has left the line elsewhere";
    ASSERT_EQ(sum[1], rig.truth("on_the_line"));
    ASSERT_EQ(sum[2], rig.truth("delivered"));
    ASSERT_TRUE(std::isfinite(rig.truth("energy")));
    // 9 boxes of 5 kg at the speed of a paddle are 7 J.
    ASSERT_LT(rig.truth("energy"), 10.0);
  }
  EXPECT_GT(rig.truth("delivered"), 0);
}

}  // namespace
}  // namespace stepwright::assemblies
