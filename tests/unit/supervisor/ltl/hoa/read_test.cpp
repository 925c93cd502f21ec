#include <gtest/gtest.h>

#include <random>
#include <string>

#include "supervisor/ltl/automaton/build.h"
#include "supervisor/ltl/hoa/hoa.h"

namespace stepwright::ltl {
namespace {

std::string text_of(const std::string& header, const std::string& body) {
  return "HOA: v1\n" + header + "--BODY--\n" + body + "--END--\n";
}

const std::string kHeader = "States: 2\nStart: 0\nAP: 2 \"a\" \"b\"\nAcceptance: 1 Inf(0)\n";

Automaton task(const std::string& text) {
  return *task_automaton(*parse_formula(text, "", {"a", "b"}));
}

TEST(ReadHoa, Automaton_WhenLabelsAreWrittenInAnyWay_ThenItIsTheSame) {
  for (const std::string& text :
       {text_of(kHeader, "State: 0\n[!0] 0\n[0] 1\nState: 1 {0}\n[t] 1\n"),
        text_of(
            kHeader + "Alias: @x 0&1 | 0&!1\nproperties: deterministic\nname: \"F a\"\ntool: \"x\" \"1\"\n",
            "State: 0 \"wait\"\n[!@x] 0 /* a /* comment */ */\n[@x] 1\nState: [t] 1 {0}\n1\n"),
        text_of(kHeader, "State: 0\n0 1 0 1\nState: 1 {0}\n1 1 1 1\n"),
        text_of("Start: 1\nAP: 2 \"a\" \"b\"\nAcceptance: 1 Fin(0)\n",
                "State: 1 {0}\n[!(0 | f) & t] 1\n[0] 0\nState: 0\n[t] 0\n")}) {
    const auto read = read_hoa(text);
    ASSERT_TRUE(read) << text << result::to_string(read.error());
    EXPECT_EQ(read->part, HoaPart::Good);
    EXPECT_EQ(read->automaton, task("F a")) << text;
  }
}

TEST(ReadHoa, Automaton_WhenStatesThatDoNotAcceptAreNeverLeft_ThenItIsSafe) {
  const auto read = read_hoa(text_of(kHeader, "State: 0 {0}\n[!0] 0\n[0] 1\nState: 1\n[t] 1\n"));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->part, HoaPart::Bad);
  EXPECT_EQ(read->automaton, monitor_automaton(*parse_formula("G !a", "", {"a", "b"}))->automaton);
}

std::string refusal(const std::string& text) {
  const auto read = read_hoa(text, "task.hoa");
  if (read) return "read";
  const result::Diagnostic& first = read.error().front();
  EXPECT_FALSE(first.hint.empty());
  return std::to_string(first.where.line) + ":" + std::to_string(first.where.column) + " " + first.code;
}

TEST(ReadHoa, Refusal_WhenNotSupported_ThenThePlaceIsNamed) {
  EXPECT_EQ(refusal(text_of(kHeader, "State: 0\n[!0] 0\n[1] 1\nState: 1 {0}\n[t] 1\n")), "9:1 L0022");
  EXPECT_EQ(refusal(text_of(kHeader, "State: 0\n[!0] 0\nState: 1 {0}\n[t] 1\n")), "7:1 L0023");
  EXPECT_EQ(refusal(text_of(kHeader, "State: 0\n[t] 1\nState: 1 {0}\n[t] 0\n")), "10:1 L0024");
  EXPECT_EQ(refusal(text_of(kHeader, "State: 0\n[t] 1 {0}\nState: 1\n[t] 0\n")), "8:7 L0024");
  EXPECT_EQ(refusal(text_of(kHeader, "State: 0\n[t] 1\n")), "9:1 L0023");
  EXPECT_EQ(refusal(text_of(kHeader, "State: 0\n[2] 1\n")), "8:2 L0021");
  EXPECT_EQ(refusal(text_of(kHeader, "State: 0\n[t] 0&1\n")), "8:1 L0025");
  EXPECT_EQ(refusal(text_of(kHeader, "State: 0 {1}\n[t] 0\nState: 1\n[t] 1\n")), "7:11 L0021");
  EXPECT_EQ(refusal(text_of("Start: 0\nStart: 1\nAP: 0\nAcceptance: 0 t\n", "State: 0\n[t] 0\n")),
            "3:1 L0025");
  EXPECT_EQ(refusal(text_of("Start: 0\nAP: 0\nAcceptance: 2 Inf(0)&Inf(1)\n", "")), "4:1 L0024");
  EXPECT_EQ(refusal(text_of("Start: 0\nAP: 0\nAcceptance: 0 t\nFairness: 1\n", "")), "5:1 L0025");
  EXPECT_EQ(refusal(text_of("Start: 4000000\n", "")), "2:1 L0026");
  EXPECT_EQ(refusal("HOA: v2\n"), "1:6 L0025");
  EXPECT_EQ(refusal("never { }"), "1:1 L0021");
  EXPECT_EQ(refusal(text_of(kHeader, "State: 0\n[" + std::string(100'000, '(') + "0] 1\n")), "8:1003 L0026");
}

// Each round of the refinement alone would tell one state more from the others.
TEST(ReadHoa, Automaton_WhenItIsALongChain_ThenItIsMinimalInAFewRounds) {
  constexpr int kStates = 20'000;
  std::string body;
  for (int k = 0; k + 1 < kStates; ++k)
    body += "State: " + std::to_string(k) + "\n[0] " + std::to_string(k + 1) + "\n[!0] 0\n";
  body += "State: " + std::to_string(kStates - 1) + " {0}\n[t] " + std::to_string(kStates - 1) + "\n";
  const auto read = read_hoa(text_of("Start: 0\nAP: 1 \"a\"\nAcceptance: 1 Inf(0)\n", body));
  ASSERT_TRUE(read) << result::to_string(read.error());
  EXPECT_EQ(read->automaton.size(), static_cast<std::size_t>(kStates));
  EXPECT_EQ(read->automaton.distance[0], static_cast<std::uint32_t>(kStates - 1));
}

TEST(ReadHoa, Text_WhenBytesAreChanged_ThenReadOrRefused) {
  std::mt19937 random(5);
  const std::string good =
      text_of(kHeader + "Alias: @x 0&1 | 0&!1\n", "State: 0 {0}\n[!@x] 0\n[@x] 1\nState: 1\n[t] 1\n");
  for (int round = 0; round < 20'000; ++round) {
    std::string text = good;
    for (auto k = random() % 4; k > 0; --k) {
      const std::size_t at = random() % text.size();
      if (random() % 2 == 0)
        text[at] = static_cast<char>(random());
      else
        text.erase(at, random() % 8);
    }
    const auto read = read_hoa(text);
    ASSERT_TRUE(read.has_value() || !read.error().empty());
  }
}

}  // namespace
}  // namespace stepwright::ltl
