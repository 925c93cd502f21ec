// Components that liquid flows through, against analytic answers; nothing of it is lost.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/plant_models/components/model_rig.h"

namespace stepwright::components {
namespace {

std::string tank(const std::string& name, const std::string& more) {
  return "[components." + name + "]\ntype = \"tank\"\n" + more;
}

// A laminar outlet: dV/dt = -k V, so the level falls by e^(-k t).
TEST(Liquid, WhenATankEmptiesThroughALaminarPipe_ThenItsLevelFallsExponentially) {
  ModelRig rig(tank("t", "volume = \"1 m3\"\nheight = \"2 m\"\nstart = \"80 percent\"\n") +
               "[components.p]\ntype = \"pipe\"\nlaw = \"laminar\"\nflow = \"10 l/s\"\npressure_drop = "
               "\"19613.3 Pa\"\nin = \"t\"\nout = \"d\"\n"
               "[components.d]\ntype = \"sink\"\n");
  ASSERT_TRUE(rig.run(100.0));
  EXPECT_NEAR(rig.truth("t.level"), 80.0 * std::exp(-1.0), 1e-3);
  EXPECT_NEAR(rig.truth("d.received"), 800.0 * (1.0 - std::exp(-1.0)), 1e-2);
  EXPECT_NEAR(rig.truth("plant.liquid") / 800.0, 1.0, 1e-12);
}

// Torricelli: sqrt(h) falls linearly, empty after T = (2 V0 / q0).
TEST(Liquid, WhenATankEmptiesThroughATurbulentPipe_ThenTheRootOfItsLevelFallsLinearly) {
  ModelRig rig(tank("t", "volume = \"1 m3\"\nheight = \"1 m\"\nstart = \"100 percent\"\n") +
               "[components.p]\ntype = \"pipe\"\nflow = \"10 l/s\"\npressure_drop = \"9806.65 Pa\"\nin = "
               "\"t\"\nout = \"d\"\n"
               "[components.d]\ntype = \"sink\"\n");
  ASSERT_TRUE(rig.run(100.0));
  EXPECT_NEAR(rig.truth("t.level"), 25.0, 1e-3);  // half of the 200 s
}

TEST(Liquid, WhenPipesAreInARow_ThenTheFlowIsThatOfTheirSum) {
  // Two laminar pipes and a valve of the same kind of resistance between a main and a drain: KINSOL finds the
  // pressures.
  ModelRig rig(
      "[components.main]\ntype = \"source\"\npressure = \"3 bar\"\n"
      "[components.p1]\ntype = \"pipe\"\nlaw = \"laminar\"\nflow = \"1 l/s\"\npressure_drop = \"1 bar\"\nin "
      "= \"main\"\nout = \"p2.in\"\n"
      "[components.p2]\ntype = \"pipe\"\nlaw = \"laminar\"\nflow = \"1 l/s\"\npressure_drop = \"2 bar\"\nout "
      "= \"p3.in\"\n"
      "[components.p3]\ntype = \"pipe\"\nlaw = \"laminar\"\nflow = \"1 l/s\"\npressure_drop = \"3 bar\"\nout "
      "= \"drain\"\n"
      "[components.drain]\ntype = \"sink\"\n"
      "[components.gauge]\ntype = \"pressure_sensor\"\nof = \"p2.in\"\n");
  ASSERT_EQ(rig.plant().model().loops.size(), 1u);
  ASSERT_TRUE(rig.run(3600.0));
  EXPECT_NEAR(rig.truth("p2.flow_out"), 0.5, 1e-9);
  EXPECT_NEAR(rig.truth("gauge.value"), 2.5, 1e-9);
  EXPECT_NEAR(rig.truth("main.delivered"), 1800.0, 1e-6);
  EXPECT_NEAR(rig.truth("plant.liquid"), 0.0, 1e-6 * 1.8);  // 1e-9 of what has flowed
}

TEST(Liquid, WhenAPumpAndAValveAreInARow_ThenTheirFlowsAreOneAndLiquidIsKept) {
  ModelRig rig(tank("a", "volume = \"2 m3\"\nheight = \"2 m\"\nstart = \"90 percent\"\n") +
               tank("b", "volume = \"2 m3\"\nheight = \"2 m\"\nstart = \"10 percent\"\n") +
               "[components.p]\ntype = \"pump\"\nhead = \"20 m\"\nresistance = \"5000 m/(m3/s)\"\nin = "
               "\"a\"\nout = \"v.in\"\ncommand = \"P\"\n"
               "[components.v]\ntype = \"control_valve\"\nkv = \"10 m3/h\"\ntravel = \"5 s\"\nout = "
               "\"b\"\ncommand = \"card\"\n"
               "[components.card]\ntype = \"analog_output\"\nlow = \"0 percent\"\nhigh = \"100 "
               "percent\"\ncounts = \"V\"\n"
               "[components.back]\ntype = \"pipe\"\nflow = \"0.3 l/s\"\npressure_drop = \"0.1 bar\"\nin = "
               "\"b\"\nout = \"a\"\n"
               "[terminals]\nP = \"%QX0.0\"\nV = \"%QW1\"\n");
  const double before = rig.truth("plant.liquid");
  rig.set("P", 1);
  for (int minute = 0; minute < 60; ++minute) {
    rig.set("V", minute % 3 == 0 ? 27648 : minute % 3 == 1 ? 9000 : 0);
    ASSERT_TRUE(rig.run(60.0)) << minute;
    ASSERT_NEAR(rig.truth("p.flow"), rig.truth("v.flow"), 1e-9);
    ASSERT_NEAR(rig.truth("plant.liquid") / before, 1.0, 1e-9) << minute;
  }
  EXPECT_GT(rig.truth("b.level"), 10.0);
}

// Kv is the flow of water in m3/h at 1 bar.
TEST(Liquid, WhenAValveIsFullyOpen_ThenItsFlowIsKvTimesTheRootOfTheDrop) {
  ModelRig rig(
      "[components.s]\ntype = \"source\"\npressure = \"4 bar\"\n[components.d]\ntype = \"sink\"\n"
      "[components.v]\ntype = \"control_valve\"\nkv = \"3.6 m3/h\"\ntravel = \"10 s\"\nin = \"s\"\nout = "
      "\"d\"\ncommand = \"100 percent\"\n"
      "[components.o]\ntype = \"on_off_valve\"\nkv = \"3.6 m3/h\"\ntravel = \"2 s\"\nin = \"s\"\nout = "
      "\"d\"\ncommand = \"O\"\n"
      "[terminals]\nO = \"%QX0.0\"\nopened = { address = \"%IX0.0\", from = \"o.opened\" }\nclosed = { "
      "address = \"%IX0.1\", from = \"o.closed\" }\n");
  ASSERT_TRUE(rig.run(5.0));
  EXPECT_NEAR(rig.truth("v.position"), 50.0, 1e-3);
  ASSERT_TRUE(rig.run(10.0));
  EXPECT_NEAR(rig.truth("v.flow"), 2.0, 1e-5);
  EXPECT_EQ(rig.sensor("closed"), 1);
  rig.set("O", 1);
  ASSERT_TRUE(rig.run(1.0));
  EXPECT_NEAR(rig.truth("o.position"), 50.0, 1e-6);
  EXPECT_EQ(rig.sensor("closed") + rig.sensor("opened"), 0);
  ASSERT_TRUE(rig.run(1.01));
  EXPECT_EQ(rig.truth("o.position"), 100.0);
  EXPECT_EQ(rig.sensor("opened"), 1);
  EXPECT_NEAR(rig.truth("o.flow"), 2.0, 1e-5);
  ASSERT_TRUE(rig.plant().inject_fault("o.stuck", 1.0));
  rig.set("O", 0);
  ASSERT_TRUE(rig.run(5.0));
  EXPECT_EQ(rig.truth("o.position"), 100.0);
  ASSERT_TRUE(rig.plant().clear_fault("o.stuck"));
  ASSERT_TRUE(rig.plant().inject_fault("o.slow", 2.0));
  ASSERT_TRUE(rig.run(2.0));
  EXPECT_NEAR(rig.truth("o.position"), 50.0, 1e-6);
}

// A cone: h = H (V/C)^(1/3).
TEST(Liquid, WhenATankIsACone_ThenItsHeightIsTheCubeRootOfItsLevel) {
  ModelRig rig(
      tank("t", "volume = \"1 m3\"\nheight = \"2 m\"\nshape = \"cone\"\nstart = \"12.5 percent\"\n") +
      "[components.l]\ntype = \"level_sensor\"\nof = \"t\"\n");
  EXPECT_NEAR(rig.truth("t.liquid_height"), 1.0, 1e-12);
}

// Boyle: half the gas at twice the pressure.
TEST(Liquid, WhenAClosedTankFills_ThenItsGasIsCompressed) {
  ModelRig rig(
      "[components.t]\ntype = \"closed_tank\"\nvolume = \"100 l\"\nheight = \"0.5 m\"\n"
      "[components.s]\ntype = \"source\"\npressure = \"106228.325 Pa\"\n"  // 101325 Pa and a quarter of a
                                                                           // metre of water
      "[components.p]\ntype = \"pipe\"\nlaw = \"laminar\"\nflow = \"1 l/s\"\npressure_drop = \"1 bar\"\nin = "
      "\"s\"\nout = \"t\"\n");
  ASSERT_TRUE(rig.run(2000.0));
  const double level = rig.truth("t.level") / 100.0;
  EXPECT_NEAR(1e5 * rig.truth("t.pressure") + 9806.65 * 0.5 * level, 106228.325, 1.0);
  EXPECT_NEAR((rig.truth("t.pressure") + 1.01325) * (1.0 - rig.truth("t.level") / 100.0), 1.01325, 1e-9);
  EXPECT_NEAR(rig.truth("t.level"), 50.0, 1.0);
}

TEST(Liquid, WhenAThreeWayValveIsHalfOpen_ThenItDividesEvenly) {
  ModelRig rig(
      "[components.s]\ntype = \"source\"\npressure = \"1 bar\"\n[components.a]\ntype = "
      "\"sink\"\n[components.b]\ntype = \"sink\"\n"
      "[components.v]\ntype = \"three_way_valve\"\nkv = \"3.6 m3/h\"\nstart = \"50 percent\"\ncommon = "
      "\"s\"\na = \"a\"\nb = \"b\"\ncommand = \"50 percent\"\n");
  ASSERT_TRUE(rig.run(100.0));
  EXPECT_NEAR(rig.truth("a.received"), 50.0, 1e-3);
  EXPECT_NEAR(rig.truth("b.received"), rig.truth("a.received"), 1e-9);
}

TEST(Liquid, WhenATankOverflowsAndLeaks_ThenTheFloorHasIt) {
  ModelRig rig(tank("t", "volume = \"10 l\"\nstart = \"100 percent\"\n") +
               "[components.s]\ntype = \"source\"\npressure = \"1 bar\"\n"
               "[components.p]\ntype = \"pipe\"\nflow = \"1 l/s\"\npressure_drop = \"1 bar\"\nin = "
               "\"s\"\nout = \"t\"\n");
  ASSERT_TRUE(rig.plant().inject_fault("t.leak", 1.0));
  ASSERT_TRUE(rig.run(60.0));
  EXPECT_GT(rig.truth("floor.volume"), 50.0);
  EXPECT_NEAR(rig.truth("plant.liquid"), 10.0, 1e-8);
}

// A row of sixty tanks, implicitly with a sparse Jacobian and explicitly: the same levels.
TEST(Liquid, WhenARowOfTanksIsSolvedImplicitly_ThenItsLevelsAreThoseOfTheExplicitMethod) {
  std::string text;
  for (int i = 0; i < 60; ++i) {
    const std::string n = std::to_string(i);
    text += tank("t" + n,
                 "volume = \"100 l\"\nstart = \"" + std::string(i % 3 == 0 ? "90" : "30") + " percent\"\n");
    if (i == 0) continue;
    text +=
        "[components.p" + n +
        "]\ntype = \"pipe\"\nlaw = \"laminar\"\nflow = \"1 l/s\"\npressure_drop = \"0.05 bar\"\nin = \"t" +
        std::to_string(i - 1) + "\"\nout = \"t" + n + "\"\n";
  }
  ModelRig explicitly(text);
  ModelRig implicitly("[solver]\nmethod = \"implicit\"\nrelative_tolerance = 1e-8\n" + text);
  ASSERT_TRUE(explicitly.run(60.0));
  ASSERT_TRUE(implicitly.run(60.0));
  for (int i = 0; i < 60; i += 7) {
    const std::string level = "t" + std::to_string(i) + ".level";
    EXPECT_NEAR(explicitly.truth(level), implicitly.truth(level), 1e-3) << level;
  }
  EXPECT_NEAR(implicitly.truth("plant.liquid"), 3000.0, 1e-3);
}

}  // namespace
}  // namespace stepwright::components
