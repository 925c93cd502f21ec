#include "tests/bench/ltl/automata_sizes.h"

#include <algorithm>
#include <string>

#include "supervisor/ltl/automaton/build.h"
#include "tests/unit/supervisor/ltl/paper_formulas.h"

namespace stepwright::bench {

namespace {

// Nothing where there is no automaton.
std::size_t useful_states(const std::string& text) {
  const auto formula = ltl::parse_formula(text);
  if (!formula) return 0;
  const auto automaton = ltl::task_automaton(
      *formula, {.letters = ltl::Letters::AtMostOne, .acceptance = ltl::Acceptance::Strong});
  if (!automaton) return 0;
  return static_cast<std::size_t>(std::ranges::count_if(
      automaton->verdicts, [](ltl::Verdict each) { return each != ltl::Verdict::False; }));
}

}  // namespace

AutomataSizes automata_sizes() {
  AutomataSizes sizes;
  const auto compare = [&](const std::string& text, std::size_t known) {
    ++sizes.compared;
    if (useful_states(text) != known) ++sizes.mismatches;
  };
  for (int n = 3; n <= 8; ++n) {
    const auto places = static_cast<std::size_t>(n);
    compare(ltl::test::in_succession(n), places + 1);
    compare(ltl::test::five_visits(n, false), 2 + places + places * (places - 1) / 2);
    compare(ltl::test::coverage(n), std::size_t{1} << places);
  }
  compare(ltl::test::five_visits(3, true), 32);
  compare(ltl::test::five_visits(4, true), 196);
  compare(ltl::test::five_visits(5, true), 1722);
  return sizes;
}

}  // namespace stepwright::bench
