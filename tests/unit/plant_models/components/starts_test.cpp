// States whose start follows from inputs, other states, faults and the time.

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/plant_models/components/model_rig.h"

namespace stepwright::components {
namespace {

const std::string kLag = R"toml([types.lag]
parameters.time = { unit = "s", default = "5 s" }
parameters.k = { default = "2" }
inputs.in = { unit = "m" }
inputs.sw = { switch = true, default = "false" }
states.z = { unit = "m", start = "k * y", derivative = "(x - z) / time" }
states.y = { unit = "m", start = "x", derivative = "(x - y) / time" }
states.x = { unit = "m", start = "in", derivative = "(in - x) / time" }
states.s = { start = "sw ? 7 : 3", derivative = "0" }
outputs.value = { unit = "m", value = "x" }
outputs.why = { unit = "m", value = "y" }
outputs.zed = { unit = "m", value = "z" }
outputs.ess = { value = "s" }
)toml";

std::string card_of(const std::string& of) {
  return "[components.card]\ntype = \"analog_input\"\nof = \"" + of + "\"\nlow = \"0 m\"\nhigh = \"10 m\"\n";
}

TEST(Starts, WhenAStartIsAnInput_ThenItBeginsWithWhatComesIn) {
  ModelRig rig(kLag + "[components.a]\ntype = \"lag\"\nin = \"7 m\"\nsw = \"true\"\n" + card_of("a"));
  EXPECT_EQ(rig.truth("a.value"), 7.0);
  EXPECT_EQ(rig.truth("a.ess"), 7.0);
  ASSERT_TRUE(rig.run(1.0));
  EXPECT_NEAR(rig.truth("a.value"), 7.0, 1e-9);
}

TEST(Starts, WhenAStartIsAnotherState_ThenTheirOrderInTheFileIsNoMatter) {
  ModelRig rig(kLag + "[components.a]\ntype = \"lag\"\nin = \"7 m\"\n" + card_of("a"));
  EXPECT_EQ(rig.truth("a.why"), 7.0);
  EXPECT_EQ(rig.truth("a.zed"), 14.0);
  EXPECT_EQ(rig.truth("a.ess"), 3.0);
}

TEST(Starts, WhenComponentsFollowEachOther_ThenEachBeginsWithWhatTheOneBeforeBegins) {
  ModelRig rig(kLag + "[components.c]\ntype = \"lag\"\nin = \"b.zed\"\n" +
               "[components.b]\ntype = \"lag\"\nin = \"a.zed\"\n" +
               "[components.a]\ntype = \"lag\"\nin = \"tank.liquid_height\"\n" +
               "[components.tank]\ntype = \"tank\"\nvolume = \"1 m3\"\nheight = \"3 m\"\nstart = \"50 "
               "percent\"\n" +
               card_of("c"));
  EXPECT_NEAR(rig.truth("a.value"), 1.5, 1e-12);
  EXPECT_NEAR(rig.truth("b.value"), 3.0, 1e-12);
  EXPECT_NEAR(rig.truth("c.zed"), 12.0, 1e-12);
}

TEST(Starts, WhenAStartReadsAFaultOrTheTime_ThenTheFaultRestsAndTheTimeIsZero) {
  ModelRig rig(R"toml([types.lag]
parameters.x0 = { unit = "m", default = "5 m" }
parameters.time = { unit = "s", default = "5 s" }
faults.f = { unit = "percent", low = 0, high = 100 }
faults.r = { low = 0, high = 4, rest = "3" }
states.x = { unit = "m", start = "x0 * (1 + f)", derivative = "0" }
states.y = { unit = "m", start = "x0 * r", derivative = "0" }
states.w = { unit = "m", start = "2 * t * x0 / time + x0", derivative = "0" }
outputs.value = { unit = "m", value = "x" }
outputs.why = { unit = "m", value = "y" }
outputs.double_you = { unit = "m", value = "w" }
[components.a]
type = "lag"
)toml" + card_of("a"));
  EXPECT_EQ(rig.truth("a.value"), 5.0);
  EXPECT_EQ(rig.truth("a.why"), 15.0);
  EXPECT_EQ(rig.truth("a.double_you"), 5.0);
}

// What a switch saw before all starts were known is forgotten.
TEST(Starts, WhenAStartFollowsFromASwitch_ThenTheSwitchHasSeenWhatIsThere) {
  ModelRig rig(R"toml([types.place]
inputs.in = { unit = "m" }
states.x = { unit = "m", start = "in", derivative = "0" }
outputs.value = { unit = "m", value = "x" }
[types.light]
inputs.on = { switch = true }
states.s = { start = "on ? 7 : 3", derivative = "0" }
outputs.value = { value = "s" }
[components.light]
type = "light"
on = "near"
[components.near]
type = "position_switch"
of = "place"
at = "0 m"
[components.far]
type = "position_switch"
of = "place"
at = "2 m"
[components.other]
type = "light"
on = "far"
[components.place]
type = "place"
in = "2 m"
)toml");
  EXPECT_EQ(rig.truth("light.value"), 3.0);
  EXPECT_EQ(rig.truth("other.value"), 7.0);
}

void expect_refused(const std::string& text, const std::string& code, std::size_t line,
                    const std::string& says) {
  const auto plant = ModelRig::load(text);
  ASSERT_FALSE(plant) << says;
  ASSERT_EQ(plant.error().size(), 1u) << result::to_string(plant.error());
  EXPECT_EQ(plant.error()[0].code, code);
  EXPECT_EQ(plant.error()[0].where.line, line);
  EXPECT_NE(plant.error()[0].message.find(says), std::string::npos) << result::to_string(plant.error());
}

TEST(Starts, WhenStartsNeedEachOther_ThenTheCircleIsRefusedAtItsPlace) {
  const std::string one = R"toml([types.one]
inputs.in = { unit = "m" }
states.x = { unit = "m", start = "0.5 * in", derivative = "0" }
outputs.value = { unit = "m", value = "x" }
[components.a]
type = "one"
in = "b"
[components.b]
type = "one"
in = "a"
)toml";
  expect_refused(one, "C0346", 3, "each of these starts needs another one: a.x, b.x");
  const std::string two = R"toml([types.two]
states.x = { unit = "m", start = "y", derivative = "0" }
states.y = { unit = "m", start = "x", derivative = "0" }
outputs.value = { unit = "m", value = "x" }
[components.a]
type = "two"
)toml" + card_of("a");
  expect_refused(two, "C0346", 2, "a.x, a.y");
}

// An output that shows another state is no circle.
TEST(Starts, WhenOnlyDerivativesAreInACircle_ThenTheStartsAreFine) {
  ModelRig rig(R"toml([types.process]
parameters.time = { unit = "s", default = "5 s" }
inputs.set = { unit = "m" }
states.level = { unit = "m", start = "4 m", derivative = "(valve - level) / time" }
states.valve = { unit = "m", start = "set", derivative = "(set - valve) / time" }
outputs.value = { unit = "m", value = "level" }
[types.control]
parameters.time = { unit = "s", default = "5 s" }
inputs.in = { unit = "m" }
states.sum = { unit = "m", start = "2 * in", derivative = "in / time" }
outputs.value = { unit = "m", value = "sum" }
outputs.seen = { unit = "m", value = "in" }
[components.p]
type = "process"
set = "c.value"
[components.c]
type = "control"
in = "p.value"
)toml");
  EXPECT_EQ(rig.truth("c.value"), 8.0);
  ASSERT_TRUE(rig.run(0.1));
}

TEST(Starts, WhenAStartIsNoNumber_ThenItsLineIsTold) {
  expect_refused(R"toml([types.one]
inputs.in = { unit = "m" }
states.x = { start = "in / (in - in)", derivative = "0" }
outputs.value = { value = "x" }
[components.a]
type = "one"
in = "1 m"
[components.b]
type = "lamp"
command = "true"
)toml",
                 "C0349", 3, "the start of 'x' of 'a' is no finite number");
}

std::string sensor_of_water(const std::string& more) {
  return R"toml([components.t]
type = "tank"
volume = "1 m3"
temperature = "60 degC"
[components.s]
type = "temperature_sensor"
of = "t.temperature_out"
filter = "10 s"
)toml" + more;
}

TEST(Sensor, WhenItHasAFilter_ThenItBeginsWithWhatItMeasures) {
  ModelRig rig(sensor_of_water(""));
  EXPECT_NEAR(rig.truth("s.value"), 60.0, 1e-9);
  ModelRig other(sensor_of_water("first = \"20 degC\"\n"));
  EXPECT_NEAR(other.truth("s.value"), 20.0, 1e-9);
}

TEST(OwnType, WhenTheDefaultOfAParameterIsNoFigure_ThenItsLineIsTold) {
  expect_refused(R"toml([types.one]
parameters.a = { unit = "m", default = "2 s" }
outputs.value = { unit = "m", value = "a" }
[components.a]
type = "one"
)toml" + card_of("a"),
                 "C0341", 2, "the unit of 'default' does not fit");
}

}  // namespace
}  // namespace stepwright::components
