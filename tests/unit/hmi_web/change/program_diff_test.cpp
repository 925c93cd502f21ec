#include "hmi_web/change/program_diff.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "ladder/driver/compile.h"
#include "runtime/bytecode/reader/program_info.h"

namespace stepwright::change {
namespace {

using reader::LoadedProgram;
using testing::ElementsAre;
using testing::IsEmpty;

LoadedProgram program(const std::string& declarations, const std::string& body = "count := count + 1;",
                      const std::string& task = "INTERVAL := T#10ms, PRIORITY := 1") {
  driver::CompileInput input;
  input.texts.push_back({"test.st", "TYPE Mode : (Idle, Busy); END_TYPE\nPROGRAM P\nVAR count : INT; " +
                                        declarations + " END_VAR\n" + body +
                                        "\nEND_PROGRAM\nCONFIGURATION C RESOURCE R ON Any TASK T(" + task +
                                        "); PROGRAM Main WITH T : P; END_RESOURCE END_CONFIGURATION"});
  auto output = driver::compile(input);
  if (!output) throw std::runtime_error(result::to_string(output.error()));
  return *LoadedProgram::load(std::move(output->container), "test");
}

ProgramDiff diff(const LoadedProgram& before, const LoadedProgram& after,
                 std::span<const std::byte> image = {}) {
  auto compared = compare(before, after, image);
  if (!compared) throw std::runtime_error(result::to_string(compared.error()));
  return std::move(*compared);
}

std::vector<std::string> told(const std::vector<Difference>& list) {
  std::vector<std::string> texts;
  for (const Difference& each : list) texts.push_back(each.name + ": " + each.before + " > " + each.after);
  return texts;
}

std::vector<std::string> codes(const result::Diagnostics& problems) {
  std::vector<std::string> list;
  for (const auto& each : problems) list.push_back(each.code);
  return list;
}

TEST(ProgramDiff, WhenBothAreTheSame_ThenNothingIsDifferent) {
  const LoadedProgram one = program("a : INT; out AT %QX0.1 : BOOL;");
  const ProgramDiff same = diff(one, one);
  EXPECT_GE(same.carried, 3u);
  for (const auto* list : {&same.added, &same.removed, &same.retyped, &same.shortened, &same.references,
                           &same.moved, &same.tasks})
    EXPECT_THAT(told(*list), IsEmpty());
  EXPECT_THAT(codes(same.keep), IsEmpty());
}

TEST(ProgramDiff, WhenVariablesDiffer_ThenEachIsToldWithItsTypes) {
  const LoadedProgram before = program(
      "gone : TIME; speed : INT; mode : Mode; text : STRING[20]; list : ARRAY[1..4] OF REAL; r : REF_TO "
      "INT;");
  const LoadedProgram after = program(
      "speed : DINT; mode : Mode; text : STRING[5]; list : ARRAY[1..3] OF REAL; fresh : ARRAY[0..2] OF BOOL; "
      "few : INT(0..5); r : REF_TO INT;");
  const ProgramDiff seen = diff(before, after);
  EXPECT_THAT(told(seen.added),
              ElementsAre("Main.fresh:  > ARRAY [0..2] OF BOOL", "Main.few:  > INT (0..5)"));
  EXPECT_THAT(told(seen.removed), ElementsAre("Main.gone: TIME > "));
  EXPECT_THAT(told(seen.retyped), ElementsAre("Main.speed: INT > DINT"));
  EXPECT_THAT(told(seen.shortened), ElementsAre("Main.text: STRING[20] > STRING[5]",
                                                "Main.list: ARRAY [1..4] OF REAL > ARRAY [1..3] OF REAL"));
  EXPECT_THAT(told(seen.references), ElementsAre("Main.r: REF_TO INT > REF_TO INT"));
}

TEST(ProgramDiff, WhenAnOutputMoves_ThenItsAddressesAreToldAndTheChangeWouldBeRefused) {
  const LoadedProgram before =
      program("out AT %QX0.1 : BOOL; w AT %QW2 : INT; m AT %MD1 : DINT; i AT %IX0.0 : BOOL;",
              "out := i; w := 1; m := 2;");
  const LoadedProgram after =
      program("out AT %QX3.2 : BOOL; w AT %QW2 : INT; m AT %MD2 : DINT; i AT %IX1.7 : BOOL;",
              "out := i; w := 1; m := 2;");
  const ProgramDiff seen = diff(before, after);
  EXPECT_THAT(told(seen.moved),
              testing::UnorderedElementsAre("Main.out: %QX0.1 > %QX3.2", "Main.m: %MD1 > %MD2",
                                            "Main.i: %IX0.0 > %IX1.7"));
  EXPECT_THAT(codes(seen.keep), ElementsAre("R0034"));
  EXPECT_THAT(codes(seen.restart_charts), ElementsAre("R0034"));
}

TEST(ProgramDiff, WhenATaskDiffers_ThenBothSidesAreTold) {
  const ProgramDiff seen =
      diff(program(""), program("", "count := count + 1;", "INTERVAL := T#500us, PRIORITY := 2"));
  EXPECT_THAT(told(seen.tasks), ElementsAre("T: 10 ms, priority 1 > 500 us, priority 2"));
}

constexpr const char* kChart = R"(
  INITIAL_STEP Wait: END_STEP
  STEP Fill: END_STEP
  TRANSITION FROM Wait TO Fill := count > 3; END_TRANSITION
  TRANSITION FROM Fill TO Wait := count < 0; END_TRANSITION
)";
constexpr const char* kOtherChart = R"(
  INITIAL_STEP Wait: END_STEP
  STEP Pour: END_STEP
  TRANSITION FROM Wait TO Pour := count > 3; END_TRANSITION
  TRANSITION FROM Pour TO Wait := count < 0; END_TRANSITION
)";

class ProgramDiffChartTest : public testing::Test {
 protected:
  std::vector<std::byte> image_with(const std::string& active) const {
    std::vector<std::byte> image(before_.program().image_size());
    const auto info = reader::ProgramInfo::read(before_.bytes());
    for (const auto& step : info->charts()[0].steps) {
      if (step.name != active) continue;
      const std::byte bit =
          step.active.bit == bytecode::kNoBit ? std::byte{1} : std::byte{1} << step.active.bit;
      image[step.active.address] |= bit;
    }
    return image;
  }
  LoadedProgram before_ = program("", kChart);
  LoadedProgram after_ = program("", kOtherChart);
};

TEST_F(ProgramDiffChartTest, WhenAStepThatGoesIsActive_ThenTheChangeWouldBeRefusedUnlessChartsBeginAnew) {
  const ProgramDiff seen = diff(before_, after_, image_with("Fill"));
  ASSERT_EQ(seen.steps_removed.size(), 1u);
  EXPECT_EQ(seen.steps_removed[0].name, "Main.Fill");
  EXPECT_TRUE(seen.steps_removed[0].active);
  ASSERT_EQ(seen.steps_added.size(), 1u);
  EXPECT_EQ(seen.steps_added[0].name, "Main.Pour");
  EXPECT_THAT(codes(seen.keep), ElementsAre("R0033"));
  EXPECT_THAT(codes(seen.restart_charts), IsEmpty());
  EXPECT_THAT(told(seen.added), IsEmpty()) << "what a chart keeps for itself is no variable of anybody";
}

TEST_F(ProgramDiffChartTest, WhenAnotherStepIsActive_ThenNothingWouldBeRefused) {
  EXPECT_THAT(codes(diff(before_, after_, image_with("Wait")).keep), IsEmpty());
  EXPECT_THAT(codes(diff(before_, after_).keep), IsEmpty()) << "without an image nothing is said";
}

}  // namespace
}  // namespace stepwright::change
