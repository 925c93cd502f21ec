#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>

#include "supervisor/ltl/automaton/build.h"
#include "tests/unit/supervisor/ltl/paper_formulas.h"

namespace stepwright::ltl {
namespace {

Automaton task(const std::string& text, const BuildOptions& options = {}) {
  const auto formula = parse_formula(text);
  EXPECT_TRUE(formula) << text;
  auto automaton = task_automaton(*formula, options);
  EXPECT_TRUE(automaton) << result::to_string(automaton.error());
  return std::move(*automaton);
}

TEST(Task, Automaton_WhenTwoPlacesAreToBeVisited_ThenDistancesCountWhatIsLeft) {
  const Automaton automaton = task("F a & F b", {.letters = Letters::AtMostOne});
  std::uint32_t state = automaton.initial;
  EXPECT_EQ(automaton.distance[state], 2u);
  state = automaton.next(state, 0);
  EXPECT_EQ(state, automaton.initial);
  state = automaton.next(state, 1);
  EXPECT_EQ(automaton.distance[state], 1u);
  EXPECT_EQ(automaton.successors(state).size(), 2u);
  const std::uint32_t done = automaton.next(state, 2);
  EXPECT_TRUE(automaton.accepting(done));
  EXPECT_EQ(automaton.distance[done], 0u);
  EXPECT_EQ(automaton.next(done, 0), done);
  EXPECT_TRUE(automaton.rejecting(automaton.next(state, 3)));
  EXPECT_EQ(automaton.proposition("b"), 1u);
  EXPECT_EQ(automaton.proposition("c"), std::nullopt);
}

TEST(Task, Automaton_WhenAStateCannotReachTheGoal_ThenItIsRejecting) {
  const Automaton automaton = task("!b U a");
  EXPECT_EQ(automaton.size(), 3u);
  const Letter a = Letter{1} << *automaton.proposition("a"), b = Letter{1} << *automaton.proposition("b");
  const std::uint32_t wrong = automaton.next(automaton.initial, b);
  EXPECT_TRUE(automaton.rejecting(wrong));
  EXPECT_EQ(automaton.distance[wrong], Automaton::kNever);
  EXPECT_TRUE(automaton.accepting(automaton.next(automaton.initial, a | b)));
  EXPECT_EQ(automaton.successors(automaton.initial).size(), 2u);

  const Automaton never = task("F(a & !a)");
  EXPECT_EQ(never.size(), 1u);
  EXPECT_TRUE(never.rejecting(never.initial));
}

TEST(Task, Automaton_WhenNoContinuationCanFail_ThenEarlyAcceptanceKnows) {
  EXPECT_TRUE(task("X X (a | !a)").accepting(0));
  const Automaton strong = task("X X (a | !a)", {.acceptance = Acceptance::Strong});
  EXPECT_EQ(strong.size(), 4u);
  EXPECT_EQ(strong.distance[strong.initial], 3u);
}

TEST(Task, Refusal_WhenNotCoSafe_ThenThePartIsNamedWithItsPlace) {
  const auto formula = parse_formula("visit press,\n  never wash", "task.ltl");
  ASSERT_TRUE(formula);
  const auto automaton = task_automaton(*formula, {}, "task.ltl");
  ASSERT_FALSE(automaton);
  const result::Diagnostic& first = automaton.error().front();
  EXPECT_EQ(first.code, "L0011");
  EXPECT_EQ(first.where.line, 2u);
  EXPECT_EQ(first.where.column, 3u);
  EXPECT_NE(first.message.find("G !wash"), std::string::npos);
}

TEST(Task, Refusal_WhenABoundIsMet_ThenItIsNamed) {
  const auto formula = parse_formula(test::coverage(11));
  ASSERT_TRUE(formula);
  const auto automaton = task_automaton(*formula, {.most_states = 1000});
  ASSERT_FALSE(automaton);
  EXPECT_EQ(automaton.error().front().code, "L0012");
  EXPECT_NE(automaton.error().front().message.find("1000"), std::string::npos);
  const auto small = task_automaton(*formula, {.most_nodes = 500});
  ASSERT_FALSE(small);
  EXPECT_EQ(small.error().front().code, "L0013");
}

TEST(Task, Guards_WhenLettersAreManyAndFewMatter_ThenNoRowsForTheOthers) {
  std::string text = "(p0";
  for (int k = 1; k < 60; ++k) text += " | p" + std::to_string(k);
  const Automaton automaton = task("F" + text + ")");
  EXPECT_EQ(automaton.size(), 2u);
  EXPECT_EQ(automaton.guards.nodes().size(), 60u);
  EXPECT_TRUE(automaton.accepting(automaton.next(0, Letter{1} << 59)));
}

TEST(Stutter, Report_WhenXCountsLetters_ThenItSaysSo) {
  const auto kind = [](const std::string& text) { return stutter_report(*parse_formula(text)).kind; };
  EXPECT_EQ(kind("F a & (b U a)"), StutterKind::Invariant);
  EXPECT_EQ(kind("F(a & X b)"), StutterKind::Sensitive);
  EXPECT_EQ(kind("X a"), StutterKind::Sensitive);
  EXPECT_EQ(kind("G(a -> X !a)"), StutterKind::Sensitive);
  EXPECT_EQ(kind("F(a & X(!a & F b))"), StutterKind::Invariant);       // the last a counts
  EXPECT_EQ(kind("F(a & X F b) | F(a & b)"), StutterKind::Invariant);  // F(a & F b)
  EXPECT_EQ(kind("F X a | F a"), StutterKind::Invariant);
  EXPECT_EQ(kind("G F X a"), StutterKind::Unknown);
}

}  // namespace
}  // namespace stepwright::ltl
