#include <gtest/gtest.h>

#include <random>

#include "supervisor/ltl/automaton/build.h"
#include "supervisor/ltl/checker/plan_checker.h"

namespace stepwright::ltl {
namespace {

bool holds(const std::string& text, const std::vector<Letter>& word) {
  const auto formula = parse_formula(text, {}, {"a", "b", "c"});
  EXPECT_TRUE(formula) << text;
  return formula && satisfies(*formula, word);
}

TEST(Satisfies, WhenAWordIsShort_ThenOperatorsAreWhatTheirDefinitionSays) {
  EXPECT_TRUE(holds("true", {0}));
  EXPECT_FALSE(holds("false", {0}));
  EXPECT_TRUE(holds("a & !b", {1}));
  EXPECT_TRUE(holds("F a", {0, 2, 1}));
  EXPECT_FALSE(holds("F a", {0, 2}));
  EXPECT_TRUE(holds("!b U a", {0, 4, 1}));
  EXPECT_FALSE(holds("!b U a", {0, 2, 1}));
  EXPECT_TRUE(holds("X b", {0, 2}));
  EXPECT_FALSE(holds("X b", {2}));
  EXPECT_FALSE(holds("X(b U a)", {1})) << "there is no next letter";
  EXPECT_TRUE(holds("F(a & F b)", {1, 0, 2}));
  EXPECT_FALSE(holds("F(a & F b)", {2, 0, 1}));
  EXPECT_TRUE(holds("a U (b | c)", {1, 4}));
}

TEST(Satisfies, WhenWordsAreRandom_ThenAutomataAcceptTheSameOnes) {
  std::mt19937 dice(3);
  int accepted = 0, refused = 0;
  for (const char* text : {"F a & F b & F c", "F(a & F(b & F c))", "!b U a", "(!a U b) | F c", "F(a & X b)",
                           "a U (b U c)", "(F a & !b U c) | F(b & c)", "X X a", "F a & (b -> F c)"}) {
    const auto formula = parse_formula(text, {}, {"a", "b", "c"});
    ASSERT_TRUE(formula);
    const auto automaton = task_automaton(*formula, {.acceptance = Acceptance::Strong});
    ASSERT_TRUE(automaton);
    for (int round = 0; round < 400; ++round) {
      std::vector<Letter> word(1 + dice() % 6);
      std::uint32_t state = automaton->initial;
      for (Letter& letter : word) state = automaton->next(state, letter = dice() % 8);
      EXPECT_EQ(satisfies(*formula, word), automaton->accepting(state)) << text;
      (automaton->accepting(state) ? accepted : refused) += 1;
    }
  }
  EXPECT_GT(accepted, 500);
  EXPECT_GT(refused, 500);
}

}  // namespace
}  // namespace stepwright::ltl
