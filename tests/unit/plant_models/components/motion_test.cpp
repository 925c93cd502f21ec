// What moves, what is on a panel, and the plants that controllers are tuned on.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/plant_models/components/model_rig.h"

namespace stepwright::components {
namespace {

TEST(Motion, WhenACylinderMoves_ThenItTakesItsTimeAndItsSwitchesTell) {
  ModelRig rig(
      "[components.c]\ntype = \"cylinder\"\nstroke = \"200 mm\"\nextend_time = \"1 s\"\nretract_time = \"2 "
      "s\"\nextend = \"E\"\nretract = \"R\"\n"
      "[terminals]\nE = \"%QX0.0\"\nR = \"%QX0.1\"\nout = { address = \"%IX0.0\", from = \"c.extended\" "
      "}\nin = { address = \"%IX0.1\", from = \"c.retracted\" }\n");
  EXPECT_EQ(rig.sensor("in"), 1);
  rig.set("E", 1);
  ASSERT_TRUE(rig.run(0.5));
  EXPECT_NEAR(rig.truth("c.position"), 100.0, 1e-6);
  ASSERT_TRUE(rig.run(0.51));
  EXPECT_EQ(rig.truth("c.position"), 200.0);
  EXPECT_EQ(rig.sensor("out"), 1);
  rig.set("R", 1);  // both: it stays
  ASSERT_TRUE(rig.run(1.0));
  EXPECT_EQ(rig.truth("c.position"), 200.0);
  rig.set("E", 0);
  ASSERT_TRUE(rig.plant().inject_fault("c.slow", 2.0));
  ASSERT_TRUE(rig.run(2.0));
  EXPECT_NEAR(rig.truth("c.position"), 100.0, 1e-6);
  ASSERT_TRUE(rig.plant().inject_fault("c.stuck", 1.0));
  ASSERT_TRUE(rig.run(5.0));
  EXPECT_NEAR(rig.truth("c.position"), 100.0, 1e-6);
  ASSERT_TRUE(rig.plant().inject_fault("c.stuck_retracted", 1.0));
  EXPECT_EQ(rig.sensor("in"), 1);
}

// A P controller on an inertia: the time constant is J / (K k_t), and friction leaves a remainder.
TEST(Motion, WhenAMotorFollowsItsReference_ThenItsSpeedIsThatOfItsEquation) {
  ModelRig rig(
      "[components.m]\ntype = \"motor\"\nnominal_speed = \"100 rad/s\"\ninertia = \"0.1 kg m2\"\nfriction = "
      "\"0 N m s\"\ntorque_constant = \"1 N m/A\"\ncurrent_limit = \"1000 A\"\ngain = \"0.1 A s\"\nenable = "
      "\"true\"\n"
      "[components.b]\ntype = \"conveyor\"\nshaft = \"m\"\nradius = \"0.01 m\"\nfriction = \"0.1 N m s\"\n");
  ASSERT_TRUE(rig.run(0.5));
  const double settled = 100.0 * 0.1 / (0.1 + 0.1);  // K k_t / (K k_t + load)
  const double expected = settled * (1.0 - std::exp(-0.5 * (0.1 + 0.1) / 0.1));
  EXPECT_NEAR(rig.truth("m.speed"), expected * 60.0 / (2.0 * std::numbers::pi), 1e-2);
  EXPECT_NEAR(rig.truth("b.speed_out"), expected * 0.01, 1e-6);
  EXPECT_NEAR(rig.truth("m.torque"), 0.1 * (100.0 - expected), 1e-4);
}

TEST(Motion, WhenItemsLieOnAConveyor_ThenTheEyeSeesThemWhenTheyPass) {
  ModelRig rig(
      "[components.b]\ntype = \"conveyor\"\nlength = \"2 m\"\nitem = \"0.2 m\"\nspacing = \"1 m\"\neye = \"1 "
      "m\"\nspeed = \"0.5 m/s\"\nrun = \"RUN\"\nplace = \"PLACE\"\n"
      "[components.e]\ntype = \"photo_eye\"\nof = \"b.seen\"\n"
      "[terminals]\nRUN = \"%QX0.0\"\nPLACE = \"%QX0.1\"\nEYE = { address = \"%IX0.0\", from = \"e\" }\n");
  rig.set("RUN", 1);
  rig.set("PLACE", 1);
  ASSERT_TRUE(rig.run(1.79));
  EXPECT_EQ(rig.sensor("EYE"), 0);
  ASSERT_TRUE(rig.run(0.02));  // 0.9 m after 1.8 s
  EXPECT_EQ(rig.sensor("EYE"), 1);
  ASSERT_TRUE(rig.run(0.38));
  EXPECT_EQ(rig.sensor("EYE"), 1);
  ASSERT_TRUE(rig.run(0.02));
  EXPECT_EQ(rig.sensor("EYE"), 0);
  ASSERT_TRUE(rig.run(9.9 - 2.21));
  EXPECT_EQ(rig.truth("b.left"), 3.0);  // at 4.2, 6.2 and 8.2 s
  EXPECT_EQ(rig.truth("b.items"), 2.0);
  ASSERT_TRUE(rig.plant().inject_fault("e.stuck", 1.0));
  EXPECT_EQ(rig.sensor("EYE"), 1);
}

TEST(Motion, WhenAnAxisIsSentSomewhere_ThenItGoesThereWithinItsLimits) {
  ModelRig rig(
      "[components.a]\ntype = \"axis\"\ntop_speed = \"0.5 m/s\"\nacceleration = \"2 m/s2\"\nenable = "
      "\"true\"\ntarget = \"800 mm\"\n"
      "[terminals]\nTHERE = { address = \"%IX0.0\", from = \"a.there\" }\n");
  double fastest = 0.0, last = 0.0, most = 0.0;
  for (int i = 0; i < 400; ++i) {
    ASSERT_TRUE(rig.run(0.01));
    const double speed = rig.truth("a.speed");
    most = std::max(most, std::abs(speed - last) / 0.01);
    fastest = std::max(fastest, speed);
    last = speed;
  }
  EXPECT_NEAR(rig.truth("a.position"), 800.0, 0.5);
  EXPECT_EQ(rig.sensor("THERE"), 1);
  EXPECT_LE(fastest, 500.1);
  EXPECT_GT(fastest, 490.0);
  EXPECT_LE(most, 2010.0);
}

TEST(Motion, WhenAButtonIsPressed_ThenItsContactAndTheLampFollow) {
  ModelRig rig(
      "[components.stop]\ntype = \"push_button\"\ncontact = \"opens\"\n[components.lamp]\ntype = "
      "\"lamp\"\ncommand = \"stop\"\n"
      "[terminals]\nSTOP = { address = \"%IX0.0\", from = \"stop\" }\n");
  EXPECT_EQ(rig.sensor("STOP"), 1);
  EXPECT_EQ(rig.truth("lamp.lit"), 1.0);
  ASSERT_TRUE(rig.plant().inject_fault("stop.pressed", 1.0));
  EXPECT_EQ(rig.sensor("STOP"), 0);
  ASSERT_TRUE(rig.plant().clear_fault("stop.pressed"));
  ASSERT_TRUE(rig.plant().inject_fault("stop.broken_wire", 1.0));
  EXPECT_EQ(rig.sensor("STOP"), 0);
}

TEST(Trainer, WhenAFirstOrderPlantIsStepped_ThenItAnswersAfterItsDeadTime) {
  ModelRig rig(
      "[components.p]\ntype = \"first_order\"\ngain = 2\ntime_constant = \"10 s\"\ndead_time = \"3 "
      "s\"\ninput = \"card\"\n"
      "[components.card]\ntype = \"analog_output\"\nlow = \"0 percent\"\nhigh = \"100 percent\"\ncounts = "
      "\"U\"\n[terminals]\nU = \"%QW0\"\n");
  ASSERT_TRUE(rig.run(5.0));
  rig.set("U", 27648);
  ASSERT_TRUE(rig.run(2.95));
  EXPECT_EQ(rig.truth("p.value"), 0.0);
  ASSERT_TRUE(rig.run(10.05));
  EXPECT_NEAR(rig.truth("p.value"), 200.0 * (1.0 - std::exp(-1.0)),
              200.0 * 0.02 / 10.0);  // the dead time to a sample or two
}

// In balance the same flows through both: h = (q / a)^2 / 2 g.
TEST(Trainer, WhenADoubleTankHasSettled_ThenBothHaveTorricellisHeight) {
  ModelRig rig("[components.p]\ntype = \"double_tank\"\ninflow = \"100 percent\"\n");
  ASSERT_TRUE(rig.run(2000.0));
  const double height_cm = 100.0 * std::pow(1e-4 / 0.5e-4, 2) / (2.0 * 9.80665);
  EXPECT_NEAR(rig.truth("p.upper"), height_cm, 1e-3);
  EXPECT_NEAR(rig.truth("p.lower"), height_cm, 1e-3);
}

TEST(Trainer, WhenAPendulumHasNoFriction_ThenItsEnergyStays) {
  ModelRig rig(
      "[components.p]\ntype = \"pendulum\"\ncart_friction = \"0 N/(m/s)\"\nrod_friction = \"0 N m "
      "s\"\nstart_angle = \"10 degree\"\npush = \"0 percent\"\n"
      "[solver]\nrelative_tolerance = 1e-10\n");
  const double before = rig.truth("p.energy");
  ASSERT_TRUE(rig.run(10.0));
  EXPECT_NEAR(rig.truth("p.energy"), before, 1e-5);
  EXPECT_GT(std::abs(rig.truth("p.angle")), 9.9);
}

// Near upright it falls by e^(t sqrt(g/l)) when the cart is heavy beside the rod.
TEST(Trainer, WhenAPendulumFalls_ThenItsTimeConstantIsThatOfItsLength) {
  ModelRig rig(
      "[components.p]\ntype = \"pendulum\"\ncart_mass = \"1000 kg\"\nrod_mass = \"1 g\"\ncart_friction = \"0 "
      "N/(m/s)\"\nrod_friction = \"0 N m s\"\nstart_angle = \"0.01 degree\"\npush = \"0 percent\"\n"
      "[solver]\nrelative_tolerance = 1e-9\n");
  ASSERT_TRUE(rig.run(1.0));
  EXPECT_NEAR(rig.truth("p.angle"), 0.01 * std::cosh(std::sqrt(9.80665 / 0.5)), 1e-4);
}

TEST(Mixer, WhenItTurns_ThenItIsReadyAfterThreeTimeConstants) {
  ModelRig rig(
      "[components.m]\ntype = \"mixer\"\nmixing = \"20 s\"\ncommand = \"true\"\n[terminals]\nREADY = { "
      "address = \"%IX0.0\", from = \"m.ready\" }\n");
  ASSERT_TRUE(rig.run(59.9));
  EXPECT_EQ(rig.sensor("READY"), 0);
  ASSERT_TRUE(rig.run(0.1));  // 20 ln 20 = 59.91 s
  EXPECT_EQ(rig.sensor("READY"), 1);
}

}  // namespace
}  // namespace stepwright::components
