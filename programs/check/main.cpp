// `stepwright check [CELL.toml] [--program IMAGE.swb] [--json F]`: everything about a cell that can be
// known without running it, in one run.

#include <CLI/CLI.hpp>
#include <cstdio>

#include "cell/check/check_cell.h"
#include "cell/config/cell_options.h"
#include "runtime/ground/files/files.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/result/counted.h"

namespace stepwright::check {
namespace {

int run(const config::CellOptions& options, const std::string& image, const std::string& json) {
  const CheckReport report = check_cell(options.config, options.overrides, image);
  if (!report.problems.empty()) std::fprintf(stderr, "%s\n", result::to_string(report.problems).c_str());
  if (!report.no_plan.empty()) std::fprintf(stderr, "there is no plan: %s\n", report.no_plan.c_str());
  if (report.plan) {
    std::printf("plan: %s, cost %g; program: %zu bytes\n",
                result::counted(report.plan->actions, "action", "actions").c_str(), report.plan->cost,
                report.plan->program_bytes);
  }
  const std::size_t warnings = report.warnings();
  if (report.sound() && warnings == 0) std::printf("%s: sound\n", report.file.c_str());
  if (report.sound() && warnings != 0)
    std::printf("%s: %s\n", report.file.c_str(), result::counted(warnings, "warning", "warnings").c_str());
  if (!json.empty()) {
    const result::Diagnostics failed = files::write_file(json, to_json(report) + "\n");
    if (!failed.empty()) return process::fail(failed, result::ExitCode::BadInput);
  }
  return to_int(report.exit());
}

}  // namespace
}  // namespace stepwright::check

int main(int argc, char** argv) {
  CLI::App app{"Check a cell's configuration, planning files and program", "stepwright check"};
  stepwright::config::CellOptions options;
  std::string image;
  std::string json;
  stepwright::config::add_cell_options(app, options);
  app.get_option("--config")->required(false);
  std::string cell;
  app.add_option("CELL", cell, "the same as --config (default: cell.toml of this folder)")
      ->excludes(app.get_option("--config"));
  app.add_option(
      "--program", image,
      "check it against this program (default: the one that a start of the cell loads, or its plan's)");
  app.add_option("--json", json, "write what was found to this file");
  if (const auto exit = stepwright::process::parse(app, argc, argv)) return *exit;
  if (options.config.empty()) options.config = cell.empty() ? "cell.toml" : cell;
  return stepwright::check::run(options, image, json);
}
