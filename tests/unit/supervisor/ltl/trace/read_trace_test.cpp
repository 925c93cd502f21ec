#include "supervisor/ltl/trace/read_trace.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "supervisor/ltl/syntax/formula.h"

namespace stepwright::ltl {
namespace {

const std::string kTable =
    "scan,time_s,MAIN.run,MAIN.level,MAIN.delay [s],MAIN.mode\r\n"
    "1,0.000000000,0,12,0.500000000,Idle\r\n"
    "2,0.010000000,0,19,0.500000000,Idle\r\n"
    "3,0.020000000,1,20,1.500000000,\"Run, fast\"\r\n"
    "4,0.030000000,1,25.5,1.500000000,Idle\r\n";

std::string refusal(const std::string& text, const std::vector<std::string>& propositions,
                    const std::vector<Binding>& bindings = {}) {
  const auto trace = read_trace(text, "run.csv", propositions, bindings);
  if (trace) return "read";
  const result::Diagnostic& first = trace.error().front();
  EXPECT_FALSE(first.hint.empty()) << first.message;
  return std::to_string(first.where.line) + ":" + std::to_string(first.where.column) + " " + first.code;
}

TEST(ReadTrace, Changes_WhenColumnsAreBound_ThenTheyAreTheWordOfLabels) {
  const auto trace = read_trace(kTable, "run.csv", {"main.RUN", "full", "slow", "idle"},
                                {*read_binding("full=main.level >= 20"), *read_binding("slow=MAIN.delay>1"),
                                 *read_binding("idle=MAIN.mode=idle")});
  ASSERT_TRUE(trace) << result::to_string(trace.error());
  EXPECT_EQ(trace->rows, 4u);
  ASSERT_EQ(trace->changes.size(), 3u);
  EXPECT_EQ(trace->changes[0].letter, 0b1000u);
  EXPECT_EQ(trace->changes[1].letter, 0b0111u);
  EXPECT_EQ(trace->changes[1].row, 3u);
  EXPECT_EQ(trace->changes[1].line, 4u);
  EXPECT_EQ(trace->changes[1].scan, "3");
  EXPECT_EQ(trace->changes[1].time_s, "0.020000000");
  EXPECT_EQ(trace->changes[2].letter, 0b1111u);
}

// The letter of one field, as '1' or '0', for each of the comparisons.
std::string compared(const std::string& field, const std::string& value) {
  std::string bits;
  for (const char* sign : {"<", "<=", "=", "<>", ">=", ">"}) {
    const auto trace = read_trace("v\n" + field + "\n", "run.csv", std::vector<std::string>{"x"},
                                  {*read_binding("x=v" + std::string(sign) + value)});
    bits += !trace ? '?' : trace->changes.at(0).letter == 1 ? '1' : '0';
  }
  return bits;
}

TEST(ReadTrace, Comparison_WhenNumbersHaveSixtyFourBits_ThenItIsExact) {
  const std::string less = "110100", equal = "011010", greater = "000111";
  EXPECT_EQ(compared("9007199254740993", "9007199254740992"), greater);
  EXPECT_EQ(compared("9223372036854775806", "9223372036854775807"), less);
  EXPECT_EQ(compared("-9223372036854775808", "-9223372036854775807"), less);
  EXPECT_EQ(compared("18446744073709551615", "18446744073709551615"), equal);
  EXPECT_EQ(compared("18446744073709551615", "18446744073709551616"), less);
  EXPECT_EQ(compared("18446744073709551615", "-1"), greater);
  EXPECT_EQ(compared("-0", "00"), equal);
  EXPECT_EQ(compared("007", "7"), equal);
  EXPECT_EQ(compared("-12", "-7"), less);
  EXPECT_EQ(compared("9", "10"), less);
  EXPECT_EQ(compared("20", "19.5"), greater);
  EXPECT_EQ(compared("-", "0").front(), '?');
}

TEST(ReadTrace, Refusal_WhenATableOrAColumnIsWrong_ThenThePlaceIsNamed) {
  EXPECT_EQ(refusal("", {"a"}), "1:1 L0041");
  EXPECT_EQ(refusal("a\n1\n\n0,1\n", {"a"}), "4:1 L0041");
  EXPECT_EQ(refusal("a,b\n1,\"x\n", {"a"}), "2:3 L0041");
  EXPECT_EQ(refusal("a,b\n1,\"x\"y\n", {"a"}), "2:3 L0041");
  EXPECT_EQ(refusal(kTable, {"MAIN.runs"}), "1:1 L0042");
  EXPECT_EQ(refusal(kTable, {"MAIN.level"}), "2:17 L0044");
  EXPECT_EQ(refusal(kTable, {"x"}, {*read_binding("x=MAIN.mode<3")}), "2:32 L0044");
  EXPECT_EQ(refusal(kTable, {"x"}, {*read_binding("y=MAIN.run")}), "0:0 L0045");
  const auto misspelt = read_trace(kTable, "run.csv", {"MAIN.runs"}, {});
  EXPECT_NE(misspelt.error().front().hint.find("did you mean 'MAIN.run'"), std::string::npos);
}

TEST(ReadTrace, Refusal_WhenAMeaningOrAColumnIsThereTwice_ThenNeitherIsTaken) {
  EXPECT_EQ(refusal("a,b\n1,0\n", {"x"}, {*read_binding("x=a"), *read_binding("x=b")}), "0:0 L0046");
  EXPECT_EQ(refusal("a,b,a\n1,0,0\n", {"a"}), "1:5 L0046");
  EXPECT_EQ(refusal("A,b,a [s]\n1,0,0\n", {"a"}), "1:5 L0046");
  EXPECT_EQ(refusal("time_s,a,time_s\n0,1,0\n", {"a"}), "1:10 L0046");
  EXPECT_EQ(refusal("A,a,b,b\n1,0,x,x\n", {"a"}), "read") << "the exact name; b is not asked for";
}

// As many as memory has: an endless line of an endless file must end somewhere.
TEST(ReadTrace, Row_WhenItIsLongerThanAMebibyte_ThenRefusedAtItsLine) {
  const std::string wide(std::size_t{1} << 20, ' ');
  EXPECT_EQ(refusal(wide + ",a\n", {"a"}), "1:1 L0041");
  EXPECT_EQ(refusal("a,b\n1,x\n0," + wide + "\n", {"a"}), "3:1 L0041");
  EXPECT_EQ(refusal("a,b\n1,x\n0,\"" + wide + "\"\n", {"a"}), "3:1 L0041");
  EXPECT_EQ(refusal("a,b\n1," + std::string(500'000, 'x') + "\n", {"a"}), "read");
}

// Letters of a, in hundredths of a second from 0 on, as those of the timer's proposition.
std::string timed(const std::string& formula, const std::string& a, const std::string& b = {}) {
  std::string text = "time_s,a,b\n";
  for (std::size_t k = 0; k < a.size(); ++k)
    text +=
        std::to_string(0.01 * static_cast<double>(k)) + "," + a[k] + "," + (b.empty() ? '0' : b[k]) + "\n";
  const auto parsed = parse_formula(formula, {}, {"a", "b"});
  const auto trace = read_trace(text, "run.csv", parsed->tree, {});
  if (!trace) return result::to_string(trace.error());
  std::string bits(a.size(), '?');
  std::size_t change = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (change + 1 < trace->changes.size() && trace->changes[change + 1].row == k + 1) ++change;
    bits[k] = (trace->changes[change].letter >> 2 & 1) != 0 ? '1' : '0';
  }
  return bits;
}

TEST(ReadTrace, Timer_WhenRowsHaveTimes_ThenItsPropositionIsThatOfATimerLookedAtOnceARow) {
  EXPECT_EQ(timed("never a for T#20ms", "01110111110"), "00010001110");
  EXPECT_EQ(timed("b responds to a within T#20ms", "0100000100", "0000010000"), "0001100001");
  EXPECT_EQ(timed("b responds to a within T#20ms", "1010100000", "0010000000"), "0000001111")
      << "an answer may come with what it answers";
  EXPECT_EQ(timed("a within T#30ms", "000000"), "000111");
}

TEST(ReadTrace, Timer_WhenThereAreNoTimes_ThenRefused) {
  const auto formula = parse_formula("never a for T#20ms");
  EXPECT_EQ(read_trace("a\n1\n", "run.csv", formula->tree, {}).error().front().code, "L0042");
  EXPECT_EQ(read_trace("time_s,a\nx,1\n", "run.csv", formula->tree, {}).error().front().code, "L0044");
}

TEST(ReadTrace, Timer_WhenTimeGoesBackwards_ThenRefusedAtItsRow) {
  const auto formula = parse_formula("never a for T#20ms");
  const auto refused = read_trace("time_s,a\n-1,1\n0.5,1\n0.5,0\n0.499,1\n", "run.csv", formula->tree, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().code, "L0044");
  EXPECT_EQ(refused.error().front().where.line, 5u);
  EXPECT_EQ(refused.error().front().where.column, 1u);
  EXPECT_EQ(refusal("time_s,a\n2,1\n1,0\n", {"a"}), "read") << "nobody asks for the time";
}

TEST(ReadTrace, Text_WhenBytesAreChanged_ThenReadOrRefused) {
  std::mt19937 random(3);
  int read = 0;
  for (int round = 0; round < 20'000; ++round) {
    std::string text = kTable;
    for (auto k = random() % 4; k > 0; --k) {
      const std::size_t at = random() % text.size();
      if (random() % 2 == 0)
        text[at] = random() % 2 == 0 ? "\",\r\n01"[random() % 6] : static_cast<char>(random());
      else
        text.erase(at, random() % 6);
    }
    const auto trace =
        read_trace(text, "run.csv", {"MAIN.run", "full"}, {*read_binding("full=MAIN.level>20")});
    ASSERT_TRUE(trace.has_value() || !trace.error().front().hint.empty());
    if (trace) ++read;
  }
  EXPECT_GT(read, 1'000);
}

}  // namespace
}  // namespace stepwright::ltl
