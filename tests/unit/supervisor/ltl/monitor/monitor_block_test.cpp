#include "supervisor/ltl/monitor/monitor_block.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "supervisor/ltl/automaton/build.h"
#include "tests/st/compiled_text.h"
#include "tests/st/machine.h"
#include "tests/unit/supervisor/ltl/paper_formulas.h"

namespace stepwright::ltl {
namespace {

using ::testing::HasSubstr;

std::vector<std::string> inputs_of(const Automaton& automaton) {
  std::vector<std::string> inputs;
  for (std::size_t k = 0; k < automaton.propositions.size(); ++k) inputs.push_back("in" + std::to_string(k));
  return inputs;
}

Automaton watched(const std::string& text) {
  const auto formula = parse_formula(text);
  EXPECT_TRUE(formula) << result::to_string(formula.error());
  auto monitor = monitor_automaton(*formula);
  EXPECT_TRUE(monitor) << result::to_string(monitor.error());
  return std::move(monitor->automaton);
}

std::string block_of(const Automaton& automaton, BlockForm form, bool on_changes = false) {
  BlockOptions options;
  options.name = "WATCH";
  options.inputs = inputs_of(automaton);
  options.about = "x (* y *)";
  options.form = form;
  options.on_changes = on_changes;
  const auto text = monitor_block(automaton, options);
  EXPECT_TRUE(text) << result::to_string(text.error());
  return *text;
}

// A program that hands the bits of `letter` to the block.
std::string program_of(const std::string& block, const Automaton& automaton) {
  std::string text = block + "PROGRAM main\nVAR letter : LWORD; begin : BOOL; m : WATCH; END_VAR\nm(";
  for (std::size_t k = 0; k < automaton.propositions.size(); ++k)
    text += "in" + std::to_string(k) + " := letter.%X" + std::to_string(k) + ", ";
  return text + "Reset := begin);\nEND_PROGRAM\n";
}

struct Count {
  int decided = 0, entered = 0;
};

// Random letters, biased so that all of the automaton is met; begun anew a few scans behind each verdict.
Count expect_same(const Automaton& automaton, BlockForm form, int letters, bool on_changes = false) {
  const auto program = st_test::compiled(program_of(block_of(automaton, form, on_changes), automaton));
  Count count;
  for (const st_test::EngineKind engine : st_test::engines()) {
    st_test::Machine machine(program, engine);
    std::mt19937_64 random(31);
    const std::uint64_t all = (std::uint64_t{1} << automaton.propositions.size()) - 1;
    std::uint32_t state = automaton.initial, since = 0;
    std::uint64_t last = 0;
    bool begun = false;
    int left = 0;  // scans until it begins anew, once it is decided
    for (int k = 0; k < letters; ++k) {
      const std::uint64_t bit = automaton.propositions.empty() ? 0 : random() % automaton.propositions.size();
      std::uint64_t letter = random() % 4 == 0 ? random() & random() & all : (std::uint64_t{1} << bit);
      if (random() % 3 == 0) letter = random() % 2 == 0 ? 0 : last;
      const bool anew = left > 0 && --left == 0;
      const std::uint32_t before = anew ? automaton.initial : state;
      if (anew) {
        state = automaton.initial;
        since = 0;
        begun = false;
      } else {
        if (!on_changes || !begun || letter != last) state = automaton.next(state, letter);
        since = state == before ? since + 1 : 0;
        begun = true;
        last = letter;
      }
      machine.set("main.letter", std::to_string(letter));
      machine.set("main.begin", anew ? "TRUE" : "FALSE");
      EXPECT_EQ(machine.scan().state, scan::ScanState::Running);
      const Verdict verdict = automaton.verdicts[state];
      const bool same = machine.equals("main.m.State", std::to_string(state)) &&
                        machine.equals("main.m.Verdict", std::to_string(static_cast<int>(verdict))) &&
                        machine.equals("main.m.Since", std::to_string(since));
      EXPECT_TRUE(same) << st_test::name_of(engine) << " scan " << k << ": " << machine.shown("main.m.State")
                        << " for " << state << ", verdict " << machine.shown("main.m.Verdict") << ", since "
                        << machine.shown("main.m.Since") << " for " << since;
      if (!same) return count;
      if (since == 0) ++count.entered;
      if (verdict != Verdict::Undecided && left == 0 && !anew) {
        ++count.decided;
        left = 1 + static_cast<int>(random() % 3);
      }
    }
  }
  return count;
}

TEST(MonitorBlock, Verdict_WhenInSuccession_ThenThatOfTheAutomatonInBothEngines) {
  const Automaton automaton = watched(test::in_succession(8));
  const Count count = expect_same(automaton, BlockForm::Table, 12'000);
  EXPECT_GT(count.decided, 500);
  expect_same(automaton, BlockForm::Branches, 12'000);
}

TEST(MonitorBlock, Verdict_WhenEveryPlaceIsVisited_ThenThatOfTheAutomatonInBothEngines) {
  const Automaton automaton = watched(test::coverage(8));
  ASSERT_EQ(automaton.size(), 256u);
  const Count count = expect_same(automaton, BlockForm::Table, 12'000);
  EXPECT_GT(count.decided, 300);
  EXPECT_GT(count.entered, 2'000);
  expect_same(automaton, BlockForm::Branches, 12'000);
}

TEST(MonitorBlock, Verdict_WhenTableOrBranches_ThenTheSame) {
  for (const char* text : {"never b before a", "(F a & G b) | G !c", "between q and r: absent p",
                           "s precedes p", "visit a then (visit b and visit c), never d", "G a & F b",
                           "after q until r: holds p", "true", "a & !a"}) {
    SCOPED_TRACE(text);
    const Automaton automaton = watched(text);
    for (const BlockForm form : {BlockForm::Table, BlockForm::Branches})
      EXPECT_GT(expect_same(automaton, form, 3'000).entered, 0);
  }
}

TEST(MonitorBlock, Letter_WhenXCountsLetters_ThenItIsReadOnceForEachChange) {
  const Automaton automaton = watched("G(a -> X X !a) & G(b -> X c)");
  for (const BlockForm form : {BlockForm::Table, BlockForm::Branches}) {
    EXPECT_GT(expect_same(automaton, form, 10'000, true).decided, 500);
    EXPECT_THAT(block_of(automaton, form, true), HasSubstr("X counts letters"));
  }
}

TEST(MonitorBlock, Table_WhenPropositionsAreMany_ThenRowsAreSharedAndNoneIsForALetter) {
  EXPECT_THAT(block_of(watched("never b before a"), BlockForm::Automatic),
              HasSubstr("Next : ARRAY[0..11] OF UINT"));
  // 256 states, and as many rows behind the first four propositions; 256 * 256 letters.
  const std::string text = block_of(watched(test::coverage(8)), BlockForm::Automatic);
  EXPECT_THAT(text, HasSubstr("Next : ARRAY[0..8191] OF UINT"));
  EXPECT_THAT(text, HasSubstr("(* x ( * y * ) *)"));
  std::string many = "G(p0";
  for (int k = 1; k < 60; ++k) many += " & p" + std::to_string(k);
  const Automaton automaton = watched(many + ")");
  EXPECT_THAT(block_of(automaton, BlockForm::Automatic), HasSubstr("ARRAY[0..479] OF UINT"));
  EXPECT_GT(expect_same(automaton, BlockForm::Automatic, 1'000).decided, 100);
  EXPECT_GT(expect_same(automaton, BlockForm::Branches, 1'000).decided, 100);
}

TEST(MonitorBlock, Branches_WhenFewStates_ThenTheyReadAsTheRuleDoes) {
  const std::string text = block_of(watched("a before b"), BlockForm::Branches);
  EXPECT_THAT(text, HasSubstr("Before := State;\n"
                              "CASE State OF\n"
                              "  0:\n"
                              "    IF in0 THEN\n"
                              "      State := 2;\n"
                              "    ELSIF in1 THEN\n"
                              "      State := 1;\n"
                              "    END_IF;\n"
                              "END_CASE;\n"))
      << text;
}

TEST(MonitorBlock, Refusal_WhenTooLarge_ThenTheBoundIsNamed) {
  const Automaton automaton = watched(test::coverage(8));
  BlockOptions options{.inputs = inputs_of(automaton), .form = BlockForm::Table, .most_entries = 8'000};
  const auto table = monitor_block(automaton, options);
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().front().code, "L0031");
  options.form = BlockForm::Branches;
  options.most_branches = 6'000;  // 3^8 are needed
  const auto branches = monitor_block(automaton, options);
  ASSERT_FALSE(branches);
  EXPECT_THAT(branches.error().front().message, HasSubstr("6000"));
}

}  // namespace
}  // namespace stepwright::ltl
