// What is wrong with a described plant is said with its place and a hint.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/plant_models/components/model_rig.h"

namespace stepwright::components {
namespace {

constexpr const char* kTanks = R"(
[components.t1]
type = "tank"
volume = "1 m3"
[components.t2]
type = "tank"
volume = "1 m3"
)";

const char* const kPipe = R"(
[components.p]
type = "pipe"
flow = "1 l/s"
pressure_drop = "1 bar"
)";

struct Wrong {
  std::string text;
  std::string code;
  std::size_t line;
  std::string says;
};

void expect(const Wrong& wrong) {
  const auto plant = ModelRig::load(wrong.text);
  ASSERT_FALSE(plant) << wrong.says;
  const auto found =
      std::find_if(plant.error().begin(), plant.error().end(), [&](const result::Diagnostic& one) {
        return one.code == wrong.code && one.where.line == wrong.line &&
               (one.message + " / " + one.hint).find(wrong.says) != std::string::npos;
      });
  EXPECT_NE(found, plant.error().end()) << wrong.says << " is not in\n" << result::to_string(plant.error());
}

TEST(WrongModel, WhenAFileHasSlips_ThenEachHasItsPlaceAndAHint) {
  const std::string tanks = kTanks;
  expect({"[components.t]\ntype = \"tnak\"\n", "C0342", 2, "did you mean 'tank'?"});
  expect({"[components.t]\ntype = \"tank\"\nvolume = \"3 s\"\n", "C0341", 3, "s where m3 is wanted"});
  expect({"[components.t]\ntype = \"tank\"\nvolume = \"3 litters\"\n", "C0341", 3, "no figure with a unit"});
  expect({"[components.t]\ntype = \"tank\"\nvolume = \"264 gal\"\n", "C0341", 3, "meant is \"gallon\""});
  expect({"[components.t]\ntype = \"tank\"\nvolume = \"-3 l\"\n", "C0004", 3, "between 1e-06 and 1e+09 l"});
  expect({"[components.h]\ntype = \"heater\"\npower = \"0 W\"\n", "C0004", 3, "out of range"});
  expect({"[components.t]\ntype = \"tank\"\nvolumn = \"3 l\"\n", "C0002", 3, "did you mean 'volume'?"});
  expect({"[components.t]\ntype = \"tank\"\n", "C0005", 1, "'components.t.volume' is missing"});
  expect({tanks + "[components.p]\ntype = \"pipe\"\nflow = \"1 l/s\"\npressure_drop = \"1 bar\"\nin = "
                  "\"t1\"\nout = \"t3\"\n",
          "C0343", 13, "did you mean 't1'?"});
  expect({tanks + "[components.p]\ntype = \"pipe\"\nflow = \"1 l/s\"\npressure_drop = \"1 bar\"\nin = "
                  "\"t1\"\nout = \"t2.top\"\n",
          "C0343", 13, "no port 'top'"});
  expect(
      {tanks + "[components.p]\ntype = \"pipe\"\nflow = \"1 l/s\"\npressure_drop = \"1 bar\"\nin = \"t1\"\n",
       "C0344", 8, "port 'p.out' is open"});
  expect({tanks, "C0345", 2, "'t1' is connected to nothing"});
  expect(
      {"[components.t1]\ntype = \"tank\"\nvolume = \"1 l\"\nliquid = \"t2\"\n[components.t2]\ntype = "
       "\"tank\"\nvolume = \"1 l\"\n",
       "C0343", 4, "several ports for a liquid"});
  expect({tanks + "[components.s]\ntype = \"temperature_sensor\"\nof = \"t1.level\"\n", "C0341", 10,
          "do not fit: a pure number and K"});
  expect(
      {tanks + "[components.c]\ntype = \"analog_input\"\nof = \"t1.level\"\nlow = \"0 m\"\nhigh = \"1 m\"\n",
       "C0341", 11, "'c.of' is a pure number"});
  expect({tanks + "[terminals]\nL = { address = \"%IW0\", from = \"t1.liquid_height\" }\n", "C0341", 9,
          "an analog_input between them"});
  expect({tanks + "[terminals]\nB = \"%IX0.0\"\n", "C0348", 9, "is no address for 'B'"});
  expect({tanks + "[terminals]\nB = \"%QX0.0\"\n", "C0344", 9, "drives nothing"});
  expect({tanks + "[components.c]\ntype = \"analog_input\"\nof = \"t1.level\"\nlow = \"0 percent\"\nhigh = "
                  "\"100 percent\"\n[terminals]\nA = { address = \"%IW1\", from = \"c\" }\n"
                  "B = { address = \"%IX3.7\", from = \"c\" }\n",
          "C0304", 15, "%IX3.7 overlaps %IW1, to which 'A' is wired"});
}

TEST(WrongModel, WhenAChoiceOfTheComponentIsNeeded_ThenItIsNamed) {
  const std::string pump =
      std::string(kTanks) +
      "[components.p]\ntype = \"pump\"\nhead = \"10 m\"\nresistance = \"5000 m/(m3/s)\"\n"
      "in = \"t1\"\nout = \"t2\"\ncommand = \"true\"\n";
  const std::string card =
      "[components.c]\ntype = \"analog_input\"\nof = \"p.delivered\"\nlow = \"0 l\"\n"
      "high = \"100 l\"\n[terminals]\nD = { address = \"%IW0\", from = \"c\" }\n";
  expect({pump + card, "C0343", 17, "totaliser = \"yes\" in [components.p]"});
  expect({pump + "[faults]\nmore = \"p.extra\"\n", "C0343", 16, "totaliser = \"yes\" in [components.p]"});
  const auto plain = ModelRig::load(pump);
  ASSERT_TRUE(plain) << result::to_string(plain.error());
  const auto refused = (*plain)->inject_fault("p.extra", 1.0);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().hint, "totaliser = \"yes\" in [components.p] gives it");
  EXPECT_FALSE(core::find_truth(**plain, "p.delivered"));
  EXPECT_TRUE(ModelRig::load(pump + "totaliser = \"yes\"\n" + card));
}

TEST(WrongModel, WhenAFaultHasTwoOtherNames_ThenTheSecondIsAnError) {
  const std::string text =
      std::string(kTanks) + kPipe + "in = \"t1\"\nout = \"t2\"\n[faults]\ncrack = \"t1.leak\"\n";
  expect({text + "hole = \"t1.leak\"\n", "C0343", 17, "has another name already: 'crack'"});
  expect({text + "hole = \"crack\"\n", "C0343", 17, "is another name of 't1.leak'"});
  EXPECT_TRUE(ModelRig::load(text));
}

TEST(WrongModel, WhenThingsGoRoundWithoutAState_ThenTheCircleIsNamed) {
  expect(
      {"[components.a]\ntype = \"analog_output\"\nlow = \"0\"\nhigh = \"1\"\ncounts = \"b.counts\"\n"
       "[components.b]\ntype = \"analog_input\"\nlow = \"0\"\nhigh = \"1\"\nof = \"a.value\"\n",
       "C0346", 1, "a circle without a state: a, b"});
}

TEST(WrongModel, WhenAThousandComponentsAreUnconnected_ThenTheFirstAreNamedAndTheOthersCounted) {
  std::string text;
  for (int i = 0; i < 1000; ++i)
    text += "[components.t" + std::to_string(i) + "]\ntype = \"tank\"\nvolume = \"1 l\"\n";
  const auto plant = ModelRig::load(text);
  ASSERT_FALSE(plant);
  EXPECT_LT(plant.error().size(), 30u);
  EXPECT_EQ(plant.error().front().code, std::string("C0345"));
  EXPECT_NE(plant.error().back().message.find("more ports are open"), std::string::npos);
}

TEST(WrongModel, WhenAssembliesHoldMoreComponentsThanAPlantMayHave_ThenItIsSaidOnceAndSoon) {
  std::string text = "[components.all]\ntype = \"a4\"\n";
  for (int level = 0; level < 5; ++level)
    for (int part = 0; part < 10; ++part)
      text += "[assemblies.a" + std::to_string(level) + ".components.p" + std::to_string(part) +
              "]\ntype = \"" + (level == 0 ? "lamp" : "a" + std::to_string(level - 1)) + "\"\n";
  const auto plant = ModelRig::load(text);
  ASSERT_FALSE(plant);
  ASSERT_EQ(plant.error().size(), 1u) << result::to_string(plant.error());
  EXPECT_NE(plant.error().front().message.find("more than 20000 components"), std::string::npos);
}

TEST(WrongModel, WhenNoStepIsSmallEnough_ThenTheComponentIsNamed) {
  const std::string text = R"toml([types.runaway]
inputs.feed = { unit = "1/s", default = "1 1/s" }
states.x = { unit = "", start = "1", derivative = "feed * x * x" }
outputs.high = { switch = true, value = "x > 3" }
[components.calm]
type = "tank"
volume = "1 m3"
[components.p]
type = "pipe"
flow = "1 l/s"
pressure_drop = "1 bar"
in = "calm"
out = "other"
[components.other]
type = "tank"
volume = "1 m3"
[components.wild]
type = "runaway"
[terminals]
HIGH = { address = "%IX0.0", from = "wild.high" }
)toml";
  ModelRig rig(text);
  EXPECT_TRUE(rig.run(0.5));
  EXPECT_EQ(rig.plant().trouble(), "");
  EXPECT_FALSE(rig.run(1.0));  // x = 1 / (1 - t) has no value at 1 s
  EXPECT_NE(rig.plant().trouble().find("'wild' changes fastest"), std::string::npos) << rig.plant().trouble();
  EXPECT_FALSE(rig.run(1.0));
}

// What is too quick for any step stands still, and something slow moves.
TEST(WrongModel, WhenASensorIsTooQuickForTheSolver_ThenItIsNamedAndNotWhatMoves) {
  ModelRig rig(R"toml(
[components.from]
type = "source"
pressure = "1 bar"
[components.valve]
type = "control_valve"
kv = "1 m3/h"
travel = "5 s"
in = "from"
out = "tank"
command = "50 percent"
[components.tank]
type = "tank"
volume = "100 l"
[components.quick]
type = "level_sensor"
of = "tank"
filter = "1e-12 s"
[components.card]
type = "analog_input"
of = "quick"
low = "0 percent"
high = "100 percent"
[terminals]
LEVEL = { address = "%IW0", from = "card" }
)toml");
  EXPECT_FALSE(rig.run(1.0));
  EXPECT_NE(rig.plant().trouble().find("'quick' changes fastest"), std::string::npos)
      << rig.plant().trouble();
}

}  // namespace
}  // namespace stepwright::components
