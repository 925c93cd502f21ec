#include "programs/ltl/automaton_command.h"

#include <cstdio>

#include "programs/ltl/monitor_command.h"
#include "supervisor/ltl/drawing/automaton_svg.h"

namespace stepwright::ltl_program {

namespace {

using result::ExitCode;

result::Result<std::string> document(const Watched& watched, const AutomatonArguments& arguments) {
  if (arguments.to == "svg") return ltl::automaton_svg(watched.automaton);
  if (arguments.to == "st") return block_text(watched, {});
  return ltl::write_hoa(watched.automaton, arguments.part.value_or(watched.part), watched.about);
}

// What a document of one part leaves out.
void print_left_out(const Watched& watched, const AutomatonArguments& arguments) {
  if (arguments.to != "hoa" || !watched.formula) return;
  const ltl::HoaPart part = arguments.part.value_or(watched.part);
  const bool good = part == ltl::HoaPart::Good;
  const ltl::Class kind = ltl::classify(watched.formula->terms, watched.formula->root);
  if (kind == (good ? ltl::Class::CoSafe : ltl::Class::Safe)) return;
  std::fprintf(stderr, "note: this automaton tells %s prefixes only, not all of the formula%s\n",
               good ? "good" : "bad",
               decides(watched.automaton, good ? ltl::Verdict::False : ltl::Verdict::True)
                   ? good ? "; --part bad tells the others" : "; --part good tells the others"
                   : "");
}

}  // namespace

ExitCode run_automaton(const AutomatonArguments& arguments) {
  const auto watched = read_watched(arguments.formula);
  if (!watched) return fail(watched.error());
  const auto text = document(*watched, arguments);
  if (!text) return fail(text.error());
  print_note(watched->stutter);
  print_left_out(*watched, arguments);
  const ExitCode written = write(arguments.out_file, *text);
  if (written != ExitCode::Done || arguments.out_file.empty()) return written;
  std::printf("%zu states, %zu propositions\n", watched->automaton.size(),
              watched->automaton.propositions.size());
  return ExitCode::Done;
}

}  // namespace stepwright::ltl_program
