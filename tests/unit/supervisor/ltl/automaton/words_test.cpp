#include "supervisor/ltl/automaton/words.h"

#include <gtest/gtest.h>

#include "supervisor/ltl/automaton/build.h"
#include "supervisor/ltl/syntax/formula.h"

namespace stepwright::ltl {
namespace {

TEST(ShortestWord, WhenAStateCanBeReached_ThenTheWordLeadsThere) {
  for (const char* text : {"F(a & F(b & F c))", "!c U a, visit b", "visit a then b, visit d, c before d"}) {
    const auto formula = parse_formula(text);
    ASSERT_TRUE(formula) << text;
    const auto monitor = monitor_automaton(*formula);
    ASSERT_TRUE(monitor) << text;
    const Automaton& automaton = monitor->automaton;
    for (std::uint32_t state = 0; state < automaton.size(); ++state) {
      const auto word = shortest_word(automaton, automaton.initial, state);
      ASSERT_TRUE(word) << text << ", state " << state;
      EXPECT_LE(word->size(), automaton.size());
      std::uint32_t at = automaton.initial;
      for (const Letter letter : *word) at = automaton.next(at, letter);
      EXPECT_EQ(at, state) << text;
    }
  }
}

TEST(ShortestWord, WhenNoWordLeadsThere_ThenThereIsNone) {
  const auto formula = parse_formula("F a");
  const auto monitor = monitor_automaton(*formula);
  ASSERT_TRUE(monitor);
  const Automaton& automaton = monitor->automaton;
  const std::uint32_t done = automaton.next(automaton.initial, 1);
  EXPECT_FALSE(shortest_word(automaton, done, automaton.initial));
  EXPECT_EQ(shortest_word(automaton, done, done), std::vector<Letter>());
}

}  // namespace
}  // namespace stepwright::ltl
