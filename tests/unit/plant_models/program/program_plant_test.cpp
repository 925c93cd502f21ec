#include "plant_models/program/program_plant.h"

#include <gtest/gtest.h>

#include "ladder/driver/compile.h"

namespace stepwright::program_plant {
namespace {

const char* const kTank = R"(PROGRAM Tank
VAR
    inflow : REAL; leak : LREAL; gain : LREAL := 1.0; level : LREAL := 2.0; high : BOOL; scans : UDINT; n : INT := 1;
    name : STRING := 'tank';
END_VAR
    level := level + inflow * gain - leak;
    high := level > 5.0;
    scans := scans + 1;
    n := 100 / n;
    n := 1;
END_PROGRAM
CONFIGURATION C
    RESOURCE R ON PLC
        TASK T(INTERVAL := T#10ms, PRIORITY := 1);
        PROGRAM Tank WITH T : Tank;
    END_RESOURCE
END_CONFIGURATION
)";

std::vector<std::byte> compiled(const std::string& text) {
  auto output = driver::compile({.texts = {{"tank.st", text}}});
  EXPECT_TRUE(output) << result::to_string(output.error());
  return std::move(output->container);
}

const stepped::StepNames kNames = {
    {"Tank.inflow", "Tank.n"}, {"Tank.level", "TANK.HIGH"}, {"Tank.scans"}, {"Tank.leak"}};

TEST(ProgramPlant, WhenItIsStepped_ThenWhatIsDueBeforeTheEndOfTheStepHasRun) {
  const auto area = stepped::StepArea::make(kNames, 1).value();
  const auto plant = ProgramPlant::create(compiled(kTank), kNames, {{"Tank.gain", 2.0}}).value();
  plant->sample(area);
  EXPECT_EQ(area.sensor(0), 2.0);
  area.set_actuator(0, 0.5);
  area.set_actuator(1, 1.0);
  EXPECT_EQ(plant->step(10'000'000, area), "");
  EXPECT_EQ(area.sensor(0), 3.0);
  EXPECT_EQ(area.value(0), 1.0);
  EXPECT_EQ(plant->step(15'000'000, area), "");  // the scan of 10 ms
  EXPECT_EQ(area.value(0), 2.0);
  EXPECT_EQ(plant->step(20'000'000, area), "");  // none is due
  EXPECT_EQ(area.value(0), 2.0);
  EXPECT_EQ(plant->step(100'000'000, area), "");
  EXPECT_EQ(area.value(0), 10.0);
  EXPECT_EQ(area.sensor(1), 1.0);
}

TEST(ProgramPlant, WhenAFaultComesAndGoes_ThenItsVariableHasTheValueOfTheStartAgain) {
  const auto area = stepped::StepArea::make(kNames, 1).value();
  const auto plant = ProgramPlant::create(compiled(kTank), kNames, {{"Tank.leak", 0.25}}).value();
  area.set_actuator(1, 1.0);
  area.set_fault(0, 1.0);
  EXPECT_EQ(plant->step(10'000'000, area), "");
  EXPECT_EQ(area.sensor(0), 1.0);
  area.set_fault(0, 0.0);
  EXPECT_EQ(plant->step(20'000'000, area), "");
  EXPECT_EQ(area.sensor(0), 0.75);
}

TEST(ProgramPlant, WhenItTraps_ThenThePlaceIsSaid) {
  const auto area = stepped::StepArea::make(kNames, 1).value();
  const auto plant = ProgramPlant::create(compiled(kTank), kNames, {}).value();
  const std::string said = plant->step(10'000'000, area);  // n is 0
  EXPECT_NE(said.find("tank.st:9"), std::string::npos) << said;
}

TEST(ProgramPlant, WhenNamesAreWrong_ThenEachHasItsPlaceAndAHint) {
  const auto container = compiled(kTank);
  const auto info = reader::ProgramInfo::read(container).value();
  const auto found = find_variables(info, {{"Tank.levle", {"cell.toml", 3, 1}},
                                           {"level", {"cell.toml", 4, 1}},
                                           {"Tank.name", {"cell.toml", 5, 1}}});
  ASSERT_FALSE(found);
  ASSERT_EQ(found.error().size(), 3u);
  EXPECT_EQ(found.error()[0].code, "C0336");
  EXPECT_EQ(found.error()[0].where.line, 3u);
  EXPECT_NE(found.error()[0].hint.find("evel"), std::string::npos) << found.error()[0].hint;
  EXPECT_NE(found.error()[2].message.find("string"), std::string::npos);
}

TEST(ProgramPlant, WhenATaskHasNoInterval_ThenTheFileIsNamed) {
  std::string text = kTank;
  text.replace(text.find("INTERVAL := T#10ms, "), 20, "");
  const auto plant = ProgramPlant::create(compiled(text), kNames, {}, {"tank.st", 0, 0});
  ASSERT_FALSE(plant);
  ASSERT_EQ(plant.error().size(), 1u) << result::to_string(plant.error());
  EXPECT_EQ(plant.error()[0].code, "C0336");
  EXPECT_EQ(plant.error()[0].where.file, "tank.st");
}

}  // namespace
}  // namespace stepwright::program_plant
