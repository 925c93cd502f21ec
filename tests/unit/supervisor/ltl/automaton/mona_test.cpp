// Sizes against MONA, a program for monadic second-order logic, run as a process of its own: the formula as a
// sentence about finite words gives the minimal automaton, with two states more than ours (it reads the
// length first), and one more if it has a state for letters that are not allowed where ours is not counted.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "supervisor/ltl/automaton/build.h"
#include "tests/unit/supervisor/ltl/paper_formulas.h"

namespace stepwright::ltl {
namespace {

// M2L on strings: a variable for each operator's position.
class Sentence {
 public:
  explicit Sentence(const Formula& formula) : formula_(formula) {}

  std::string text(bool at_most_one) {
    std::string out = "m2l-str;\nvar2 ";
    for (std::size_t k = 0; k < formula_.proposition_count(); ++k)
      out += (k > 0 ? ", P" : "P") + std::to_string(k);
    out += ";\nex1 x0: (all1 y: x0 <= y) & " + holds(formula_.root, 0) + ";\n";
    if (!at_most_one) return out;
    for (std::size_t a = 0; a < formula_.proposition_count(); ++a)
      for (std::size_t b = a + 1; b < formula_.proposition_count(); ++b)
        out += "all1 y: ~(y in P" + std::to_string(a) + " & y in P" + std::to_string(b) + ");\n";
    return out;
  }

 private:
  std::string holds(Term term, int at) {
    const Terms& terms = formula_.terms;
    const std::string x = "x" + std::to_string(at), y = "x" + std::to_string(next_),
                      z = "z" + std::to_string(next_);
    const auto operands = terms.operands(term);
    switch (terms.kind(term)) {
      case TermKind::True:
        return "true";
      case TermKind::Literal:
        return x + (terms.negated(term) ? " notin P" : " in P") + std::to_string(terms.proposition(term));
      case TermKind::And:
      case TermKind::Or: {
        std::string out;
        for (const Term each : operands)
          out += (out.empty() ? "(" : terms.kind(term) == TermKind::And ? " & " : " | ") + holds(each, at);
        return out + ")";
      }
      case TermKind::Next: {
        const int next = next_++;
        return "(ex1 " + y + ": " + x + " < " + y + " & (all1 " + z + ": " + x + " < " + z + " => " + y +
               " <= " + z + ") & " + holds(operands[0], next) + ")";
      }
      case TermKind::Until: {
        const int next = next_++;
        std::string out = "(ex1 " + y + ": " + x + " <= " + y + " & " + holds(operands[1], next);
        if (operands[0] != kTrueTerm) {
          const int between = next_++;
          const std::string w = "x" + std::to_string(between);
          out += " & (all1 " + w + ": (" + x + " <= " + w + " & " + w + " < " + y + ") => " +
                 holds(operands[0], between) + ")";
        }
        return out + ")";
      }
      default:
        return "false";
    }
  }

  const Formula& formula_;
  int next_ = 1;
};

std::optional<int> states_of_mona(const std::string& sentence) {
  const auto file =
      std::filesystem::temp_directory_path() / ("stepwright_ltl_" + std::to_string(::getpid()) + ".mona");
  std::ofstream(file) << sentence;
  FILE* pipe = ::popen(("mona -s " + file.string() + " 2>&1").c_str(), "r");
  std::string output;
  std::array<char, 4096> part{};
  while (std::fgets(part.data(), part.size(), pipe) != nullptr) output += part.data();
  ::pclose(pipe);
  std::filesystem::remove(file);
  const auto at = output.find("Automaton has ");
  if (at == std::string::npos) return std::nullopt;
  return std::stoi(output.substr(at + 14));
}

bool has_mona() {
  return std::system("command -v mona >/dev/null 2>&1") == 0;
}

// Ours and MONA's, in states of ours: for all letters, and for at most one proposition at a time.
void expect_sizes_of_mona(const std::string& text) {
  const auto formula = parse_formula(text);
  ASSERT_TRUE(formula) << result::to_string(formula.error());
  const auto all = task_automaton(*formula, {.acceptance = Acceptance::Strong});
  ASSERT_TRUE(all) << result::to_string(all.error());
  const auto mona = states_of_mona(Sentence(*formula).text(false));
  ASSERT_TRUE(mona) << text;
  EXPECT_EQ(static_cast<int>(all->size()), *mona - 2) << text;
  const auto single =
      task_automaton(*formula, {.letters = Letters::AtMostOne, .acceptance = Acceptance::Strong});
  ASSERT_TRUE(single) << result::to_string(single.error());
  const auto useful =
      std::ranges::count_if(single->verdicts, [](Verdict each) { return each != Verdict::False; });
  const auto mona_single = states_of_mona(Sentence(*formula).text(true));
  ASSERT_TRUE(mona_single) << text;
  EXPECT_EQ(useful, *mona_single - 3) << text;
}

TEST(Mona, Size_WhenTasksOfThePaper_ThenEqual) {
  if (!has_mona()) GTEST_SKIP() << "mona is not installed";
  for (int n = 3; n <= 8; ++n) {
    expect_sizes_of_mona(test::in_succession(n));
    expect_sizes_of_mona(test::coverage(n));
  }
}

TEST(Mona, Size_WhenFiveVisitsAsPrinted_ThenEqual) {
  if (!has_mona()) GTEST_SKIP() << "mona is not installed";
  for (int n = 3; n <= 8; ++n) expect_sizes_of_mona(test::five_visits(n, false));
}

TEST(Mona, Size_WhenFiveVisitsInOrder_ThenEqual) {
  if (!has_mona()) GTEST_SKIP() << "mona is not installed";
  for (int n = 3; n <= 5; ++n) expect_sizes_of_mona(test::five_visits(n, true));
}

std::size_t useful_states(const std::string& text, Letters letters) {
  const auto formula = parse_formula(text);
  const auto automaton = task_automaton(*formula, {.letters = letters});
  if (!automaton) return 0;
  return static_cast<std::size_t>(
      std::ranges::count_if(automaton->verdicts, [](Verdict each) { return each != Verdict::False; }));
}

// The numbers that MONA gave, for where it is not installed or takes long.
TEST(Task, Size_WhenTasksOfThePaper_ThenAsKnown) {
  EXPECT_EQ(useful_states(test::in_succession(8), Letters::AtMostOne), 9u);
  EXPECT_EQ(useful_states(test::coverage(8), Letters::All), 256u);
  EXPECT_EQ(useful_states(test::coverage(8), Letters::AtMostOne), 256u);
  EXPECT_EQ(useful_states(test::five_visits(8, false), Letters::AtMostOne), 38u);
  EXPECT_EQ(useful_states(test::five_visits(3, true), Letters::AtMostOne), 32u);
  EXPECT_EQ(useful_states(test::five_visits(4, true), Letters::AtMostOne), 196u);
  EXPECT_EQ(useful_states(test::five_visits(5, true), Letters::AtMostOne), 1722u);
}

}  // namespace
}  // namespace stepwright::ltl
