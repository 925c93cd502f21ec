// stepwright replay FILE [--engine vm|native|both] [--until SCAN] [--trace NAMES --csv FILE] [--json FILE]

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "runtime/ground/files/files.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/process/diagnostics_json.h"
#include "runtime/ground/result/counted.h"
#include "runtime/ground/result/exit_code.h"
#include "runtime/replay/replay_run.h"
#include "runtime/trace/value_json.h"

namespace stepwright::replay {
namespace {

using result::ExitCode;
using trace::hex;

struct Arguments {
  std::string file;
  std::string engine = "both";
  std::uint64_t until = 0;
  std::string trace;
  std::string csv_file;
  std::string json_file;
};

struct Outcome {
  std::string engine;
  RunResult result;

  const record::ReplayReport& report() const { return result.report; }
  double ratio() const {
    return result.wall_s > 0.0 ? static_cast<double>(report().simulated_ns) / 1e9 / result.wall_s : 0.0;
  }
};

nlohmann::json to_json(const record::Difference& difference) {
  nlohmann::json variables = nlohmann::json::array();
  for (const record::VariableDifference& variable : difference.variables) {
    variables.push_back(
        {{"name", variable.name}, {"recorded", variable.recorded}, {"replayed", variable.replayed}});
  }
  return {{"scan", difference.scan},
          {"what", difference.what},
          {"recorded", difference.recorded},
          {"replayed", difference.replayed},
          {"keyframe_scan", difference.keyframe_scan},
          {"variables", std::move(variables)}};
}

nlohmann::json to_json(const Outcome& outcome) {
  const record::ReplayReport& report = outcome.report();
  nlohmann::json json = {{"engine", outcome.engine},
                         {"equal", !report.difference},
                         {"first_scan", report.first_scan},
                         {"last_scan", report.last_scan},
                         {"scans", report.scans},
                         {"hashes", report.hashes},
                         {"keyframes", report.keyframes},
                         {"programs", report.programs},
                         {"starts", report.starts},
                         {"stops", report.stops},
                         {"commands", report.commands},
                         {"gaps", report.gaps},
                         {"ended", report.ended},
                         {"trace_hash", hex(report.trace_hash)},
                         {"simulated_s", static_cast<double>(report.simulated_ns) / 1e9},
                         {"wall_s", outcome.result.wall_s},
                         {"realtime_factor", outcome.ratio()},
                         {"problems", process::diagnostics_json(report.problems)}};
  if (report.difference) json["difference"] = to_json(*report.difference);
  if (report.trap) json["trap"] = result::to_string(*report.trap);
  return json;
}

void print(const Outcome& outcome) {
  const record::ReplayReport& report = outcome.report();
  std::printf(
      "%s: %s (%llu to %llu), %s and %s %s, trace %s; %g s in %.3f s, "
      "%.0f times real time\n",
      outcome.engine.c_str(), result::counted(report.scans, "scan", "scans").c_str(),
      static_cast<unsigned long long>(report.first_scan), static_cast<unsigned long long>(report.last_scan),
      result::counted(report.hashes, "hash", "hashes").c_str(),
      result::counted(report.keyframes, "image", "images").c_str(), report.difference ? "compared" : "equal",
      hex(report.trace_hash).c_str(), static_cast<double>(report.simulated_ns) / 1e9, outcome.result.wall_s,
      outcome.ratio());
  if (!report.difference) return;
  const record::Difference& difference = *report.difference;
  std::printf("  R0055: scan %llu differs: %s %s was recorded, %s came out\n",
              static_cast<unsigned long long>(difference.scan), difference.what.c_str(),
              difference.recorded.c_str(), difference.replayed.c_str());
  if (!difference.variables.empty()) {
    std::printf("  different in scan %llu:\n", static_cast<unsigned long long>(difference.keyframe_scan));
  }
  for (const record::VariableDifference& variable : difference.variables) {
    std::printf("    %s = %s, recorded %s\n", variable.name.c_str(), variable.replayed.c_str(),
                variable.recorded.c_str());
  }
}

// Differences are faults at run time; damage is wrong input.
ExitCode exit_code(const std::vector<Outcome>& outcomes) {
  ExitCode code = ExitCode::Done;
  for (const Outcome& outcome : outcomes) {
    if (outcome.report().difference) return ExitCode::RuntimeFault;
    if (result::has_errors(outcome.report().problems)) code = ExitCode::BadInput;
  }
  return code;
}

int execute(const Arguments& arguments) {
  std::vector<std::string> engines = {arguments.engine};
  if (arguments.engine == "both") engines = {"vm", "native"};
  std::vector<Outcome> outcomes;
  for (const std::string& engine : engines) {
    RunOptions options;
    options.file = arguments.file;
    options.engine = engine == "native" ? host::EngineKind::Native : host::EngineKind::Vm;
    options.until = arguments.until;
    if (outcomes.empty()) {
      options.trace = trace::asked(trace::split_names(arguments.trace));
      options.csv_file = arguments.csv_file;
    }
    auto result = run(options);
    if (!result) return process::fail(result.error(), ExitCode::BadInput);
    outcomes.push_back({engine, std::move(*result)});
    print(outcomes.back());
  }
  if (!outcomes.front().report().problems.empty()) {
    std::fprintf(stderr, "%s\n", result::to_string(outcomes.front().report().problems).c_str());
  }
  if (!arguments.json_file.empty()) {
    nlohmann::json engines_json = nlohmann::json::array();
    for (const Outcome& outcome : outcomes) engines_json.push_back(to_json(outcome));
    const nlohmann::json json = {{"file", arguments.file},
                                 {"equal", exit_code(outcomes) != ExitCode::RuntimeFault},
                                 {"engines", std::move(engines_json)}};
    const auto failed = files::write_file(arguments.json_file, json.dump(2) + "\n");
    if (!failed.empty()) return process::fail(failed, ExitCode::BadInput);
  }
  return to_int(exit_code(outcomes));
}

}  // namespace
}  // namespace stepwright::replay

int main(int argc, char** argv) {
  using namespace stepwright;
  replay::Arguments arguments;
  CLI::App app("Run a recording again and compare the image after every scan", "stepwright replay");
  app.add_option("file", arguments.file, "recording made by `stepwright record` or [record] file")
      ->required();
  app.add_option("--engine", arguments.engine, "engine to run it with (default: both, one after the other)")
      ->check(CLI::IsMember({"vm", "native", "both"}));
  app.add_option("--until", arguments.until, "the last scan to run");
  auto* traced = app.add_option("--trace", arguments.trace, "variables for --csv, e.g. MAIN.level,MAIN.pump");
  auto* csv =
      app.add_option("--csv", arguments.csv_file, "write the variables as a table, a row for each scan");
  traced->needs(csv);
  csv->needs(traced);
  app.add_option("--json", arguments.json_file, "write the report as JSON");
  app.footer(
      "Exit codes: 0 every image is the same, 1 the file is damaged or no recording, 2 usage,\n"
      "5 a scan differs.");
  if (const auto exit = process::parse(app, argc, argv)) return *exit;
  return replay::execute(arguments);
}
