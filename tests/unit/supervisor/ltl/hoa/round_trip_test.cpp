#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "supervisor/ltl/automaton/build.h"
#include "supervisor/ltl/hoa/hoa.h"
#include "tests/unit/supervisor/ltl/dwyer_patterns.h"
#include "tests/unit/supervisor/ltl/paper_formulas.h"

namespace stepwright::ltl {
namespace {

bool decides(const Automaton& automaton, Verdict verdict) {
  return std::ranges::find(automaton.verdicts, verdict) != automaton.verdicts.end();
}

void expect_round_trip(const Automaton& automaton, HoaPart part) {
  const auto written = write_hoa(automaton, part, "round trip");
  ASSERT_TRUE(written);
  const auto read = read_hoa(*written, "round_trip.hoa");
  ASSERT_TRUE(read) << *written << result::to_string(read.error());
  EXPECT_EQ(read->part, part);
  const auto again = write_hoa(read->automaton, part, "round trip");
  const auto twice = read_hoa(*again);
  ASSERT_TRUE(twice);
  EXPECT_EQ(twice->automaton, read->automaton);
  // Word for word as the automaton that was written: both read together, pair by pair.
  const Verdict told = part == HoaPart::Good ? Verdict::True : Verdict::False;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs = {{automaton.initial, read->automaton.initial}};
  const Letter letters = Letter{1} << automaton.propositions.size();
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [ours, theirs] = pairs[k];
    ASSERT_EQ(automaton.verdicts[ours] == told, read->automaton.verdicts[theirs] == told) << *written;
    for (Letter letter = 0; letter < letters; ++letter) {
      const std::pair next{automaton.next(ours, letter), read->automaton.next(theirs, letter)};
      if (std::ranges::find(pairs, next) == pairs.end()) pairs.push_back(next);
    }
  }
}

TEST(RoundTrip, Catalogue_WhenWrittenAndRead_ThenTheLanguageIsTheSame) {
  int trips = 0;
  for (const char* text : test::kDwyerPatterns) {
    const auto formula = parse_formula(text);
    ASSERT_TRUE(formula) << text;
    const auto monitor = monitor_automaton(*formula);
    if (!monitor) continue;
    for (const HoaPart part : {HoaPart::Good, HoaPart::Bad}) {
      if (!decides(monitor->automaton, part == HoaPart::Good ? Verdict::True : Verdict::False)) continue;
      expect_round_trip(monitor->automaton, part);
      ++trips;
    }
    const bool exact = monitor->kind == Class::CoSafe || monitor->kind == Class::Safe;
    if (!exact) continue;
    const HoaPart part = monitor->kind == Class::CoSafe ? HoaPart::Good : HoaPart::Bad;
    EXPECT_EQ(read_hoa(*write_hoa(monitor->automaton, part, text))->automaton, monitor->automaton) << text;
  }
  EXPECT_GE(trips, 45);
}

TEST(RoundTrip, Task_WhenOfThePaper_ThenTheAutomatonIsTheSame) {
  for (const std::string& text : {test::in_succession(6), test::coverage(6), test::five_visits(4, false)}) {
    const auto automaton = task_automaton(*parse_formula(text));
    ASSERT_TRUE(automaton);
    const auto read = read_hoa(*write_hoa(*automaton, HoaPart::Good, "task"));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->automaton, *automaton);
  }
}

TEST(RoundTrip, Labels_WhenTooMany_ThenTheBoundIsNamed) {
  const auto automaton = task_automaton(*parse_formula(test::coverage(6)));
  const auto written = write_hoa(*automaton, HoaPart::Good, "task", 10);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().front().code, "L0026");
}

}  // namespace
}  // namespace stepwright::ltl
