// Sensors, cards and their faults.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/plant_models/components/model_rig.h"

namespace stepwright::components {
namespace {

const std::string kTank = "[components.t]\ntype = \"tank\"\nvolume = \"1 m3\"\nstart = \"50 percent\"\n";
const std::string kCard =
    "[components.c]\ntype = \"analog_input\"\nof = \"s\"\nlow = \"0 percent\"\nhigh = \"100 percent\"\n"
    "[terminals]\nL = { address = \"%IW0\", from = \"c\" }\n";

TEST(Sensor, WhenItIsExact_ThenACardShowsItsShareOfTheRange) {
  ModelRig rig(kTank + "[components.s]\ntype = \"level_sensor\"\nof = \"t\"\n" + kCard);
  EXPECT_EQ(rig.sensor("L"), 13824);
  ASSERT_TRUE(rig.plant().inject_fault("s.offset", 10.0));
  EXPECT_EQ(rig.sensor("L"), 16589);
  ASSERT_TRUE(rig.plant().clear_fault("s.offset"));
  ASSERT_TRUE(rig.plant().inject_fault("c.broken_wire", 1.0));
  EXPECT_EQ(rig.sensor("L"), 32767);
  ASSERT_TRUE(rig.plant().clear_fault("c.broken_wire"));
  ASSERT_TRUE(rig.plant().inject_fault("s.drift", 1.0));
  ASSERT_TRUE(rig.run(10.0));
  EXPECT_EQ(rig.sensor("L"), 16589);
  ASSERT_TRUE(rig.plant().inject_fault("s.frozen", 1.0));
  ASSERT_TRUE(rig.run(10.0));
  EXPECT_EQ(rig.sensor("L"), 16589);
}

TEST(Sensor, WhenACardShowsIt_ThenItsDescriptionTurnsTheTrueValueIntoCounts) {
  ModelRig rig(kTank + "[components.s]\ntype = \"level_sensor\"\nof = \"t\"\nbias = \"5 percent\"\n" + kCard);
  const auto& sensors = rig.plant().description().sensors;
  ASSERT_EQ(sensors.size(), 1u);
  EXPECT_EQ(sensors[0].name, "L");
  EXPECT_EQ(sensors[0].measures, "t.level");
  EXPECT_NEAR(sensors[0].counts_at_zero + sensors[0].counts_per_unit * rig.truth("t.level"), 13824.0, 0.5);
}

TEST(Sensor, WhenItHasNoise_ThenReadingsScatterAsSaidAndRepeat) {
  const std::string text =
      kTank + "[components.s]\ntype = \"level_sensor\"\nof = \"t\"\nnoise = \"1 percent\"\n" + kCard;
  ModelRig one(text), other(text);
  double sum = 0.0, squares = 0.0;
  constexpr int kReadings = 4000;
  for (int i = 0; i < kReadings; ++i) {
    ASSERT_TRUE(one.run(0.01));
    ASSERT_TRUE(other.run(0.01));
    ASSERT_EQ(one.sensor("L"), other.sensor("L"));
    const double error = one.truth("s.value") - 50.0;
    sum += error;
    squares += error * error;
  }
  EXPECT_NEAR(sum / kReadings, 0.0, 0.05);
  EXPECT_NEAR(std::sqrt(squares / kReadings), 1.0, 0.05);
}

TEST(Sensor, WhenItFilters_ThenItFollowsWithItsTimeConstant) {
  ModelRig rig(
      kTank +
      "[components.s]\ntype = \"level_sensor\"\nof = \"t\"\nfilter = \"10 s\"\nfirst = \"0 percent\"\n" +
      kCard);
  ASSERT_TRUE(rig.run(10.0));
  EXPECT_NEAR(rig.truth("s.value"), 50.0 * (1.0 - std::exp(-1.0)), 1e-4);
}

TEST(Sensor, WhenItHasADelay_ThenItShowsWhatWasThere) {
  ModelRig rig(R"toml([components.from]
type = "source"
pressure = "1 bar"
[components.t]
type = "tank"
volume = "100 l"
[components.p]
type = "pipe"
flow = "1 l/s"
pressure_drop = "1 bar"
in = "from"
out = "t"
[components.now]
type = "level_sensor"
of = "t"
[components.late]
type = "level_sensor"
of = "t"
delay = "2 s"
)toml");
  ASSERT_TRUE(rig.run(1.5));
  EXPECT_DOUBLE_EQ(rig.truth("late.value"), 0.0);
  ASSERT_TRUE(rig.run(3.5));
  const double then = rig.truth("now.value");
  ASSERT_TRUE(rig.run(2.0));
  EXPECT_GT(rig.truth("now.value"), then + 1.0);
  EXPECT_NEAR(rig.truth("late.value"), then, 0.03);  // a sample of 10 ms is 0.01 percent
}

TEST(Sensor, WhenItMeasuresFlowOrTemperatureOrPressure_ThenItShowsThem) {
  ModelRig rig(
      "[components.m]\ntype = \"source\"\npressure = \"2 bar\"\n[components.d]\ntype = \"sink\"\n"
      "[components.p]\ntype = \"pipe\"\nflow = \"1 l/s\"\npressure_drop = \"2 bar\"\nin = \"m\"\nout = "
      "\"d\"\n"
      "[components.f]\ntype = \"flow_sensor\"\nof = \"p\"\n[components.g]\ntype = \"pressure_sensor\"\nof = "
      "\"m\"\n"
      "[components.t]\ntype = \"tank\"\nvolume = \"1 l\"\ntemperature = \"42 degC\"\n[components.h]\ntype = "
      "\"temperature_sensor\"\nof = \"t\"\n");
  ASSERT_TRUE(rig.run(0.1));
  EXPECT_NEAR(rig.truth("f.value"), 1.0, 1e-6);
  EXPECT_NEAR(rig.truth("g.value"), 2.0, 1e-12);
  EXPECT_NEAR(rig.truth("h.value"), 42.0, 1e-9);  // as people read it
}

TEST(Fault, WhenItIsUnknownOrOutOfRange_ThenItIsRefusedWithAHint) {
  ModelRig rig(kTank + "[components.s]\ntype = \"level_sensor\"\nof = \"t\"\n" + kCard);
  auto unknown = rig.plant().inject_fault("t.leek", 1.0);
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error()[0].code, std::string("C0311"));
  EXPECT_NE(unknown.error()[0].hint.find("t.leak"), std::string::npos);
  auto wide = rig.plant().inject_fault("t.leak", 101.0);
  ASSERT_FALSE(wide);
  EXPECT_EQ(wide.error()[0].code, std::string("C0312"));
  EXPECT_FALSE(rig.plant().inject_fault("t.leak", std::nan("")));
}

}  // namespace
}  // namespace stepwright::components
