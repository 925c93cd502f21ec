// FMUs as components: exchanged with what is around them at each communication step, in processes that may be
// lost, and with what is wrong said at its place.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "plant_models/components/library/catalogue.h"
#include "plant_models/components/model_plant.h"
#include "tests/unit/plant_models/fmu/made_archive.h"

namespace stepwright::components {
namespace {

using namespace std::chrono_literals;
using core::PlantStatus;

const std::string kFmus = std::string(STEPWRIGHT_SOURCE_DIR) + "/tests/cells/shared_plant/fmu/";
#if defined(__x86_64__)
const std::string kPlatform2 = "linux64", kPlatform3 = "x86_64-linux";
#else
const std::string kPlatform2 = "aarch64-linux", kPlatform3 = "aarch64-linux";
#endif

std::string description(const std::string& name) {
  return fmu::bytes_of(kFmus + name + ".xml");
}

// A folder with the tanks of the cell tests as FMUs, and plants of them.
class FmuRig {
 public:
  FmuRig() {
    pack("tank2", kPlatform2, description("tank2"));
    pack("tank3", kPlatform3, description("tank3"));
  }
  void pack(const std::string& name, const std::string& platform, const std::string& xml) {
    const std::string library = fmu::bytes_of(std::string(STEPWRIGHT_TESTS_DIR) + "/" + name + ".so");
    fmu::make_archive(folder_ / (name + ".fmu"), {{"modelDescription.xml", xml},
                                                  {"binaries/" + platform + "/" + name + ".so", library}});
  }
  result::Result<std::unique_ptr<ModelPlant>> load(const std::string& text) {
    std::ofstream(folder_ / "plant.toml") << text;
    return ModelPlant::load(folder_ / "plant.toml", library::catalogue(),
                            {.processes = folder_ / "fmu", .programs = STEPWRIGHT_PROGRAMS_DIR});
  }
  std::unique_ptr<ModelPlant> started(const std::string& text) {
    auto plant = load(text);
    EXPECT_TRUE(plant) << result::to_string(plant.error());
    const auto done = (*plant)->start();
    EXPECT_TRUE(done) << result::to_string(done.error());
    return std::move(*plant);
  }

 private:
  fmu::TemporaryFolder folder_;
};

const std::string kUpper = R"toml(
[components.upper]
type = "fmu"
file = "tank2.fmu"
timeout = "60 s"
start_timeout = "120 s"
faults = { trap = [0, 3] }
valve = "VALVE"
leak = "p.flow"
)toml";
const std::string kLower = R"toml(
[components.lower]
type = "fmu"
file = "tank3.fmu"
timeout = "60 s"
start_timeout = "120 s"
valve = "upper.full"
)toml";
const std::string kAround = R"toml(
[components.well]
type = "source"
[components.p]
type = "pump"
head = "10 m"
resistance = "5000 m/(m3/s)"
outlet = "free"
in = "well"
out = "t1"
command = "PUMP"
[components.t1]
type = "tank"
volume = "300 l"
[components.card]
type = "analog_input"
of = "upper.level"
low = "0 m"
high = "2 m"
[terminals]
VALVE = "%QX0.0"
PUMP = "%QX0.1"
LEVEL = { address = "%IW0", from = "card" }
FULL = { address = "%IX4.0", from = "upper.full" }
)toml";

double truth(const ModelPlant& plant, std::string_view name) {
  return plant.truth(core::find_truth(plant, name).value());
}
void set(ModelPlant& plant, std::string_view name, bool on) {
  plant.set_actuator(core::find_actuator(plant, name).value(), on ? 1 : 0);
}
std::vector<double> truths(const ModelPlant& plant) {
  std::vector<double> all;
  for (const core::Quantity& each : plant.truths()) all.push_back(truth(plant, each.name));
  std::sort(all.begin(), all.end());  // whatever the order of the file
  return all;
}

TEST(FmuComponent, WhenItHasNoProcess_ThenItStandsAtItsStart) {
  FmuRig rig;
  const auto plant = rig.load(kUpper + kLower + kAround).value();
  set(*plant, "VALVE", true);
  EXPECT_EQ(plant->advance(1s), PlantStatus::Good);
  EXPECT_EQ(truth(*plant, "upper.level"), 0.0);
}

TEST(FmuComponent, WhenItIsJoined_ThenInputsAndOutputsGoThroughPorts) {
  FmuRig rig;
  const auto plant = rig.started(kUpper + kLower + kAround);
  EXPECT_DOUBLE_EQ(truth(*plant, "upper.level"), 0.2) << "its own start, before the first step";
  set(*plant, "VALVE", true);
  ASSERT_EQ(plant->advance(10s), PlantStatus::Good);
  EXPECT_NEAR(truth(*plant, "upper.level"), 0.4, 1e-9);  // 0.01 m3/s into 0.5 m2
  EXPECT_NEAR(plant->sensor(core::find_sensor(*plant, "LEVEL").value()), 0.4 / 2.0 * 27'648, 1.0);
  set(*plant, "PUMP", true);
  ASSERT_EQ(plant->advance(10s), PlantStatus::Good);
  const double pumped_m3 = truth(*plant, "t1.volume_out") * 1e-3;
  EXPECT_GT(pumped_m3, 0.01);
  // What the pump takes leaves the FMU's tank, held over each step.
  EXPECT_NEAR(truth(*plant, "upper.level"), 0.6 - pumped_m3 / 0.5, 1e-4);
}

TEST(FmuComponent, WhenAnOutputChanges_ThenTheNextFmuHasItOneStepLater) {
  FmuRig rig;
  const auto plant = rig.started(kUpper + kLower + kAround);
  set(*plant, "VALVE", true);
  while (truth(*plant, "upper.full") == 0.0) ASSERT_EQ(plant->advance(10ms), PlantStatus::Good);
  const double before = truth(*plant, "lower.level");
  EXPECT_DOUBLE_EQ(before, 0.2);
  ASSERT_EQ(plant->advance(10ms), PlantStatus::Good);
  EXPECT_NEAR(truth(*plant, "lower.level"), before + 0.0002, 1e-12);
}

TEST(FmuComponent, WhenAnAnswerJumpsThroughZero_ThenTheEventOfAnOwnTypeHappens) {
  FmuRig rig;
  const auto plant = rig.started(kUpper + R"toml([types.counter]
inputs.sw = { switch = true }
states.n = { derivative = "0" }
events.count = { when = "(sw ? 1 : 0) - 0.5", set = { n = "n + 1" } }
outputs.count = { value = "n" }
[components.c]
type = "counter"
sw = "upper.full"
)toml" + kAround);
  set(*plant, "VALVE", true);
  while (truth(*plant, "upper.full") == 0.0) ASSERT_EQ(plant->advance(10ms), PlantStatus::Good);
  EXPECT_EQ(truth(*plant, "c.count"), 0.0);
  ASSERT_EQ(plant->advance(10ms), PlantStatus::Good);
  EXPECT_EQ(truth(*plant, "c.count"), 1.0);
}

TEST(FmuComponent, WhenTimeIsCutOrTheFileTurnedRound_ThenNoBitChanges) {
  FmuRig rig;
  const auto run = [](ModelPlant& plant, std::chrono::nanoseconds slice) {
    set(plant, "VALVE", true);
    EXPECT_EQ(plant.advance_to(2s), PlantStatus::Good);
    set(plant, "PUMP", true);
    while (plant.now() < 4s && plant.advance(slice) == PlantStatus::Good) {
    }
    EXPECT_TRUE(plant.inject_fault("t1.leak", 0.5));
    EXPECT_EQ(plant.advance_to(5s), PlantStatus::Good);
    return truths(plant);
  };
  const auto coarse = run(*rig.started(kUpper + kLower + kAround), 500ms);
  EXPECT_EQ(run(*rig.started(kUpper + kLower + kAround), 4ms), coarse);
  EXPECT_EQ(run(*rig.started(kLower + kUpper + kAround), 10ms), coarse);
}

TEST(FmuComponent, WhenFiguresHaveUnits_ThenTheFmuGetsThemInItsOwn) {
  FmuRig rig;
  const auto plant = rig.started(kUpper + "parameters = { area = \"5000 cm2\" }\n" + kLower +
                                 "parameters = { area = \"1 m2\" }\n" + kAround);
  set(*plant, "VALVE", true);
  ASSERT_EQ(plant->advance(10s), PlantStatus::Good);
  EXPECT_NEAR(truth(*plant, "upper.level"), 0.4, 1e-9);
}

TEST(FmuComponent, WhenTheFmuDefinesItsUnits_ThenThoseAreMeant) {
  FmuRig rig;
  std::string xml = description("tank2");
  const auto replace = [&xml](const std::string& from, const std::string& to) {
    xml.replace(xml.find(from), from.size(), to);
  };
  replace("<ModelVariables>",
          "<UnitDefinitions><Unit name=\"half\"><BaseUnit m=\"1\" factor=\"0.5\"/></Unit></UnitDefinitions>"
          "<TypeDefinitions><SimpleType name=\"Height\"><Real unit=\"half\"/></SimpleType></TypeDefinitions>"
          "<ModelVariables>");
  replace("<Real unit=\"m\"/>", "<Real declaredType=\"Height\"/>");
  rig.pack("tank2", kPlatform2, xml);
  const auto plant = rig.started(kUpper + kAround);
  EXPECT_NEAR(truth(*plant, "upper.level"), 0.2, 1e-12);
  EXPECT_NEAR(plant->sensor(core::find_sensor(*plant, "LEVEL").value()), 0.1 / 2.0 * 27'648, 1.0);
}

// What is said of a plant after a fault of its FMU, and how it stands.
std::string loss(double trap, const std::string& timeout = "60 s") {
  FmuRig rig;
  std::string text = kUpper + kLower + kAround;
  text.replace(text.find("60 s"), 4, timeout);
  const auto plant = rig.started(text);
  set(*plant, "VALVE", true);
  EXPECT_EQ(plant->advance(1s), PlantStatus::Good);
  EXPECT_EQ(plant->trouble(), "");
  EXPECT_TRUE(plant->inject_fault("upper.trap", trap));
  EXPECT_EQ(plant->advance(100ms), PlantStatus::Failed);
  EXPECT_TRUE(plant->failed());
  EXPECT_EQ(plant->advance(100ms), PlantStatus::Failed);
  EXPECT_NEAR(truth(*plant, "upper.level"), 0.22, 1e-9) << "it stays where it was";
  return plant->trouble();
}

TEST(FmuComponent, WhenItIsLost_ThenThePlantIsAndNamesIt) {
  EXPECT_NE(loss(1.0).find("'upper': the plant is lost at 1.010 s: its process was killed by signal 6"),
            std::string::npos);
  EXPECT_NE(
      loss(2.0, "0.2 s").find("'upper': the plant is lost at 1.010 s: no answer to a step within 200 ms"),
      std::string::npos);
  EXPECT_NE(
      loss(3.0).find("'upper': the plant is lost at 1.010 s: the FMU makes no step: the solver gave up"),
      std::string::npos);
}

TEST(FmuComponent, WhenAFaultEnds_ThenItsVariableHasItsStart) {
  FmuRig rig;
  const auto plant = rig.started(R"toml(
[components.tank]
type = "fmu"
file = "tank2.fmu"
timeout = "60 s"
faults = { leak = [0.0, 0.005] }
outputs = ["level", "volume"]
[components.card]
type = "analog_input"
of = "tank.level"
low = "0 m"
high = "2 m"
[terminals]
LEVEL = { address = "%IW0", from = "card" }
)toml");
  EXPECT_EQ(plant->faults().front().unit, "m3/s");
  ASSERT_TRUE(plant->inject_fault("tank.leak", 0.005));
  ASSERT_EQ(plant->advance(10s), PlantStatus::Good);
  EXPECT_NEAR(truth(*plant, "tank.level"), 0.1, 1e-9);
  EXPECT_NEAR(truth(*plant, "tank.volume"), 50.0, 1e-9);
  ASSERT_TRUE(plant->clear_fault("tank.leak"));
  ASSERT_EQ(plant->advance(10s), PlantStatus::Good);
  EXPECT_NEAR(truth(*plant, "tank.level"), 0.1, 1e-9);
  EXPECT_FALSE(plant->inject_fault("tank.leak", 1.0)) << "out of its range";
}

struct Wrong {
  std::string more;  // lines of the component, the first of which is line 5
  std::string code;
  std::size_t line;
  std::string says;
};

TEST(FmuComponent, WhenItsLinesAreWrong_ThenEachHasItsPlace) {
  FmuRig rig;
  for (const Wrong& wrong : {
           Wrong{"vavle = \"V\"", "C0335", 5, "did you mean 'valve'?"},
           Wrong{"level = \"card\"", "C0335", 5, "an actuator is an input"},
           Wrong{"maker = \"V\"", "C0335", 5, "it is no number"},
           Wrong{"leak = \"V\"", "C0341", 5, "a number"},
           Wrong{"leak = \"1 bar\"", "C0341", 5, "the unit does not fit"},
           Wrong{"valve = \"other\"", "C0343", 5, "there is no 'other'"},
           Wrong{"parameters = { area = 2.0 }", "C0003", 5, ""},
           Wrong{"parameters = { area = \"2 s\" }", "C0341", 5, "s where m2 is wanted"},
           Wrong{"parameters = { level = \"2 m\" }", "C0335", 5, "it is no parameter"},
           Wrong{"faults = { area = [0, 1] }", "C0335", 5, "a fault is an input or a tunable parameter"},
           Wrong{"faults = { leak = [1, 0] }", "C0006", 5, "its least and its greatest"},
           Wrong{"outputs = [\"lvl\"]", "C0335", 5, "no variable 'lvl'"},
           Wrong{"units = { level = \"cubits\" }", "C0341", 5, "is no unit"},
           Wrong{"units = { level = \"mm\" }", "C0341", 5, "'level' in 'm', not in 'mm' / leave it out"},
           Wrong{"timeout = \"0 s\"", "C0004", 5, "out of range"},
       }) {
    const auto plant =
        rig.load("\n[components.tank]\ntype = \"fmu\"\nfile = \"tank2.fmu\"\n" + wrong.more +
                 "\n[components.card]\ntype = \"analog_input\"\nof = \"tank.level\"\nlow = \"0 "
                 "m\"\nhigh = \"1 m\"\n[terminals]\nV = \"%QW0\"\nL = { address = \"%IW0\", from = "
                 "\"card\" }\n");
    ASSERT_FALSE(plant) << wrong.more;
    const auto found =
        std::find_if(plant.error().begin(), plant.error().end(), [&](const result::Diagnostic& one) {
          return one.code == wrong.code && one.where.line == wrong.line &&
                 (one.message + " / " + one.hint).find(wrong.says) != std::string::npos;
        });
    EXPECT_NE(found, plant.error().end()) << wrong.more << "\n" << result::to_string(plant.error());
    const bool twice = std::any_of(plant.error().begin(), plant.error().end(),
                                   [](const result::Diagnostic& one) { return one.code == "C0002"; });
    EXPECT_FALSE(twice) << wrong.more << "\n" << result::to_string(plant.error());
  }
}

TEST(FmuComponent, WhenItsFileIsWrong_ThenThatIsSaidOnceAtItsLine) {
  FmuRig rig;
  rig.pack("tank3", "win64", description("tank3"));
  for (const auto& [file, code] :
       {std::pair("none.fmu", "C0330"), std::pair("plant.toml", "C0330"), std::pair("tank3.fmu", "C0333")}) {
    const auto plant =
        rig.load("[components.tank]\ntype = \"fmu\"\nfile = \"" + std::string(file) +
                 "\"\nvalve = \"V\"\nparameters = { area = 1 }\n[terminals]\nV = \"%QX0.0\"\n");
    ASSERT_FALSE(plant) << file;
    EXPECT_EQ(plant.error().size(), 1U) << result::to_string(plant.error());
    EXPECT_EQ(plant.error().front().code, code);
    EXPECT_EQ(plant.error().front().where.line, 3U);
  }
}

TEST(FmuComponent, WhenItsOwnStepDoesNotDivideTheExchange_ThenThatIsSaid) {
  FmuRig rig;
  std::string xml = description("tank3");
  xml.insert(xml.find("canHandle"), "fixedInternalStepSize=\"0.004\" ");
  rig.pack("tank3", kPlatform3, xml);
  const auto plant = rig.load(kUpper + kLower + kAround);
  ASSERT_FALSE(plant);
  EXPECT_EQ(plant.error().front().code, "C0335");
  EXPECT_NE(plant.error().front().message.find("no multiple"), std::string::npos);
  EXPECT_TRUE(rig.load("[plant]\ncommunication_step = \"8 ms\"\n" + kUpper + kLower + kAround));
}

}  // namespace
}  // namespace stepwright::components
