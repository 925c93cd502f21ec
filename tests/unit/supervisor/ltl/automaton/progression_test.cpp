#include "supervisor/ltl/automaton/progression.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>
#include <vector>

#include "supervisor/ltl/automaton/build.h"
#include "tests/unit/supervisor/ltl/paper_formulas.h"

namespace stepwright::ltl {
namespace {

// Visits i, j, k, i, j in this order, by looking for each choice of i, j, k. A letter counts for several
// visits only if they are of one place, which no two neighbours of the order are.
bool visited_in_order(const std::vector<int>& places) {
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j)
      for (int k = 0; k < 8; ++k) {
        if (i == j || j == k || i == k) continue;
        const std::array<int, 5> order = {i, j, k, i, j};
        std::size_t found = 0;
        for (const int place : places)
          if (found < order.size() && place == order[found]) ++found;
        if (found == order.size()) return true;
      }
  return false;
}

TEST(Progression, State_WhenTheTableWouldHaveMillions_ThenOnlyStatesOnTheWayExist) {
  const auto formula = parse_formula(test::five_visits(8, true));
  ASSERT_TRUE(formula);
  Progression task(formula->terms, formula->root, formula->proposition_count());
  std::mt19937 random(4);
  int done = 0;
  for (int round = 0; round < 300; ++round) {
    auto state = task.start();
    std::vector<int> places;
    for (int k = 0; k < 12; ++k) {
      const int place = static_cast<int>(random() % 9) - 1;  // -1: between the places
      places.push_back(place);
      // Numbers of propositions are those of their first appearance.
      Letter letter = 0;
      for (std::size_t p = 0; p < formula->proposition_count(); ++p)
        if (formula->tree.propositions[p] == test::region(place + 1)) letter = Letter{1} << p;
      state = task.next(state, letter);
    }
    const bool expected = visited_in_order(places);
    ASSERT_EQ(Progression::verdict(state) == Verdict::True, expected);
    if (expected) ++done;
  }
  EXPECT_FALSE(task.exhausted());
  EXPECT_GT(done, 30);
  EXPECT_LT(done, 270);
}

TEST(Progression, Node_WhenTheBoundIsMet_ThenItSaysSo) {
  const auto formula = parse_formula(test::five_visits(8, true));
  Progression task(formula->terms, formula->root, formula->proposition_count(), 100);
  EXPECT_TRUE(task.exhausted());
}

TEST(Progression, Formula_WhenItHasThousandsOfOperators_ThenItIsStillFast) {
  std::string text = "F a0";
  for (int k = 1; k < 5000; ++k)
    text += " & F(a" + std::to_string(k % 60) + " & F a" + std::to_string(k * 7 % 60) + ")";
  const auto formula = parse_formula(text);
  ASSERT_TRUE(formula);
  Progression task(formula->terms, formula->root, formula->proposition_count());
  auto state = task.start();
  for (int round = 0; round < 2; ++round)
    for (std::size_t k = 0; k < 60; ++k) state = task.next(state, Letter{1} << k);
  EXPECT_FALSE(task.exhausted());
  EXPECT_EQ(Progression::verdict(state), Verdict::True);
}

// All pairs of places, each an obligation of its own.
TEST(Progression, Formula_WhenItHasThousandsOfObligations_ThenItIsStillFast) {
  constexpr std::size_t kPlaces = 60;
  std::string text = "F a0";
  for (std::size_t a = 0; a < kPlaces; ++a)
    for (std::size_t b = 0; b < kPlaces; ++b)
      if (a != b) text += " & F(a" + std::to_string(a) + " & F a" + std::to_string(b) + ")";
  const auto formula = parse_formula(text);
  ASSERT_TRUE(formula);
  Progression task(formula->terms, formula->root, formula->proposition_count());
  auto state = task.start();
  for (std::size_t k = 0; k < 2 * kPlaces - 2; ++k) {
    state = task.next(state, Letter{1} << k % kPlaces);
    ASSERT_EQ(Progression::verdict(state), Verdict::Undecided) << k;
  }
  state = task.next(state, Letter{1} << (kPlaces - 2));
  EXPECT_FALSE(task.exhausted());
  EXPECT_EQ(Progression::verdict(state), Verdict::True);
}

TEST(Progression, Table_WhenTheVisitsAreInOrder_ThenItIsRefusedAndTheStepsNeedFewNodes) {
  const auto formula = parse_formula(test::five_visits(8, true));
  const auto table = task_automaton(*formula, {.letters = Letters::AtMostOne});
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().front().code, "L0012");
  EXPECT_NE(table.error().front().hint.find("Progression"), std::string::npos);

  Progression task(formula->terms, formula->root, formula->proposition_count());
  auto state = task.start();
  for (std::size_t k = 0; Progression::verdict(state) == Verdict::Undecided; ++k)
    state = task.next(state, Letter{1} << k % 8);
  EXPECT_EQ(Progression::verdict(state), Verdict::True);
  EXPECT_LT(task.diagram().size(), 20'000u);
}

TEST(Diagram, Answer_WhenThereAreManyLevels_ThenNothingOverflows) {
  constexpr std::uint32_t kLevels = 200'000;
  Diagram diagram(2'000'000);
  Diagram::Node even = Diagram::kTrue, odd = Diagram::kTrue;
  for (std::uint32_t level = kLevels; level-- > 0;)
    (level % 2 == 0 ? even : odd) = diagram.make(level, Diagram::kFalse, level % 2 == 0 ? even : odd);
  const Diagram::Node all = diagram.both(even, odd);
  EXPECT_EQ(diagram.both(all, diagram.negation(even)), Diagram::kFalse);
  EXPECT_EQ(diagram.negation(diagram.negation(all)), all);
  EXPECT_FALSE(diagram.exhausted());
}

TEST(Progression, Formula_WhenItIsDeep_ThenNothingOverflows) {
  std::string text;
  for (int k = 0; k < 240; ++k) text += "F(a" + std::to_string(k % 30) + " & (";
  text += "a31";
  for (int k = 0; k < 240; ++k) text += "))";
  const auto formula = parse_formula(text);
  ASSERT_TRUE(formula) << result::to_string(formula.error());
  Progression task(formula->terms, formula->root, formula->proposition_count());
  EXPECT_EQ(Progression::verdict(task.next(task.start(), ~Letter{0})), Verdict::True);
}

}  // namespace
}  // namespace stepwright::ltl
