// stepwright translate PLAN --binding B.toml [--domain D --problem P] [--to sfc|ladder|plcopen|omron]
//                      [--handshake TABLE.json] [--sequential] [--svg] [--lowered] [-o FILE]

#include <CLI/CLI.hpp>
#include <iostream>
#include <string>

#include "programs/translate/translate_command.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/result/exit_code.h"

namespace {

using stepwright::result::ExitCode;
using stepwright::result::to_int;
namespace process = stepwright::process;
namespace command = stepwright::translate_command;

int run(const command::Arguments& arguments) {
  const auto output = command::translate_files(arguments);
  if (!output) return process::fail(output.error(), ExitCode::BadInput);
  if (!arguments.handshake.empty()) {
    const auto table = command::write_document(arguments.handshake, output->table);
    if (!table) return process::fail(table.error(), ExitCode::BadInput);
  }
  if (arguments.output.empty()) {
    std::cout << output->document;
    std::cerr << output->summary;
    return to_int(ExitCode::Done);
  }
  const auto written = command::write_document(arguments.output, output->document);
  if (!written) return process::fail(written.error(), ExitCode::BadInput);
  std::cout << output->summary << "written: " << arguments.output.string() << "\n";
  return to_int(ExitCode::Done);
}

}  // namespace

int main(int argc, char** argv) {
  command::Arguments arguments;
  CLI::App app("Turn a PDDL plan into a sequential function chart, or what follows from it.",
               "stepwright translate");
  app.add_option("plan", arguments.plan, "plan file, one action a line")->required();
  app.add_option("--binding", arguments.binding, "the cell's binding (TOML)")->required();
  app.add_option("--domain", arguments.domain, "PDDL domain (default: domain.pddl beside the binding)");
  app.add_option("--problem", arguments.problem, "PDDL problem (default: problem.pddl beside the binding)");
  app.add_option("--to", arguments.to, "what to write: sfc, ladder, plcopen, omron")
      ->check(CLI::IsMember({"sfc", "ladder", "plcopen", "omron"}));
  app.add_flag("--sequential", arguments.sequential, "one action after the other, as in the paper");
  app.add_option(
      "--handshake", arguments.handshake,
      "the program waits for the grant of every action over Modbus; writes the actions to this file");
  app.add_flag("--svg", arguments.svg, "draw sfc or ladder as SVG (also if FILE ends in .svg)");
  app.add_flag("--lowered", arguments.lowered, "plcopen: write the ladder diagram instead of the chart");
  app.add_option("-o,--output", arguments.output, "file to write (default: standard output)");
  if (const auto exit = process::parse(app, argc, argv)) return *exit;
  return run(arguments);
}
