// Random formulas and words against the definition of the semantics. STEPWRIGHT_LTL_FORMULAS sets how many
// formulas.

#include <gtest/gtest.h>

#include <cstdlib>

#include "supervisor/ltl/automaton/build.h"
#include "supervisor/ltl/automaton/progression.h"
#include "tests/unit/supervisor/ltl/automaton/direct_semantics.h"

namespace stepwright::ltl {
namespace {

using Word = std::vector<std::uint64_t>;

int formulas(int by_default) {
  const char* wanted = std::getenv("STEPWRIGHT_LTL_FORMULAS");
  return wanted != nullptr ? std::atoi(wanted) : by_default;
}

test::Direct random_formula(std::mt19937& random, int operators, bool cosafe, int propositions) {
  test::Direct direct;
  direct.propositions = propositions;
  test::add_random(direct, random, operators, cosafe);
  return direct;
}

Word random_word(std::mt19937& random, std::size_t most, std::uint64_t letters) {
  Word word(random() % (most + 1));
  for (std::uint64_t& each : word) each = random() % letters;
  return word;
}

Verdict after(const Automaton& automaton, const Word& word) {
  std::uint32_t state = automaton.initial;
  for (const std::uint64_t letter : word) state = automaton.next(state, letter);
  return automaton.verdicts[state];
}

// 100,000 pairs of a formula and a word.
TEST(Random, Task_WhenStrong_ThenTrueExactlyForWordsThatSatisfyIt) {
  std::mt19937 random(20121);
  int yes = 0, no = 0;
  for (int round = 0; round < formulas(10'000); ++round) {
    const int propositions = 2 + round % 3;
    const test::Direct direct =
        random_formula(random, 1 + static_cast<int>(random() % 8), true, propositions);
    std::vector<std::string> names = {"a", "b", "c", "d"};
    names.resize(static_cast<std::size_t>(propositions));
    const auto formula = parse_formula(direct.text(), "", names);
    ASSERT_TRUE(formula) << direct.text();
    const auto automaton = task_automaton(*formula, {.acceptance = Acceptance::Strong});
    ASSERT_TRUE(automaton) << direct.text();
    Progression progression(formula->terms, formula->root, formula->proposition_count());
    for (int k = 0; k < 10; ++k) {
      const Word word = random_word(random, 6, std::uint64_t{1} << propositions);
      bool satisfied = false;  // for good once it is
      auto state = progression.start();
      std::uint32_t at = automaton->initial;
      for (std::size_t end = 1; end <= word.size(); ++end) {
        satisfied = direct.strongly(Word(word.begin(), word.begin() + static_cast<std::ptrdiff_t>(end)));
        state = progression.next(state, word[end - 1]);
        at = automaton->next(at, word[end - 1]);
        ASSERT_EQ(automaton->accepting(at), satisfied) << direct.text();
        ASSERT_EQ(Progression::verdict(state) == Verdict::True, satisfied) << direct.text();
        if (Progression::verdict(state) == Verdict::False) {
          ASSERT_TRUE(automaton->rejecting(at)) << direct.text();
        }
      }
      ++(satisfied ? yes : no);
    }
  }
  EXPECT_GT(yes, no / 20);
  EXPECT_GT(no, yes / 20);
}

// All words that end in a loop, up to a length, that begin with a prefix: whether some satisfy and some
// violate.
struct Ends {
  bool satisfied = false, violated = false;
};

void look(const test::Direct& direct, const Word& prefix, std::size_t length, Ends& ends) {
  for (std::uint64_t code = 0; code < std::uint64_t{1} << (2 * length); ++code) {
    Word word;
    for (std::size_t k = 0; k < length; ++k) word.push_back(code >> (2 * k) & 3);
    for (std::size_t loop = 1; loop <= length; ++loop) {
      bool begins = true;
      for (std::size_t k = 0, at = 0; k < prefix.size() && begins;
           ++k, at = at + 1 < length ? at + 1 : length - loop)
        begins = prefix[k] == word[at];
      if (!begins) continue;
      (direct.holds_for_ever(word, loop) ? ends.satisfied : ends.violated) = true;
      if (ends.satisfied && ends.violated) return;
    }
  }
}

Verdict by_force(const test::Direct& direct, const Word& prefix) {
  Ends ends;
  for (std::size_t length = 1; length <= 5; ++length) {
    look(direct, prefix, length, ends);
    if (ends.satisfied && ends.violated) return Verdict::Undecided;
  }
  return ends.satisfied ? Verdict::True : Verdict::False;
}

TEST(Random, Monitor_WhenAnyFormula_ThenVerdictsAreThoseOfAllContinuations) {
  std::mt19937 random(20112);
  int decided = 0, refused = 0;
  for (int round = 0; round < formulas(1500); ++round) {
    const test::Direct direct = random_formula(random, 1 + static_cast<int>(random() % 4), false, 2);
    const auto formula = parse_formula(direct.text(), "", {"a", "b"});
    ASSERT_TRUE(formula) << direct.text();
    const auto monitor = monitor_automaton(*formula);
    const Word word = random_word(random, 3, 4);
    const Verdict expected = by_force(direct, word);
    if (!monitor) {
      ASSERT_EQ(monitor.error().front().code, "L0014") << result::to_string(monitor.error());
      ASSERT_EQ(expected, Verdict::Undecided) << direct.text();
      ++refused;
      continue;
    }
    ASSERT_EQ(after(monitor->automaton, word), expected) << direct.text() << " after " << word.size();
    if (expected != Verdict::Undecided) ++decided;
    if (!formula->terms.has_release(formula->root)) {
      const auto task = task_automaton(*formula);
      ASSERT_TRUE(task);
      ASSERT_EQ(*task, monitor->automaton) << direct.text();
    }
  }
  EXPECT_GT(decided, formulas(1500) / 5);
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace stepwright::ltl
