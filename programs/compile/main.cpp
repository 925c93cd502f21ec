// The process behind `stepwright compile` and `stepwright explain`.

#include <CLI/CLI.hpp>

#include "ladder/source_files/source_options.h"
#include "programs/compile/compile_command.h"
#include "programs/compile/explain_command.h"
#include "runtime/ground/process/command_line.h"

namespace {

using namespace stepwright;

void describe_compile(CLI::App& app, compile_program::CompileArguments& arguments) {
  app.add_option("sources", arguments.sources, "ST files (.st) and PLCopen projects (.xml)")->required();
  CLI::Option_group* result = app.add_option_group("result");
  result->add_option("-o,--output", arguments.image, "image file to write (.swb)");
  result->add_flag("--check", arguments.check,
                   "write no image: the sources may be a library without a PROGRAM");
  result->require_option(1);
  sources::add_source_options(app, arguments.options);
  app.add_option("--config", arguments.cell, "the cell (cell.toml) whose [[monitors]] the image shall have")
      ->check(CLI::ExistingFile);
  app.add_option("--json", arguments.json_file, "file for the report, - for standard output");
  app.add_flag("--bare", arguments.bare,
               "leave out the sources, which the page in the browser shows: smaller");
  app.add_option("-W", arguments.warnings,
                 "warnings: none, default, all; error (-Werror) makes them errors. May be repeated")
      ->check(CLI::IsMember({"none", "default", "all", "error"}))
      ->allow_extra_args(false);
  app.footer(
      "Exit codes: 0 the image is written, 1 the sources are wrong (stderr says where), 2 usage.\n"
      "A warning is switched off for a line by {no_warning W0003} on it or on the line before.");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Compiles IEC 61131-3 sources and explains what the compiler says", "stepwright");
  app.require_subcommand(1);
  compile_program::CompileArguments arguments;
  std::string code;
  CLI::App* compile = app.add_subcommand("compile", "compile sources to a bytecode image");
  CLI::App* explain = app.add_subcommand("explain", "describe a diagnostic code, or list all");
  describe_compile(*compile, arguments);
  explain->add_option("code", code, "for example E0301");
  if (const auto exit = process::parse(app, argc, argv)) return *exit;
  return result::to_int(compile->parsed() ? compile_program::run_compile(arguments)
                                          : compile_program::run_explain(code));
}
