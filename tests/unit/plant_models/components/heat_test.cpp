// Heat: analytic answers, and none of it is lost.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/plant_models/components/model_rig.h"

namespace stepwright::components {
namespace {

const std::string kWarm =
    "[components.t]\ntype = \"tank\"\nvolume = \"100 l\"\nstart = \"100 percent\"\nthermal = "
    "\"yes\"\ntemperature = \"20 degC\"\n";

// P t = m c dT.
TEST(Heat, WhenATankIsHeated_ThenItsTemperatureRisesByPowerOverHeatCapacity) {
  ModelRig rig(
      kWarm +
      "[components.h]\ntype = \"heater\"\npower = \"10 kW\"\ntime_constant = \"1 s\"\nheat = \"t\"\n");
  ASSERT_TRUE(rig.run(600.0));
  EXPECT_NEAR(rig.truth("t.temperature_out"), 20.0 + 1e4 * (600.0 - 1.0) / (100.0 * 4186.0), 1e-3);
}

// Newton's law of cooling: T - T_c falls by e^(-UA t / (m c)).
TEST(Heat, WhenATankIsCooled_ThenItNearsTheCoolantExponentially) {
  ModelRig rig(kWarm +
               "[components.c]\ntype = \"cooler\"\nconductance = \"418.6 W/K\"\ncoolant = \"10 degC\"\nheat "
               "= \"t\"\n");
  ASSERT_TRUE(rig.run(1000.0));
  EXPECT_NEAR(rig.truth("t.temperature_out"), 10.0 + 10.0 * std::exp(-1.0), 5e-3);
}

TEST(Heat, WhenTwoTanksShareAWall_ThenTheirMeanStaysAndTheirDifferenceFades) {
  ModelRig rig(
      kWarm +
      "[components.u]\ntype = \"tank\"\nvolume = \"100 l\"\nstart = \"100 percent\"\nthermal = "
      "\"yes\"\ntemperature = \"60 degC\"\n"
      "[components.x]\ntype = \"heat_exchanger\"\nconductance = \"418.6 W/K\"\nhot = \"u\"\ncold = \"t\"\n");
  ASSERT_TRUE(rig.run(500.0));
  EXPECT_NEAR(rig.truth("u.temperature_out") + rig.truth("t.temperature_out"), 80.0, 1e-6);
  EXPECT_NEAR(rig.truth("u.temperature_out") - rig.truth("t.temperature_out"), 40.0 * std::exp(-1.0), 5e-3);
}

// It has no surface that touches anything; its heat goes with what flows out.
TEST(Heat, WhenATankIsEmptyOrIsEmptied_ThenItGivesAndTakesNoneAndItsTemperatureIsOneThatWasThere) {
  const std::string solver[] = {"", "[solver]\nmethod = \"implicit\"\n"};
  for (const std::string& method : solver) {
    ModelRig rig(method +
                 "[components.t]\ntype = \"tank\"\nvolume = \"50 l\"\nstart = \"10 percent\"\nthermal = "
                 "\"yes\"\ntemperature = \"60 degC\"\nheat_loss = \"20 W/K\"\n"
                 "[components.e]\ntype = \"tank\"\nvolume = \"100 l\"\nthermal = \"yes\"\n"
                 "[components.h]\ntype = \"heater\"\npower = \"10 kW\"\nheat = \"e\"\n"
                 "[components.c]\ntype = \"cooler\"\nconductance = \"500 W/K\"\nheat = \"e\"\n"
                 "[components.x]\ntype = \"heat_exchanger\"\nconductance = \"500 W/K\"\nhot = \"t\"\ncold = "
                 "\"e\"\n");
    ASSERT_TRUE(rig.run(10.0));
    EXPECT_NEAR(rig.truth("e.temperature_out"), 20.0, 1e-6) << method;
    EXPECT_EQ(rig.truth("x.power"), 0.0);
    EXPECT_EQ(rig.truth("h.power_out"), 0.0);
    ASSERT_TRUE(rig.plant().inject_fault("t.leak", 5.0));
    for (int second = 11; second <= 200; ++second) {
      ASSERT_TRUE(rig.run(second));
      const double temperature = rig.truth("t.temperature_out");
      ASSERT_GT(temperature, 20.0) << method << " at " << second;
      ASSERT_LT(temperature, 60.0) << method << " at " << second;
    }
    EXPECT_NEAR(rig.truth("t.level"), 0.0, 1e-3);
  }
}

// One litre of 80 degrees and three of 20 give 35.
TEST(Heat, WhenWarmAndColdLiquidMeet_ThenTheMixtureHasTheirMean) {
  ModelRig rig(
      "[components.hot]\ntype = \"source\"\npressure = \"1 bar\"\ntemperature = \"80 "
      "degC\"\n[components.cold]\ntype = \"source\"\npressure = \"1 bar\"\n"
      "[components.p]\ntype = \"pipe\"\nflow = \"0.01 l/s\"\npressure_drop = \"1 bar\"\nin = \"hot\"\nout = "
      "\"m.in\"\n"
      "[components.q]\ntype = \"pipe\"\nflow = \"0.03 l/s\"\npressure_drop = \"1 bar\"\nin = \"cold\"\nout = "
      "\"m.in\"\n"
      "[components.m]\ntype = \"pipe\"\nflow = \"10 l/s\"\npressure_drop = \"1 bar\"\nout = \"t\"\n"
      "[components.t]\ntype = \"tank\"\nvolume = \"1 m3\"\nheight = \"1 mm\"\nthermal = \"yes\"\n");
  ASSERT_TRUE(rig.run(1000.0));
  EXPECT_NEAR(rig.truth("t.temperature_out"), 35.0, 1e-2);
}

}  // namespace
}  // namespace stepwright::components
