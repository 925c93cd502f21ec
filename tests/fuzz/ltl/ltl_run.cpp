#include "tests/fuzz/ltl/ltl_run.h"

#include <algorithm>

#include "supervisor/ltl/automaton/build.h"
#include "supervisor/ltl/automaton/progression.h"
#include "supervisor/ltl/hoa/hoa.h"

namespace stepwright::fuzz::ltl {

namespace {

using namespace stepwright::ltl;

constexpr const char* kFile = "input";
constexpr BuildOptions kBounds{.most_states = 300, .most_nodes = 20'000};

// A refusal has a code, a place in the text and a hint.
std::string fault_of(const result::Diagnostics& diagnostics, std::string_view input) {
  if (diagnostics.empty()) return "a refusal without a reason";
  const auto lines = static_cast<std::size_t>(std::ranges::count(input, '\n')) + 1;
  for (const result::Diagnostic& each : diagnostics) {
    if (!each.code.starts_with("L00") || each.message.empty() || each.hint.empty() ||
        each.where.file != kFile)
      return "a diagnostic is not whole: " + result::to_string(diagnostics);
    if (each.where.line == 0 || each.where.line > lines || each.where.column == 0)
      return "a place outside of the text: " + result::to_string(diagnostics);
  }
  return {};
}

bool bound(const result::Diagnostics& diagnostics) {
  const std::string& code = diagnostics.front().code;
  return code == "L0004" || code == "L0005" || code == "L0026";
}

void judge_written(Run& done, const Automaton& automaton, HoaPart part) {
  const auto text = write_hoa(automaton, part, "written", 2'000);
  if (!text) return;
  const auto again = read_hoa(*text, "written");
  if (!again) {
    done.finding =
        "an automaton that was written is refused: " + result::to_string(again.error()) + "\n" + *text;
    return;
  }
  const auto twice = write_hoa(again->automaton, again->part, "written");
  const auto last = twice ? read_hoa(*twice, "written") : again;
  if (!last || last->automaton != again->automaton) done.finding = "read as another automaton: " + *text;
}

// Some letters, in an order that depends on nothing but k.
void judge_steps(Run& done, const Formula& formula, const Automaton& automaton) {
  Progression progression(formula.terms, formula.root, formula.proposition_count(), kBounds.most_nodes);
  auto state = progression.start();
  std::uint32_t at = automaton.initial;
  for (std::uint64_t k = 1; k <= 20; ++k) {
    const Letter letter = (k * 0x9E3779B97F4A7C15u) >> (k % 40);
    state = progression.next(state, letter);
    at = automaton.next(at, letter);
    if (progression.exhausted()) return;
    const Verdict told = Progression::verdict(state);
    if (told != Verdict::Undecided && told != automaton.verdicts[at]) {
      done.finding = "automaton and progression differ: " + to_text(formula.tree, formula.tree.root);
      return;
    }
  }
}

void judge_formula(Run& done, std::string_view input) {
  const auto formula = parse_formula(input, kFile);
  if (!formula) {
    done.finding = fault_of(formula.error(), input);
    return;
  }
  done.read = true;
  const std::string text = to_text(formula->tree, formula->tree.root);
  const auto again = parse_formula(text, "written");
  if (!again && !bound(again.error())) {
    done.finding = "a formula that was written is refused: " + result::to_string(again.error()) + "\n" + text;
  } else if (again && to_text(again->tree, again->tree.root) != text) {
    done.finding = "a formula that was written is another one: " + text;
  }
  if (!done.finding.empty()) return;
  const auto monitor = monitor_automaton(*formula, kBounds, kFile);
  if (!monitor) {
    done.finding = fault_of(monitor.error(), input);
    return;
  }
  done.automaton = true;
  judge_steps(done, *formula, monitor->automaton);
  if (!done.finding.empty()) return;
  judge_written(done, monitor->automaton, monitor->kind == Class::CoSafe ? HoaPart::Good : HoaPart::Bad);
}

}  // namespace

Run run(std::string_view input) {
  Run done;
  if (!input.starts_with("HOA")) {
    judge_formula(done, input);
    return done;
  }
  const auto read = read_hoa(input, kFile, {.states = 2'000, .nodes = 100'000});
  if (!read) {
    done.finding = fault_of(read.error(), input);
    return done;
  }
  done.read = done.automaton = true;
  judge_written(done, read->automaton, read->part);
  return done;
}

}  // namespace stepwright::fuzz::ltl
