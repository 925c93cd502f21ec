// What drawn networks do scan by scan, and what is said about them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "ladder/exchange/plcopen_reader.h"
#include "tests/support/compiled_program.h"
#include "tests/unit/ladder/exchange/drawn_elements.h"
#include "tests/unit/ladder/exchange/plcopen_samples.h"

namespace stepwright::exchange {
namespace {

using ::testing::HasSubstr;

TEST(DrawnLadder, WhenContactsDiffer_ThenEachPassesItsPower) {
  const std::string body = contact(2, 50, 10, "1", "a") + coil(3, 200, 10, "2", "q1") +
                           contact(4, 50, 50, "1", "a", " negated=\"true\"") + coil(5, 200, 50, "4", "q2") +
                           contact(6, 50, 90, "1", "a", " edge=\"rising\"") + coil(7, 200, 90, "6", "q3") +
                           contact(8, 50, 130, "1", "a", " edge=\"falling\"") + coil(9, 200, 130, "8", "q4");
  EXPECT_EQ(run(ladder(bools("a q1 q2 q3 q4"), body), "a", " |a|a| | ", "q1 q2 q3 q4"),
            "0100 1010 1000 0101 0100");
}

TEST(DrawnLadder, WhenCoilsDiffer_ThenEachKeepsItsKind) {
  const std::string body = contact(2, 50, 10, "1", "a") + coil(3, 200, 10, "2", "q1", " negated=\"true\"") +
                           coil(4, 200, 50, "2", "q2", " storage=\"set\"") +
                           coil(5, 200, 90, "2", "q3", " edge=\"rising\"") +
                           coil(6, 200, 130, "2", "q4", " edge=\"falling\"") + contact(7, 50, 200, "1", "b") +
                           coil(8, 200, 200, "7", "q2", " storage=\"reset\"");
  EXPECT_EQ(run(ladder(bools("a b q1 q2 q3 q4"), body), "a b", " |a|a| |b| ", "q1 q2 q3 q4"),
            "1000 0110 0100 1101 1000 1000");
}

TEST(DrawnLadder, WhenAContactThatSensesAnEdgeLeadsToALaterInput_ThenTheBlockReadsTheEdge) {
  const std::string pins = "<inputVariables><variable formalParameter=\"S\">" + in("2") +
                           "</variable><variable formalParameter=\"R1\">" + in("4") +
                           "</variable></inputVariables><inOutVariables/><outputVariables>"
                           "<variable formalParameter=\"Q1\"><connectionPointOut/></variable>"
                           "</outputVariables>";
  const std::string body = contact(2, 50, 10, "1", "b") + contact(3, 50, 60, "1", "a", " edge=\"falling\"") +
                           contact(4, 90, 60, "3", "b") +
                           at("block", 5, 150, 10, pins, " typeName=\"RS\" instanceName=\"keep\"") +
                           coil(6, 250, 10, "5:Q1", "q") + contact(7, 50, 110, "1", "b", " edge=\"rising\"") +
                           coil(8, 250, 110, "7", "idle", " negated=\"true\" storage=\"set\"");
  const std::string keep = "<variable name=\"keep\"><type><derived name=\"RS\"/></type></variable>\n";
  // The fall of a resets only while b is on; the coil latches what is not the rise of b.
  EXPECT_EQ(run(ladder(bools("a b q idle") + keep, body), "a b", "b|a b|b|b|a| ", "q idle"),
            "10 11 01 11 11 11");
}

TEST(DrawnLadder, WhenBlocksWithEnableStandInSeries_ThenPowerGoesOnThroughEno) {
  const std::string body = contact(2, 50, 10, "1", "a") + input(3, 50, 40, "n") + input(4, 50, 60, "1") +
                           block(5, 120, 10, "ADD", "EN=2 IN1=3 IN2=4", "ENO OUT") +
                           output(6, 220, 40, "5:OUT", "n") + contact(7, 240, 10, "5:ENO", "b") +
                           block(8, 320, 10, "MOVE", "EN=7 IN=9", "ENO OUT") + input(9, 280, 60, "n") +
                           output(10, 420, 40, "8:OUT", "m") + coil(11, 500, 10, "8:ENO", "done");
  EXPECT_EQ(run(ladder(bools("a b done") + ints("n m"), body), "a b", " |a|a b|b|a b", "n m done"),
            "000 100 221 220 331");
}

TEST(DrawnLadder, WhenAFunctionHasNoValue_ThenEnoIsWithoutPower) {
  const std::string body =
      contact(2, 50, 10, "1", "a") + input(3, 50, 40, "12") + input(4, 50, 60, "n") +
      block(5, 120, 10, "DIV", "EN=2 IN1=3 IN2=4", "ENO OUT") + output(6, 220, 40, "5:OUT", "m") +
      coil(7, 240, 10, "5:ENO", "done") + contact(8, 50, 110, "1", "b") + input(9, 50, 140, "4") +
      block(10, 120, 110, "MOVE", "EN=8 IN=9", "ENO OUT") + output(11, 220, 140, "10:OUT", "n") +
      block(12, 120, 210, "DIV", "EN=2 IN1=3 IN2=4", "ENO OUT") + coil(13, 240, 210, "12:ENO", "may");
  EXPECT_EQ(run(ladder(bools("a b done may") + ints("n m"), body), "a b", " |a|b|a", "n m done may"),
            "0000 0000 4000 4311");
}

TEST(DrawnLadder, WhenBranchesAreParallel_ThenTheyAreAWiredOr) {
  const std::string body = contact(2, 50, 10, "1", "a") + contact(3, 100, 10, "2", "b") +
                           contact(4, 50, 50, "1", "c") + contact(5, 150, 10, "3 4", "d") +
                           coil(6, 250, 10, "5", "q");
  EXPECT_EQ(run(ladder(bools("a b c d q"), body), "a b c d", "a d|a b d|c d|c|a b c d", "q"), "0 1 1 0 1");
}

TEST(DrawnLadder, WhenItJumpsAndReturns_ThenNetworksAreLeftOut) {
  const std::string body = contact(2, 50, 10, "1", "skip") +
                           at("jump", 3, 200, 10, in("2"), " label=\"over\"") + contact(4, 50, 60, "1", "a") +
                           coil(5, 200, 60, "4", "q1") + at("label", 6, 50, 110, "", " label=\"over\"") +
                           contact(7, 50, 130, "1", "a") + coil(8, 200, 130, "7", "q2") +
                           contact(9, 50, 180, "1", "stop") + at("return", 10, 200, 180, in("9")) +
                           contact(11, 50, 230, "1", "a") + coil(12, 200, 230, "11", "q3");
  EXPECT_EQ(run(ladder(bools("skip stop a q1 q2 q3"), body), "skip stop a", "a|skip|stop a| |skip stop a",
                "q1 q2 q3"),
            "111 100 110 000 010");
}

TEST(DrawnBlocks, WhenInputsHaveSeveralTypes_ThenTheWireTakesTheTypeOfTheResult) {
  // n * x is REAL although n comes first; a DINT behind an INT needs 32 bits.
  const std::string body = input(1, 0, 0, "n") + input(2, 0, 40, "x") +
                           block(3, 100, 0, "MUL", "IN1=1 IN2=2", "OUT") + output(4, 200, 0, "3:OUT", "y") +
                           output(5, 200, 40, "3:OUT", "z") + input(6, 0, 100, "n") +
                           input(7, 0, 140, "big") + block(8, 100, 100, "ADD", "IN1=6 IN2=7", "OUT") +
                           output(9, 200, 100, "8:OUT", "sum") + output(10, 200, 140, "8:OUT", "sum2") +
                           block(11, 300, 100, "GT", "IN1=8:OUT IN2=12", "OUT") +
                           input(12, 240, 180, "70000") + output(13, 400, 100, "11:OUT", "more");
  const std::string variables =
      bools("more") + ints("n") + ints("big sum sum2", "DINT") + ints("x y z", "REAL");
  const auto project =
      read_plcopen("plc.xml", editor_project(editor_program(variables, "<FBD>\n" + body + "</FBD>\n")));
  ASSERT_TRUE(project);
  support::CompiledProgram program(input_of(*project));
  program.set("run.n", 3);
  program.set("run.big", 70'000);
  const float half = 0.5F;
  std::int64_t bits = 0;
  std::memcpy(&bits, &half, sizeof half);
  program.set("run.x", bits);
  ASSERT_FALSE(program.scan().trap);
  EXPECT_EQ(program.text("run.y"), "1.5");
  EXPECT_EQ(program.text("run.z"), "1.5");
  EXPECT_EQ(program.get("run.sum2"), 70'003);
  EXPECT_EQ(program.get("run.more"), 1);
}

TEST(DrawnBlocks, WhenTheDifferenceOfDatesIsReadBeforeItIsComputed_ThenItIsADuration) {
  const std::string body = input(1, 0, 20, "late") + input(2, 0, 40, "early") +
                           block(3, 100, 0, "SUB", "EN=5:OUT IN1=1 IN2=2", "ENO OUT") +
                           input(4, 200, 60, "T#0s") + block(5, 300, 0, "GE", "IN1=3:OUT IN2=4", "OUT") +
                           output(6, 400, 60, "3:OUT", "took");
  const std::string variables = ints("late early", "DT") + ints("took", "TIME");
  const auto project =
      read_plcopen("plc.xml", editor_project(editor_program(variables, "<FBD>\n" + body + "</FBD>\n")));
  ASSERT_TRUE(project);
  const auto compiled = driver::compile(input_of(*project));
  ASSERT_TRUE(compiled) << result::to_string(compiled.error());
  support::CompiledProgram program(input_of(*project));
  program.set("run.late", 7'000'000'000);
  program.set("run.early", 2'000'000'000);
  ASSERT_FALSE(program.scan().trap);
  ASSERT_FALSE(program.scan().trap);
  EXPECT_EQ(program.get("run.took"), 5'000'000'000);
}

TEST(DrawnBlocks, WhenAVariableIsUnknown_ThenWhatIsComputedFromItIsNotReported) {
  const std::string body = input(1, 0, 0, "missing") + input(2, 0, 40, "n") +
                           block(3, 100, 0, "ADD", "IN1=1 IN2=2", "OUT") + output(4, 200, 0, "3:OUT", "n") +
                           output(5, 200, 40, "3:OUT", "m");
  const auto project =
      read_plcopen("plc.xml", editor_project(editor_program(ints("n m"), "<FBD>\n" + body + "</FBD>\n")));
  ASSERT_TRUE(project);
  const auto compiled = driver::compile(input_of(*project));
  ASSERT_FALSE(compiled);
  ASSERT_EQ(compiled.error().size(), 1U) << result::to_string(compiled.error());
  EXPECT_EQ(compiled.error().front().code, "E0201");
}

TEST(DrawnLadder, WhenAVariableIsUnknown_ThenPouNetworkElementAndPlaceAreNamed) {
  const std::string xml =
      ladder(bools("a q"), contact(2, 50, 10, "1", "a") + coil(3, 200, 10, "2", "q") +
                               contact(4, 50, 60, "1", "a") + coil(5, 200, 60, "4", "nowhere"));
  const auto project = read_plcopen("plc.xml", xml);
  ASSERT_TRUE(project);
  const auto output = driver::compile(input_of(*project));
  ASSERT_FALSE(output);
  const result::Diagnostic& first = output.error().front();
  EXPECT_THAT(first.message, HasSubstr("POU 'main', network 2, coil 'nowhere': "));
  EXPECT_EQ(first.where.file, "plc.xml");
  EXPECT_EQ(first.where.line,
            1 + static_cast<std::uint32_t>(std::count(
                    xml.begin(), xml.begin() + static_cast<std::ptrdiff_t>(xml.find("nowhere")), '\n')));
}

TEST(DrawnLadder, WhenAChainOfContactsIsTooLong_ThenOneOfThemIsNamed) {
  const auto chain = [](int length) {
    std::string body;
    for (int i = 0; i < length; ++i) {
      const std::string from = i == 0 ? "1" : std::to_string(i + 9);
      body += contact(i + 10, 50 + 40 * i, 10, from, "a");
    }
    return ladder(bools("a q"), body + coil(2, 50 + 40 * length, 10, std::to_string(length + 9), "q"));
  };
  EXPECT_EQ(run(chain(1000), "a", " |a", "q"), "0 1");
  const auto project = read_plcopen("plc.xml", chain(1001));
  ASSERT_TRUE(project);
  const auto output = driver::compile(input_of(*project));
  ASSERT_FALSE(output);
  EXPECT_EQ(output.error().front().code, "E0106");
  EXPECT_THAT(output.error().front().message, HasSubstr("POU 'main', network 1, contact 'a': "));
  EXPECT_EQ(output.error().front().where.file, "plc.xml");
}

}  // namespace
}  // namespace stepwright::exchange
