#include "programs/ltl/formula_input.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "runtime/ground/files/files.h"
#include "runtime/ground/process/command_line.h"
#include "supervisor/ltl/syntax/formula_bytes.h"

namespace stepwright::ltl_program {

namespace {

using result::ExitCode;

constexpr std::array kBounds = {"L0012", "L0013", "L0015", "L0026", "L0031", "L0032"};

result::Result<Watched> read_automaton(const std::string& file) {
  const auto text = files::read_file(file);
  if (!text) return tl::unexpected<result::Diagnostics>(text.error());
  auto read = ltl::read_hoa(*text, file);
  if (!read) return result::forward(read);
  Watched watched;
  watched.about = file;
  watched.automaton = std::move(read->automaton);
  watched.part = read->part;
  if (!ltl::stutter(watched.automaton).invariant)
    watched.stutter = {ltl::StutterKind::Sensitive, "it tells a letter from the same letter twice"};
  return watched;
}

}  // namespace

std::string file_of(const std::string& argument) {
  return argument.ends_with(".ltl") || is_automaton(argument) ? argument : "";
}

bool decides(const ltl::Automaton& automaton, ltl::Verdict verdict) {
  return std::ranges::find(automaton.verdicts, verdict) != automaton.verdicts.end();
}

bool is_automaton(const std::string& argument) {
  return argument.ends_with(".hoa");
}

result::Result<ltl::Formula> read_formula(const std::string& argument) {
  std::string text = argument;
  if (argument.ends_with(".ltl")) {
    auto read = files::read_file(argument, ltl::kMostFormulaBytes);
    if (!read) return result::forward(read);
    text = *std::move(read);
  }
  return ltl::parse_formula(text, file_of(argument));
}

result::Result<Watched> read_watched(const std::string& argument) {
  if (is_automaton(argument)) return read_automaton(argument);
  auto formula = read_formula(argument);
  if (!formula) return result::forward(formula);
  auto monitor = ltl::monitor_automaton(*formula, {}, file_of(argument));
  if (!monitor) return result::forward(monitor);
  Watched watched;
  watched.about = ltl::to_text(formula->tree, formula->tree.root, 2'000);
  watched.automaton = std::move(monitor->automaton);
  const bool good = monitor->kind != ltl::Class::Safe && decides(watched.automaton, ltl::Verdict::True);
  watched.part = good ? ltl::HoaPart::Good : ltl::HoaPart::Bad;
  watched.stutter = ltl::stutter_report(*formula);
  watched.formula = std::move(*formula);
  return watched;
}

ExitCode fail(const result::Diagnostics& diagnostics) {
  std::fprintf(stderr, "%s\n", result::to_string(diagnostics).c_str());
  const bool bound =
      !diagnostics.empty() && std::ranges::find(kBounds, diagnostics.front().code) != kBounds.end();
  return bound ? ExitCode::BudgetExhausted : ExitCode::BadInput;
}

void print_note(const ltl::StutterReport& stutter) {
  if (stutter.kind == ltl::StutterKind::Invariant) return;
  std::fprintf(stderr, "note: X is the next change of what holds, not the next scan (%s)\n",
               stutter.reason.c_str());
}

ExitCode write(const std::string& file, const std::string& text) {
  if (file.empty()) {
    std::fwrite(text.data(), 1, text.size(), stdout);
    return ExitCode::Done;
  }
  const result::Diagnostics unwritten = files::write_file(file, text);
  return unwritten.empty() ? ExitCode::Done : fail(unwritten);
}

}  // namespace stepwright::ltl_program
