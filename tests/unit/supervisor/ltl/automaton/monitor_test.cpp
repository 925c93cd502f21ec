#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "supervisor/ltl/automaton/build.h"
#include "tests/unit/supervisor/ltl/dwyer_patterns.h"

namespace stepwright::ltl {
namespace {

Monitor monitor(const std::string& text) {
  auto made = monitor_automaton(*parse_formula(text, "", {"a", "b"}));
  EXPECT_TRUE(made) << text;
  return std::move(*made);
}

Verdict after(const Monitor& watched, const std::vector<Letter>& word) {
  std::uint32_t state = watched.automaton.initial;
  for (const Letter each : word) state = watched.automaton.next(state, each);
  return watched.automaton.verdicts[state];
}

TEST(Monitor, Verdict_WhenPrefixesDecide_ThenAsSoonAsTheyDo) {
  const Monitor safe = monitor("never b before a");
  EXPECT_EQ(after(safe, {0}), Verdict::Undecided);
  EXPECT_EQ(after(safe, {0, 2}), Verdict::False);
  EXPECT_EQ(after(safe, {1}), Verdict::True);

  const Monitor mix = monitor("G a | F b");
  EXPECT_EQ(mix.kind, Class::Mix);
  EXPECT_EQ(after(mix, {1, 0}), Verdict::Undecided);
  EXPECT_EQ(after(mix, {1, 0, 2}), Verdict::True);
  EXPECT_FALSE(mix.may_never_tell);
  EXPECT_TRUE(monitor("a | X G F b").may_never_tell);

  const Monitor both = monitor("G a & F b");
  EXPECT_EQ(after(both, {3}), Verdict::Undecided);
  EXPECT_EQ(after(both, {3, 0}), Verdict::False);
}

TEST(Monitor, Verdict_WhenAFormulaIsValidOrEmptyInDisguise_ThenKnownAtOnce) {
  EXPECT_EQ(after(monitor("F a | G !a"), {}), Verdict::True);
  EXPECT_EQ(after(monitor("G F a & F G !a"), {}), Verdict::False);
  EXPECT_EQ(after(monitor("G(a -> F b) & G !b & F a"), {}), Verdict::False);
  EXPECT_EQ(monitor("G F a | F G !a").automaton.size(), 1u);
}

TEST(Monitor, Refusal_WhenNoFiniteWordDecides_ThenNotMonitorable) {
  const auto refused = monitor_automaton(*parse_formula("a & !a | G F a"));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().code, "L0014");
  EXPECT_NE(refused.error().front().message.find("G F a"), std::string::npos);
}

TEST(Monitor, Catalogue_WhenMonitored_ThenEachHasAMonitorOrAReason) {
  int monitors = 0, refused = 0;
  for (const char* text : test::kDwyerPatterns) {
    const auto formula = parse_formula(text);
    ASSERT_TRUE(formula) << text;
    const auto made = monitor_automaton(*formula);
    if (made) {
      ++monitors;
    } else {
      EXPECT_EQ(made.error().front().code, "L0014") << text << result::to_string(made.error());
      ++refused;
    }
    const bool finite =
        !formula->terms.has_until(formula->root) || !formula->terms.has_release(formula->root);
    EXPECT_TRUE(made || !finite) << text;
  }
  EXPECT_EQ(monitors, 47);
  EXPECT_EQ(refused, 8);
}

}  // namespace
}  // namespace stepwright::ltl
