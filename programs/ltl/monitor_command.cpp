#include "programs/ltl/monitor_command.h"

#include "ladder/graphic/identifier.h"

namespace stepwright::ltl_program {

using result::ExitCode;

result::Result<std::string> block_text(const Watched& watched, const MonitorArguments& arguments) {
  if (!graphic::is_identifier(arguments.name) || graphic::is_keyword(arguments.name)) {
    return result::fail("L0033", {}, "'" + arguments.name + "' is no name of a function block",
                        "letters, digits and single underscores, and no word of the language");
  }
  graphic::NameSet names;
  names.insert(arguments.name);
  for (const std::string_view each : ltl::block_names()) names.insert(each);
  ltl::BlockOptions options;
  options.name = arguments.name;
  for (const std::string& each : watched.automaton.propositions)
    options.inputs.push_back(names.unique(graphic::is_keyword(each) ? each + "_in" : each));
  options.about = watched.about;
  options.form = arguments.form;
  options.formula = watched.formula ? &watched.formula->tree : nullptr;
  options.on_changes = watched.stutter.kind != ltl::StutterKind::Invariant;
  return ltl::monitor_block(watched.automaton, options);
}

ExitCode run_monitor(const MonitorArguments& arguments) {
  const auto watched = read_watched(arguments.formula);
  if (!watched) return fail(watched.error());
  const auto text = block_text(*watched, arguments);
  if (!text) return fail(text.error());
  print_note(watched->stutter);
  return write(arguments.out_file, *text);
}

}  // namespace stepwright::ltl_program
