// Types that a file describes itself, and assemblies.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/plant_models/components/model_rig.h"

namespace stepwright::components {
namespace {

const std::string kReactor = R"toml([types.reactor]
meaning = "a substance that decays"
parameters.rate = { unit = "1/s", default = "0.1 1/s" }
parameters.first = { unit = "kg/m3" }
inputs.feed = { unit = "kg/(m3 s)", default = "0 kg/(m3 s)" }
states.content = { unit = "kg/m3", start = "first", derivative = "feed - rate * (1 - slowed) * content" }
outputs.concentration = { unit = "kg/m3", value = "content" }
outputs.low = { switch = true, value = "content < 0.5 * first" }
faults.slowed = { unit = "percent", high = 100 }
)toml";

TEST(OwnType, WhenAStateDecays_ThenItDoesSoExponentially) {
  ModelRig rig(kReactor +
               "[components.r]\ntype = \"reactor\"\nfirst = \"2 g/l\"\n[terminals]\nLOW = { address = "
               "\"%IX0.0\", from = \"r.low\" }\n");
  ASSERT_TRUE(rig.run(5.0));
  EXPECT_EQ(rig.sensor("LOW"), 0);
  ASSERT_TRUE(rig.run(5.0));
  EXPECT_NEAR(rig.truth("r.concentration"), 2.0 * std::exp(-1.0), 1e-5);
  EXPECT_EQ(rig.sensor("LOW"), 1);
  ASSERT_TRUE(rig.plant().inject_fault("r.slowed", 100.0));
  ASSERT_TRUE(rig.run(10.0));
  EXPECT_NEAR(rig.truth("r.concentration"), 2.0 * std::exp(-1.0), 1e-5);
}

TEST(OwnType, WhenAnEventHappensWithoutEnd_ThenThePlantFailsAndNamesTheComponent) {
  ModelRig rig(R"toml([types.saw]
states.x = { unit = "1", start = "0", derivative = "1 / tick" }
parameters.tick = { unit = "s", default = "1 s" }
outputs.up = { switch = true, value = "x > 0" }
events.tooth = { when = "x - 1e-9", set = { x = "0 * x" } }
[components.calm]
type = "tank"
volume = "1 m3"
[components.gauge]
type = "level_sensor"
of = "calm"
[components.s]
type = "saw"
[components.l]
type = "lamp"
command = "s.up"
)toml");
  EXPECT_FALSE(rig.run(1.0));
  EXPECT_NE(rig.plant().trouble().find("an event of 's' happens again and again"), std::string::npos)
      << rig.plant().trouble();
}

// Bounces become infinitely quick within 2.6 s: a ball that nothing brings to rest would fall through the
// floor.
TEST(OwnType, WhenAnEventFollowsItselfEverMoreQuickly_ThenItIsNamed) {
  ModelRig rig(R"toml([types.ball]
parameters.g = { unit = "m/s2", default = "9.81 m/s2" }
parameters.middle = { unit = "m", default = "0.5 m" }
states.h = { unit = "m", start = "middle + middle", derivative = "v" }
states.v = { unit = "m/s", start = "0 * g * sqrt(middle / g)", derivative = "-g" }
outputs.height = { unit = "m", value = "h" }
outputs.low = { switch = true, value = "h < middle" }
events.bounce = { when = "h", falling = true, set = { v = "-0.7 * v" } }
[components.b]
type = "ball"
[components.l]
type = "lamp"
command = "b.low"
)toml");
  EXPECT_TRUE(rig.run(2.0));
  EXPECT_FALSE(rig.run(10.0));
  EXPECT_NE(rig.plant().trouble().find("event 'bounce' of 'b' follows itself"), std::string::npos)
      << rig.plant().trouble();
  EXPECT_LT(rig.plant().now(), std::chrono::milliseconds(2'700));
  EXPECT_GT(rig.truth("b.height"), -1e-4);
}

// Nothing is left of what decays for long, and no number takes longer than another one.
TEST(OwnType, WhenAStateHasDecayedForLong_ThenItIsZero) {
  ModelRig rig(kReactor +
               "[components.r]\ntype = \"reactor\"\nfirst = \"2 g/l\"\nrate = \"20 1/s\"\n[terminals]\nLOW = "
               "{ address = \"%IX0.0\", from = \"r.low\" }\n");
  ASSERT_TRUE(rig.run(60.0));
  const double left = rig.truth("r.concentration");
  EXPECT_TRUE(left == 0.0 || std::isnormal(left)) << left;
}

TEST(OwnType, WhenAnEventHappens_ThenItSetsItsStates) {
  // A ball that bounces: after each impact it has 0.8 of its speed.
  ModelRig rig(R"toml([types.ball]
parameters.g = { unit = "m/s2", default = "9.80665 m/s2" }
states.height = { unit = "m", start = "1 m", derivative = "speed" }
states.speed = { unit = "m/s", start = "0 m/s", derivative = "-g" }
outputs.height_out = { unit = "m", value = "height" }
outputs.speed_out = { unit = "m/s", value = "speed" }
events.impact = { when = "height", falling = true, set = { speed = "-0.8 * speed", height = "0 * height" } }
outputs.up = { switch = true, value = "speed > 0" }
[components.b]
type = "ball"
[components.l]
type = "lamp"
command = "b.up"
)toml");
  const double fall_s = std::sqrt(2.0 / 9.80665);
  ASSERT_TRUE(rig.run(0.6));
  const double up_s = 0.6 - fall_s;
  const double speed = 0.8 * 9.80665 * fall_s;
  EXPECT_NEAR(rig.truth("b.height_out"), speed * up_s - 0.5 * 9.80665 * up_s * up_s, 1e-5);
  EXPECT_NEAR(rig.truth("b.speed_out"), speed - 9.80665 * up_s, 1e-5);
}

TEST(OwnType, WhenALiquidPortHasAFlow_ThenItIsJoinedLikeTheOthers) {
  ModelRig rig(R"toml([types.drip]
parameters.k = { unit = "(m3/s)/Pa" }
ports.inlet = { role = "branch", flow = "k * inlet_pressure" }
[components.d]
type = "drip"
k = "1e-7 (m3/s)/Pa"
inlet = "t"
[components.t]
type = "tank"
volume = "1 m3"
height = "1 m"
start = "50 percent"
)toml");
  ASSERT_TRUE(rig.run(100.0));
  EXPECT_NEAR(rig.truth("t.level"), 50.0 * std::exp(-1e-7 * 9806.65 * 100.0), 1e-3);
}

void expect_wrong(const std::string& text, const std::string& code, std::size_t line,
                  const std::string& says) {
  const auto plant = ModelRig::load(text);
  ASSERT_FALSE(plant) << says;
  const bool found =
      std::any_of(plant.error().begin(), plant.error().end(), [&](const result::Diagnostic& one) {
        return one.code == code && one.where.line == line &&
               (one.message + " / " + one.hint).find(says) != std::string::npos;
      });
  EXPECT_TRUE(found) << says << " is not in\n" << result::to_string(plant.error());
}

TEST(OwnType, WhenAnEquationIsWrong_ThenItsPlaceIsSaid) {
  const auto with = [](const std::string& line) {
    return "[types.x]\nparameters.a = { unit = \"m\" }\n" + line +
           "\n[components.c]\ntype = \"x\"\na = \"1 m\"\n";
  };
  expect_wrong(with("states.s = { unit = \"m\", derivative = \"a\" }"), "C0341", 3,
               "m where m s-1 is wanted");
  expect_wrong(with("states.s = { unit = \"m\", derivative = \"a + a * a\" }"), "C0341", 3,
               "different units");
  expect_wrong(with("states.s = { unit = \"m\", derivative = \"b\" }"), "C0349", 3,
               "'b' in \"b\" is nothing that is known here");
  expect_wrong(with("states.s = { unit = \"m\", derivative = \"a * (\" }"), "C0349", 3, "cannot be read");
  expect_wrong(with("outputs.o = { unit = \"m2\", value = \"a\" }"), "C0341", 3, "m where m2 is wanted");
  expect_wrong(with("states.s = { unit = \"meter per fortnite\", derivative = \"a\" }"), "C0341", 3,
               "is no unit");
}

TEST(Assembly, WhenAPumpStationIsUsedTwice_ThenEachHasItsOwnPumps) {
  ModelRig rig(R"toml([assemblies.station]
[assemblies.station.parameters]
head = "10 m"
[assemblies.station.components.p1]
type = "pump"
head = "$head"
resistance = "5000 m/(m3/s)"
in = "main"
out = "main2"
command = "run"
[assemblies.station.components.main]
type = "tank"
volume = "1 m3"
start = "50 percent"
[assemblies.station.components.main2]
type = "tank"
volume = "1 m3"
[assemblies.station.components.run]
type = "photo_eye"
of = "true"
[assemblies.station.ports]
level = "main2.level"
[components.a]
type = "station"
[components.b]
type = "station"
head = "20 m"
[components.la]
type = "level_sensor"
of = "a.level"
)toml");
  ASSERT_TRUE(rig.run(20.0));
  EXPECT_GT(rig.truth("a.main2.level"), 1.0);
  EXPECT_GT(rig.truth("b.main2.level"), rig.truth("a.main2.level"));
  EXPECT_EQ(rig.truth("la.value"), rig.truth("a.main2.level"));
  ASSERT_TRUE(rig.plant().inject_fault("a.p1.weak", 0.0));
}

// `ports` of the outer assembly.
std::string nested(const std::string& ports) {
  return R"toml([assemblies.inner.components.v]
type = "on_off_valve"
kv = "1 m3/h"
[assemblies.inner.ports]
in = "v.in"
out = "v.out"
open = "v.command"
[assemblies.outer.components.a]
type = "inner"
[assemblies.outer.components.b]
type = "inner"
in = "a.out"
open = "true"
[assemblies.outer.ports]
)toml" + ports +
         R"toml([components.m]
type = "source"
pressure = "1 bar"
[components.d]
type = "sink"
[components.o]
type = "outer"
in = "m"
out = "d"
open = "true"
)toml";
}

TEST(Assembly, WhenAPartIsAnAssemblyItself_ThenItsPortsAreThoseOfItsParts) {
  ModelRig rig(nested("in = \"a.in\"\nout = \"b.out\"\nopen = \"a.open\"\n"));
  ASSERT_TRUE(rig.run(20.0));
  EXPECT_GT(rig.truth("d.received"), 0.0);
}

TEST(Assembly, WhenAPortIsNoneOfAPart_ThenItsOwnLineIsTold) {
  expect_wrong(nested("in = \"a.inn\"\nout = \"b.out\"\nopen = \"a.open\"\n"), "C0343", 15,
               "'a.inn' is no port of a part");
}

TEST(OwnType, WhenATypeIsWrong_ThenOnlyThatIsTold) {
  const auto plant = ModelRig::load(R"toml([types.x]
inputs.a = { unit = "m" }
states.s = { unit = "m", derivative = "a" }
[components.one]
type = "x"
a = "1 m"
)toml");
  ASSERT_FALSE(plant);
  EXPECT_EQ(plant.error().size(), 1u) << result::to_string(plant.error());
}

TEST(OwnType, WhenAnEventSetsNothing_ThenItsLineIsTold) {
  expect_wrong(R"toml([types.x]
states.s = { start = "1", derivative = "0" }
outputs.o = { value = "s" }
events.never = { when = "s - 2" }
)toml",
               "C0349", 4, "event 'never' sets nothing");
}

// Once, and nothing of those further in.
TEST(Assembly, WhenTheyAreTooDeep_ThenThatIsTheOnlyWord) {
  std::string text;
  for (int i = 0; i < 11; ++i) {
    const std::string n = std::to_string(i);
    text += "[assemblies.a" + n + ".components.x]\ntype = \"" +
            (i == 10 ? "tank\"\nvolume = \"1 l" : "a" + std::to_string(i + 1)) + "\"\n";
  }
  const auto plant = ModelRig::load(text + "[components.top]\ntype = \"a0\"\n");
  ASSERT_FALSE(plant);
  ASSERT_EQ(plant.error().size(), 1u) << result::to_string(plant.error());
  EXPECT_NE(plant.error()[0].message.find("too deep"), std::string::npos);
}

const std::string kLamp = "[components.l]\ntype = \"lamp\"\ncommand = \"true\"\n";

// Each depends on the next one, further than they may stand in each other.
TEST(Assembly, WhenNoComponentIsMadeOfIt_ThenItMayStandThere) {
  std::string text = R"toml([assemblies.st.parameters]
head = "as high as it takes"
file = ""
[assemblies.st.components.p1]
type = "pump"
head = "$head"
resistance = "5000 m/(m3/s)"
[assemblies.st.components.f]
type = "fmu"
file = "$file"
[assemblies.st.ports]
in = "p1.in"
out = "p1.out"
)toml";
  for (int i = 0; i < 11; ++i) {
    const std::string n = "[assemblies.a" + std::to_string(i);
    text += n + ".components.x]\ntype = \"" +
            (i == 10 ? "tank\"\nvolume = \"1 l\"" : "a" + std::to_string(i + 1) + "\"") + "\n" + n +
            ".ports]\nl = \"x." + (i == 10 ? "level" : "l") + "\"\n";
  }
  const auto plant = ModelRig::load(text + kLamp);
  ASSERT_TRUE(plant) << result::to_string(plant.error());
  EXPECT_EQ((*plant)->model().components.size(), 1u);
}

TEST(Assembly, WhenOneThatIsNotUsedIsWrong_ThenItsLineIsTold) {
  const auto with = [](const std::string& line, const std::string& ports) {
    return "[assemblies.st.components.x]\n" + line + "\n[assemblies.st.ports]\n" + ports + "\n" + kLamp;
  };
  expect_wrong(with("type = \"tnak\"", ""), "C0342", 2, "did you mean 'tank'?");
  expect_wrong(with("type = \"tank\"\nvolum = \"1 l\"", ""), "C0002", 3, "did you mean 'volume'?");
  expect_wrong(with("type = \"tank\"\nvolume = \"1 m\"", ""), "C0341", 3, "m where m3 is wanted");
  expect_wrong(with("type = \"tank\"\nvolume = \"$v\"", ""), "C0006", 3, "'$v' is no parameter");
  expect_wrong(with("type = \"tank\"\nvolume = \"1 l\"", "l = \"x.levl\""), "C0343", 5,
               "is no port of a part");
  expect_wrong(with("type = \"lamp\"", "") + "[assemblies.st2]\nport.l = \"x.l\"\n", "C0002", 9,
               "did you mean 'ports'?");
  expect_wrong("[assemblies.tank.ports]\n" + kLamp, "C0006", 1, "there is a type 'tank' already");
}

TEST(Assembly, WhenATruthNamesAPortOfAnAssembly_ThenItIsThatOfItsPart) {
  ModelRig rig(R"toml([assemblies.station.components.main]
type = "tank"
volume = "1 m3"
start = "50 percent"
[assemblies.station.ports]
content = "main.level"
[components.a]
type = "station"
[components.l]
type = "level_sensor"
of = "a.content"
[truths]
shown = "a.content"
)toml");
  EXPECT_EQ(rig.truth("shown"), 50.0);
}

TEST(OwnType, WhenTheDefaultOfASwitchStandsInQuotes_ThenItIsTaken) {
  ModelRig rig(R"toml([types.x]
inputs.on = { switch = true, default = "true" }
outputs.o = { switch = true, value = "on" }
[components.one]
type = "x"
[components.eye]
type = "photo_eye"
of = "one.o"
)toml");
  ASSERT_TRUE(rig.run(1.0));
  EXPECT_EQ(rig.truth("one.o"), 1.0);
}

}  // namespace
}  // namespace stepwright::components
