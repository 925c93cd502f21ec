#include "ladder/exchange/omron_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "ladder/lowering/sfc_to_ladder.h"
#include "tests/support/ladder_evaluator.h"
#include "tests/support/sample_charts.h"
#include "tests/unit/ladder/exchange/omron_controller.h"
#include "tests/unit/ladder/lowering/random_chart.h"

namespace stepwright::exchange {
namespace {

using graphic::SfcChart;
using ::testing::HasSubstr;

graphic::Pou lowered(SfcChart chart) {
  graphic::Pou pou;
  pou.name = "main";
  pou.body = std::move(chart);
  return *lowering::lower_sfc(pou);
}

// The paper's Tables 1 to 3.
OmronOptions bench() {
  return {{{"fc1", "I0.00"},
           {"fc2", "I0.01"},
           {"B1", "Q1.00"},
           {"B2", "Q1.01"},
           {"drive_left", "Q1.02"},
           {"drive_right", "Q1.03"},
           {"S1", "D100", "2001"},
           {"S2", "D101", "2002"}}};
}

std::string address_of(const OmronProgram& program, const std::string& variable) {
  for (const OmronTableRow& row : program.table) {
    if (row.variable == variable) return row.address;
  }
  return "";
}

std::string error_of(const graphic::Pou& pou, const OmronOptions& options) {
  const result::Result<OmronProgram> program = write_omron(pou, options);
  return program ? "written" : result::to_string(program.error().front());
}

TEST(OmronWriter, WhenChartIsThePapersPlan_ThenAddressesAndComparisonsAreThoseOfFigure14) {
  const result::Result<OmronProgram> program = write_omron(lowered(support::sequence_chart()), bench());
  ASSERT_TRUE(program) << result::to_string(program.error());
  EXPECT_EQ(address_of(*program, "S00_START_X"), "W10.00");
  EXPECT_EQ(address_of(*program, "S01_LOAD_X"), "W10.01");
  EXPECT_EQ(address_of(*program, "T00_FIRES"), "W20.00");
  EXPECT_EQ(address_of(*program, "B1"), "Q:1.00");
  EXPECT_THAT(program->statements,
              HasSubstr("LD W10.00\nAND 0.00\nAND<S(312) D100 +1400\nAND<S(312) D101 +800\nOUT W20.00\n"));
  EXPECT_THAT(program->statements, HasSubstr("LD W10.01\nAND>S(322) D100 +3783\nOUT W20.01\n"));
  EXPECT_THAT(program->statements, HasSubstr("LD CF113\nMOV(021) 2001 D100\n"));
  EXPECT_THAT(program->statements, HasSubstr("LD W10.01\nOUT 1.00\n"));
  EXPECT_THAT(program->to_text(), HasSubstr("'Program\n"));
}

TEST(OmronWriter, WhenStepsFillAWord_ThenTheNextWordFollows) {
  SfcChart chart;
  chart.steps.resize(18);
  for (std::size_t i = 0; i < chart.steps.size(); ++i) chart.steps[i].name = "S" + std::to_string(i);
  chart.steps[0].initial = true;
  const result::Result<OmronProgram> program = write_omron(lowered(chart), {});
  ASSERT_TRUE(program);
  EXPECT_EQ(address_of(*program, "S15_X"), "W10.15");
  EXPECT_EQ(address_of(*program, "S16_X"), "W11.00");
  EXPECT_EQ(address_of(*program, "S17_X"), "W11.01");
  chart.steps.resize(161);
  for (std::size_t i = 0; i < chart.steps.size(); ++i) chart.steps[i].name = "S" + std::to_string(i);
  EXPECT_THAT(error_of(lowered(chart), {}), HasSubstr("E0813: no bit is left for 'S160_X'"));
}

// Everything that the writer accepts runs on the controller as it does in the ladder.
TEST(OmronWriter, WhenChartsAndInputsAreRandom_ThenTheControllerFollowsTheLadder) {
  OmronOptions options{{{"i0", "I0.00"},
                        {"i1", "I0.01"},
                        {"i2", "I0.02"},
                        {"i3", "I0.03"},
                        {"n0", "D100"},
                        {"n1", "D101"},
                        {"o0", "Q1.00"},
                        {"o1", "Q1.01"},
                        {"o2", "Q1.02"},
                        {"o3", "Q1.03"}}};
  int written = 0;
  for (unsigned seed = 1; seed <= 2000 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const graphic::Pou pou = *lowering::lower_sfc(lowering::random_pou(random));
    const result::Result<OmronProgram> program = write_omron(pou, options);
    if (!program) {
      EXPECT_EQ(program.error().front().code, "E0812");  // step times
      continue;
    }
    ++written;
    OmronController controller(program->statements);
    support::LadderEvaluator ladder(pou);
    for (int scan = 1; scan <= 40 && !HasFailure(); ++scan) {
      for (int i = 0; i < 4; ++i) {
        const bool value = random() % 2 == 0;
        ladder.set("i" + std::to_string(i), value);
        controller.set_bit("0.0" + std::to_string(i), value);
      }
      for (int i = 0; i < 2; ++i) {
        const int value = static_cast<int>(random() % 5);
        ladder.set("n" + std::to_string(i), value);
        controller.set_word("D10" + std::to_string(i), value);
      }
      ladder.scan(scan * 10'000'000);
      controller.cycle(scan * 10'000'000);
      for (const std::string& step : pou.step_variables) {
        EXPECT_EQ(controller.bit(address_of(*program, step)), ladder.get(step) != 0)
            << step << " scan " << scan;
      }
      for (int i = 0; i < 4; ++i) {
        EXPECT_EQ(controller.bit("1.0" + std::to_string(i)), ladder.get("o" + std::to_string(i)) != 0)
            << scan;
      }
      for (const char* counter : {"c0", "c1"}) {
        EXPECT_EQ(controller.word(address_of(*program, counter)), ladder.get(counter)) << scan;
      }
    }
  }
  EXPECT_GT(written, 300);
}

TEST(OmronWriter, WhenConstructHasNoCounterpart_ThenTheDiagnosticNamesTheRung) {
  graphic::Pou pou = lowered(support::sequence_chart());
  auto& rungs = std::get<graphic::LadderProgram>(pou.body).rungs;
  const auto with = [&](const graphic::Condition& condition) {
    rungs[0].condition = condition;
    return error_of(pou, bench());
  };
  graphic::Condition expression;
  expression.kind = graphic::ConditionKind::Expression;
  expression.name = "a XOR b";
  EXPECT_THAT(with(expression),
              HasSubstr("E0812: rung 1 (Transition S00_START -> S01_LOAD): the expression 'a XOR b'"));
  EXPECT_THAT(with(graphic::compare("S1", graphic::CompareOp::Less, "40000")), HasSubstr("E0812: rung 1"));
  EXPECT_THAT(with(graphic::compare("S1", graphic::CompareOp::Less, "1.5")), HasSubstr("E0812: rung 1"));
  EXPECT_THAT(with(graphic::contact("unknown")), HasSubstr("'unknown' has no Omron address"));
  EXPECT_THAT(with(graphic::contact("S1")), HasSubstr("'S1' at D100 is no bit"));
  rungs[0].condition = graphic::always();
  rungs[0].coils[0].variable = "fc1";
  EXPECT_THAT(error_of(pou, bench()), HasSubstr("'fc1' at I:0.00 cannot be driven by a coil"));
  rungs[0].jump_to = "L";
  EXPECT_THAT(error_of(pou, bench()), HasSubstr("jumps, labels and returns"));
}

TEST(OmronWriter, WhenTimeHasNoExactSetValue_ThenItIsRefused) {
  SfcChart chart = support::sequence_chart();
  chart.steps[1].actions = {{graphic::Qualifier::D, "B1", "T#2s"}};
  const result::Result<OmronProgram> program = write_omron(lowered(chart), bench());
  ASSERT_TRUE(program) << result::to_string(program.error());
  EXPECT_THAT(program->statements, HasSubstr("LD W10.01\nTIM 0000 #0020\n"));
  EXPECT_THAT(program->statements, HasSubstr("LD T0000\nOUT 1.00\n"));
  chart.steps[1].actions[0].duration = "T#250ms";
  EXPECT_THAT(write_omron(lowered(chart), bench())->statements, HasSubstr("TIMH(015) 0000 #0025\n"));
  for (const char* duration : {"T#5ms", "T#2000s", "T#0s", "delay"}) {
    chart.steps[1].actions[0].duration = duration;
    EXPECT_THAT(error_of(lowered(chart), bench()), HasSubstr("E0812")) << duration;
  }
}

TEST(OmronWriter, WhenAddressesAreWrong_ThenNothingIsWritten) {
  const graphic::Pou pou = lowered(support::sequence_chart());
  OmronOptions options = bench();
  options.addresses[0].address = "%IX0.0";
  EXPECT_THAT(error_of(pou, options), HasSubstr("E0811: variable 'fc1' has the address '%IX0.0'"));
  options = bench();
  options.addresses[1].address = "I0.00";
  EXPECT_THAT(error_of(pou, options), HasSubstr("E0811: address I:0.00 of variable 'fc2' is in use"));
  options = bench();
  options.addresses[6].source = "0.00";
  EXPECT_THAT(error_of(pou, options), HasSubstr("cannot be copied from '0.00'"));
}

TEST(OmronWriter, WhenVariablesHaveNoAddress_ThenEachIsToldOnce) {
  const graphic::Pou pou = lowered(support::sequence_chart());
  OmronOptions options = bench();
  options.addresses[0].address.clear();     // as the binding of a cell for another controller has it
  options.addresses[1].address = "%IX0.1";  // refused, hence not missed again
  const auto program = write_omron(pou, options);
  ASSERT_FALSE(program);
  const std::string told = result::to_string(program.error());
  EXPECT_EQ(program.error().size(), 2u) << told;
  EXPECT_THAT(told, HasSubstr("input or output 'fc1' has no Omron address"));
  EXPECT_THAT(told, HasSubstr("variable 'fc2' has the address '%IX0.1'"));
}

TEST(OmronWriter, WhenStepsDoNotFit_ThenTheAreaIsToldOnce) {
  graphic::Pou pou = lowered(support::sequence_chart());
  for (int k = 0; k < 300; ++k) {
    pou.variables.push_back({"more" + std::to_string(k), "BOOL"});
    pou.step_variables.push_back(pou.variables.back().name);
  }
  const auto program = write_omron(pou, bench());
  ASSERT_FALSE(program);
  EXPECT_EQ(program.error().size(), 1u) << result::to_string(program.error());
}

TEST(OmronWriter, WhenABitHasAnInitialValue_ThenItIsSetInTheFirstCycle) {
  graphic::Pou pou = lowered(support::sequence_chart());
  const auto with = [&](const char* initial) {
    graphic::Pou copy = pou;
    copy.variables.push_back({"ready", "BOOL"});
    copy.variables.back().initial = initial;
    const auto program = write_omron(copy, bench());
    if (!program) return result::to_string(program.error());
    const bool set = program->statements.find("SET " + address_of(*program, "ready")) != std::string::npos;
    return std::string(set ? "set" : "not set");
  };
  for (const char* initial : {"TRUE", "true", "1", "BOOL#TRUE", "bool#1"})
    EXPECT_EQ(with(initial), "set") << initial;
  for (const char* initial : {"", "FALSE", "0", "BOOL#0"}) EXPECT_EQ(with(initial), "not set") << initial;
  EXPECT_THAT(with("START_READY"), HasSubstr("E0812: the initial value 'START_READY' of 'ready'"));
}

TEST(OmronWriter, WhenWordsRunOut_ThenTheDiagnosticSaysSo) {
  graphic::Pou pou = lowered(support::sequence_chart());
  for (int i = 0; i < 32768; ++i) pou.variables.push_back({"n" + std::to_string(i), "INT"});
  EXPECT_THAT(error_of(pou, bench()), HasSubstr("E0813: no word is left for 'n32568'"));
}

TEST(OmronWriter, WhenGivenAddressIsInAStepWord_ThenStepsStepAside) {
  OmronOptions options = bench();
  options.addresses[2].address = "W10.01";
  const result::Result<OmronProgram> program = write_omron(lowered(support::sequence_chart()), options);
  ASSERT_TRUE(program);
  EXPECT_EQ(address_of(*program, "S01_LOAD_X"), "W10.02");
}

}  // namespace
}  // namespace stepwright::exchange
