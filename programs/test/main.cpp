// stepwright test [SOURCE...] [--filter GLOB] [--engine auto|native|vm] [--max-scans N] [--json FILE]
// [--junit FILE]

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>

#include "cell/config/cell_config.h"
#include "ladder/source_files/source_options.h"
#include "programs/test/test_command.h"
#include "runtime/ground/process/command_line.h"

namespace {

constexpr const char* kCell = "cell.toml";

// Those of the cell in whose folder the command is started, in its dialect. What is wrong with its file is
// left to `check`, unless nothing of it can be read, which is given.
stepwright::result::Diagnostics take_sources_of_cell(stepwright::test_program::TestArguments& arguments) {
  if (!std::filesystem::exists(kCell)) return {};
  auto cell = stepwright::config::read_cell_config(kCell);
  if (cell.is_unread()) return cell.problems;
  const stepwright::config::BootSection& boot = cell.config.boot;
  for (const auto& each : boot.sources) arguments.sources.push_back(each.string());
  arguments.source_options.dialect = stepwright::source::find_dialect(boot.dialect);
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  using namespace stepwright;
  test_program::TestArguments arguments;
  CLI::App app("Run the TESTs of IEC 61131-3 sources in simulated time", "stepwright test");
  app.add_option(
      "sources", arguments.sources,
      "ST files (.st) with programs and tests, PLCopen projects (.xml); default: [runtime] sources of "
      "cell.toml in this folder");
  sources::add_source_options(app, arguments.source_options);
  app.add_option("--filter", arguments.filter, "run the tests whose names match, e.g. '*pump*'");
  app.add_option("--engine", arguments.engine, "engine to run them with (default auto)")
      ->check(CLI::IsMember({"auto", "native", "vm"}));
  app.add_option("--max-scans", arguments.options.max_scans,
                 "scans that one test may wait for (default 1000000)");
  app.add_option("--json", arguments.json_file, "write the report as JSON");
  app.add_option("--junit", arguments.junit_file, "write the report as JUnit XML");
  app.footer("Exit codes: 0 all tests pass, 1 a test failed or the sources are wrong, 2 usage.");
  if (const auto exit = process::parse(app, argc, argv)) return *exit;
  if (arguments.sources.empty()) {
    const auto unread = take_sources_of_cell(arguments);
    if (!unread.empty()) return process::fail(unread, result::ExitCode::BadInput);
  }
  if (arguments.sources.empty()) {
    std::fprintf(stderr,
                 "sources is required: there is no %s here that names some\n"
                 "Run with --help for more information.\n",
                 kCell);
    return to_int(result::ExitCode::Usage);
  }
  if (arguments.engine == "native") arguments.options.engine = host::EngineKind::Native;
  if (arguments.engine == "vm") arguments.options.engine = host::EngineKind::Vm;
  return result::to_int(test_program::run_tests(arguments));
}
