// stepwright exec IMAGE.swb [--scans N] [--engine vm|native] [--trace VARS] [--csv FILE] [--json FILE]

#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/exec/exec_run.h"
#include "runtime/ground/files/files.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/result/exit_code.h"
#include "runtime/trace/csv_trace.h"
#include "runtime/trace/names.h"
#include "runtime/trace/value_json.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace {

using stepwright::result::ExitCode;
namespace exec = stepwright::exec;
namespace files = stepwright::files;
namespace process = stepwright::process;
namespace reader = stepwright::reader;
namespace result = stepwright::result;
namespace trace = stepwright::trace;
using trace::hex;
using trace::to_json;

struct Arguments {
  std::string image;
  std::string engine = "vm";
  std::string json_file;
  std::string csv_file;
  std::string trace;
  exec::ExecOptions options;
};

nlohmann::json to_json(const exec::ExecReport& report, const std::string& engine) {
  nlohmann::json traced = nlohmann::json::object();
  for (const auto& [name, values] : report.trace) {
    nlohmann::json list = nlohmann::json::array();
    for (const reader::Value& value : values) list.push_back(to_json(value));
    traced[name] = std::move(list);
  }
  nlohmann::json traps = nlohmann::json::array();
  for (const exec::TrapReport& trap : report.traps) {
    traps.push_back({{"scan", trap.scan},
                     {"code", stepwright::bytecode::name_of(trap.trap.code)},
                     {"id", trap.diagnostic.code},
                     {"file", trap.diagnostic.where.file},
                     {"line", trap.diagnostic.where.line},
                     {"column", trap.diagnostic.where.column},
                     {"message", trap.diagnostic.message},
                     {"function", trap.trap.function},
                     {"pc", trap.trap.pc}});
  }
  return {{"engine", engine},
          {"scans", report.scans},
          {"trace", std::move(traced)},
          {"traps", std::move(traps)},
          {"image_hash", hex(report.image_hash)},
          {"trace_hash", hex(report.trace_hash)}};
}

void print(const exec::ExecReport& report) {
  std::cout << report.scans << " scans, image " << hex(report.image_hash) << "\n";
  for (const auto& [name, values] : report.trace) {
    std::cout << name << ":";
    for (const reader::Value& value : values) std::cout << " " << to_json(value).dump();
    std::cout << "\n";
  }
}

int execute(const Arguments& arguments) {
  auto loaded = reader::LoadedProgram::load_file(arguments.image);
  if (!loaded) return process::fail(loaded.error(), ExitCode::BadInput);
  exec::ExecOptions options = arguments.options;
  std::optional<trace::CsvTrace> csv;
  if (!arguments.csv_file.empty()) {
    csv.emplace(arguments.csv_file);
    options.csv = &*csv;
  }
  const auto report = exec::run(*loaded, options);
  if (!report) return process::fail(report.error(), ExitCode::BadInput);
  if (csv) {
    if (auto written = csv->finish(); !written) return process::fail(written.error(), ExitCode::BadInput);
  }

  if (!arguments.json_file.empty()) {
    const std::string text = to_json(*report, arguments.engine).dump(2) + "\n";
    if (const auto failed = files::write_file(arguments.json_file, text); !failed.empty()) {
      return process::fail(failed, ExitCode::BadInput);
    }
  } else {
    print(*report);
  }
  for (const exec::TrapReport& trap : report->traps) {
    std::cerr << result::to_string(trap.diagnostic) << " (scan " << trap.scan << ")\n";
  }
  return to_int(report->traps.empty() ? ExitCode::Done : ExitCode::RuntimeFault);
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Run a compiled program without a clock: scan k of a task runs at (k-1) x its interval.",
               "stepwright exec");
  app.add_option("image", arguments.image, "container written by `stepwright compile`")->required();
  app.add_option("--scans", arguments.options.scans, "number of scans (default 1)");
  app.add_option("--engine", arguments.engine, "engine to run it with")
      ->check(CLI::IsMember({"vm", "native"}));
  app.add_option("--trace", arguments.trace,
                 "variables to record after every scan, e.g. MAIN.level,MAIN.pump");
  app.add_option("--csv", arguments.csv_file, "write these variables as a table, a row for each scan");
  app.add_option("--json", arguments.json_file, "write the report as JSON");
  if (const auto exit = process::parse(app, argc, argv)) return *exit;
  if (arguments.engine == "native") arguments.options.engine = stepwright::host::EngineKind::Native;
  arguments.options.trace = trace::split_names(arguments.trace);
  return execute(arguments);
}
