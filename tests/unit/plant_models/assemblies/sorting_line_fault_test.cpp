// What goes wrong on the sorting line, and what the terminals show of it.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/plant_models/assemblies/line_rig.h"

namespace stepwright::assemblies {
namespace {

// A box stands at diverter 1.
void bring_to_diverter(LineRig& rig) {
  ASSERT_TRUE(rig.feed() && rig.convey("in", "r") && rig.convey("r", "d1"));
}

TEST(SortingLineFault, WhenSomethingStandsInTheWay_ThenTheBoxIsStoppedTurnedAndGoesOnOnceItIsGone) {
  LineRig rig;
  ASSERT_TRUE(rig.feed() && rig.convey("in", "r"));
  rig.fault("jam_d1", 1);
  EXPECT_FALSE(rig.drive({"belt_r", "belt_d1"}, "eye_d1", 1, 5.0));
  EXPECT_LT(rig.truth("box_1_x"), 1.1);
  EXPECT_EQ(rig.read("eye_r"), 1);  // it reaches back to the eye that it came from
  EXPECT_GT(rig.truth("greatest_force"), 1.0);
  rig.fault("jam_d1", 0);
  EXPECT_TRUE(rig.convey("r", "d1"));
}

TEST(SortingLineFault, WhenADiverterIsStuck_ThenItStaysAndItsEndSwitchesSayWhere) {
  LineRig rig;
  bring_to_diverter(rig);
  rig.fault("stuck_push_1", 1);
  EXPECT_FALSE(rig.drive({"push_1"}, "count_1", 1, 4.0));
  EXPECT_EQ(rig.read("home_1"), 1);
  EXPECT_EQ(rig.truth("travel_1"), 0.0);
  rig.fault("stuck_push_1", 0);
  rig.set("push_1", true);
  rig.run(0.5);
  rig.fault("stuck_push_1", 1);
  rig.set("push_1", false);
  rig.run(2.0);
  EXPECT_EQ(rig.read("home_1"), 0);
  EXPECT_EQ(rig.read("out_1"), 0);
  EXPECT_GT(rig.truth("travel_1"), 0.1);
}

TEST(SortingLineFault, WhenAPhotoEyeIsDead_ThenItShowsItsValueAndTheBoxIsWhereItIs) {
  LineRig rig;
  rig.fault("stuck_eye_d1", 0);
  ASSERT_TRUE(rig.feed() && rig.convey("in", "r"));
  EXPECT_FALSE(rig.drive({"belt_r", "belt_d1"}, "eye_d1", 1, 1.8));
  EXPECT_GT(rig.truth("box_1_x"), 1.2);
  ASSERT_TRUE(rig.plant().clear_fault("stuck_eye_d1").has_value());
  rig.fault("stuck_eye_e", 1);
  EXPECT_EQ(rig.read("eye_e"), 1);
  EXPECT_EQ(rig.truth("on_the_line"), rig.truth("box_2_state") == 1 ? 2 : 1);
}

TEST(SortingLineFault, WhenABeltHasLostItsGrip_ThenItRunsAndTheBoxStays) {
  LineRig rig;
  ASSERT_TRUE(rig.feed());
  const double x = rig.truth("box_1_x");
  rig.fault("slip_in", 0);
  EXPECT_FALSE(rig.drive({"belt_in", "belt_r"}, "eye_r", 1, 3.0));
  EXPECT_NEAR(rig.truth("box_1_x"), x, 0.02);
  rig.fault("slip_in", 1);
  EXPECT_TRUE(rig.convey("in", "r"));
}

TEST(SortingLineFault, WhenTheGripIsWeak_ThenTheBoxTakesLonger) {
  double seconds[2] = {};
  for (int weak = 0; weak < 2; ++weak) {
    LineRig rig({.variety = false});
    ASSERT_TRUE(rig.feed());
    if (weak == 1) rig.fault("slip_in", 0.02);
    const double start = rig.time_s();
    ASSERT_TRUE(rig.convey("in", "r"));
    seconds[weak] = rig.time_s() - start;
  }
  EXPECT_GT(seconds[1], seconds[0] * 1.3);
}

TEST(SortingLineFault, WhenABoxIsTakenAway_ThenItIsCountedAsTaken) {
  LineRig rig;
  bring_to_diverter(rig);
  rig.fault("lose_box", 1);
  rig.run(0.02);
  EXPECT_EQ(rig.read("eye_d1"), 0);
  EXPECT_EQ(rig.truth("box_1_state"), 3);
  rig.fault("lose_box", 5);  // has not arrived: nothing to take
  EXPECT_EQ(rig.truth("box_5_state"), 0);
}

TEST(SortingLineFault, WhenBoxesAreExchanged_ThenTheReaderSeesTheOtherOneFirst) {
  LineRig rig;
  rig.fault("exchange_boxes", 1);
  ASSERT_TRUE(rig.feed());
  EXPECT_EQ(rig.read("reader"), 0);
  ASSERT_TRUE(rig.convey("in", "r"));
  EXPECT_EQ(rig.read("reader"), 2);
}

TEST(SortingLineFault, WhenTheEmergencyStopIsPressed_ThenTheContactorOpensAtOnceAndPaddlesComeBack) {
  LineRig rig;
  bring_to_diverter(rig);
  rig.set("push_1", true);
  rig.set("belt_in", true);
  rig.run(0.4);
  rig.fault("press_estop", 1);
  rig.run(0.01);
  EXPECT_EQ(rig.read("contactor_closed"), 0);
  EXPECT_EQ(rig.read("estop_ok"), 0);
  rig.run(2.0);
  EXPECT_EQ(rig.truth("travel_1"), 0.0);
  EXPECT_EQ(rig.truth("speed_in"), 0.0);
  rig.fault("press_estop", 0);
  rig.run(0.1);
  EXPECT_EQ(rig.read("contactor_closed"), 1);  // whether it may close is for the safety program to say
}

TEST(SortingLineFault, WhenAPusherStartsAtARunningBelt_ThenItIsCountedAsACollision) {
  LineRig rig;
  bring_to_diverter(rig);
  rig.set("belt_d1", true);
  rig.run(0.5);
  rig.set("push_1", true);
  rig.run(0.5);
  EXPECT_EQ(rig.truth("collisions"), 1);
}

TEST(SortingLineFault, WhenTheNameIsUnknown_ThenTheKnownOnesAreListed) {
  LineRig rig;
  const auto injected = rig.plant().inject_fault("jam_d9", 1);
  ASSERT_FALSE(injected.has_value());
  EXPECT_EQ(injected.error()[0].code, "C0311");
  EXPECT_NE(injected.error()[0].hint.find("jam_d1"), std::string::npos);
  EXPECT_EQ(rig.plant().clear_fault("nothing").error()[0].code, "C0311");
}

TEST(SortingLineFault, WhenTheValueIsOutOfRange_ThenNothingChangesAndTheRangeIsSaid) {
  LineRig rig;
  for (const auto& [name, value] : {std::pair<const char*, double>{"jam_d1", 0.5},
                                    {"lose_box", 6},
                                    {"slip_in", 1.5},
                                    {"slip_in", std::nan("")},
                                    {"exchange_boxes", 5}}) {
    const auto injected = rig.plant().inject_fault(name, value);
    ASSERT_FALSE(injected.has_value()) << name;
    EXPECT_EQ(injected.error()[0].code, "C0312");
    EXPECT_NE(injected.error()[0].hint.find("allowed"), std::string::npos);
  }
}

}  // namespace
}  // namespace stepwright::assemblies
