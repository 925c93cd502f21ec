#include "supervisor/ltl/trace/judge.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/supervisor/ltl/paper_formulas.h"

namespace stepwright::ltl {
namespace {

Judgement judged(const std::string& text, const std::string& table) {
  const auto formula = parse_formula(text);
  EXPECT_TRUE(formula) << result::to_string(formula.error());
  const auto trace = read_trace(table, "run.csv", formula->tree.propositions, {});
  EXPECT_TRUE(trace) << result::to_string(trace.error());
  auto judgement = judge(*formula, *trace);
  EXPECT_TRUE(judgement) << result::to_string(judgement.error());
  return std::move(*judgement);
}

const std::string kWashing = "scan,press,wash,rack\n1,0,0,0\n2,0,0,0\n3,1,0,0\n4,0,0,0\n5,0,1,0\n6,0,0,1\n";

TEST(Judge, Verdict_WhenTheTraceDecides_ThenAtTheRowThatDoes) {
  const Judgement good = judged("press before wash, visit press then rack", kWashing);
  EXPECT_EQ(good.whole.verdict, Verdict::True);
  EXPECT_EQ(*good.whole.decided_at, 4u);
  ASSERT_EQ(good.parts.size(), 2u);
  EXPECT_EQ(*good.parts[0].judged.decided_at, 1u);

  const Judgement bad = judged("visit rack, never wash before rack", kWashing);
  EXPECT_EQ(bad.whole.verdict, Verdict::False);
  EXPECT_EQ(*bad.whole.decided_at, 1u);  // scan 5: press is not asked for
  EXPECT_EQ(bad.parts[1].judged.verdict, Verdict::False);
  EXPECT_EQ(bad.parts[1].text, "!wash W rack");
  EXPECT_EQ(bad.parts[1].at.column, 13u);
}

TEST(Judge, Verdict_WhenTheTraceDecidesNothing_ThenThePartsSayWhatIsOpen) {
  const Judgement open = judged("visit press then (press & rack), never (wash & rack)", kWashing);
  EXPECT_EQ(open.whole.verdict, Verdict::Undecided);
  EXPECT_FALSE(open.whole.decided_at);
  EXPECT_EQ(open.parts[0].kind, Class::CoSafe);
  EXPECT_EQ(open.parts[1].kind, Class::Safe);
  const Judgement sure = judged("press | !press", kWashing);
  EXPECT_EQ(sure.whole.verdict, Verdict::True);
  EXPECT_FALSE(sure.whole.decided_at);
}

TEST(Judge, Part_WhenNoFiniteRunDecidesIt_ThenItIsNotTold) {
  const Judgement mixed = judged("G F press & G !rack", kWashing);
  EXPECT_EQ(mixed.whole.verdict, Verdict::False);
  EXPECT_FALSE(mixed.parts[0].told);
  const auto formula = parse_formula("G F press");
  const auto trace = read_trace(kWashing, "run.csv", {"press"}, {});
  const auto refused = judge(*formula, *trace);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().code, "L0014");
}

// Whose automaton would have more than a million states.
TEST(Judge, Verdict_WhenTheAutomatonIsTooLarge_ThenItIsToldStepByStep) {
  const auto formula = parse_formula(test::five_visits(8, true));
  const auto run = [&](const std::string& places, const BuildOptions& options) {
    std::string table = "p1,p2,p3,p4,p5,p6,p7,p8\n";
    for (const char place : places) {
      for (char k = '1'; k <= '8'; ++k) table += std::string(k > '1' ? "," : "") + (k == place ? "1" : "0");
      table += "\n";
    }
    return judge(*formula, *read_trace(table, "run.csv", formula->tree.propositions, {}), options);
  };
  const BuildOptions few{.most_nodes = 100'000};
  const auto done = run("1230142", few);
  ASSERT_TRUE(done) << result::to_string(done.error());
  EXPECT_TRUE(done->whole.stepwise);
  EXPECT_EQ(done->whole.verdict, Verdict::True);
  EXPECT_EQ(*done->whole.decided_at, 6u);
  EXPECT_EQ(run("1230147", few)->whole.verdict, Verdict::Undecided);
  const auto refused = run("1", {.most_nodes = 100});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().code, "L0013");
}

// Scans 1 and 2 are one letter.
TEST(Judge, Next_WhenLettersRepeat_ThenItIsTheNextChange) {
  const Judgement next = judged("X press", kWashing);
  EXPECT_EQ(next.whole.verdict, Verdict::True);
  EXPECT_EQ(next.stutter.kind, StutterKind::Sensitive);
  EXPECT_EQ(judged("F press", kWashing).stutter.kind, StutterKind::Invariant);
}

}  // namespace
}  // namespace stepwright::ltl
