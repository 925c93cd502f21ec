#include "programs/download/download_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "cell/config/cell_options.h"
#include "cell/monitor_check/missing_monitors.h"
#include "cell/processes/cell_record.h"
#include "programs/download/program_verdict.h"
#include "runtime/bytecode/writer/document_section.h"
#include "runtime/ground/files/files.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/process/diagnostics_json.h"
#include "runtime/ground/result/exit_code.h"
#include "runtime/service/connection.h"

namespace stepwright::download {
namespace {

using host::DownloadMode;
using host::RuntimeState;
using result::ExitCode;
using std::chrono::milliseconds;

// A large program takes a moment to verify and to turn into machine code, and longer on a serial line.
constexpr milliseconds kPatience{180'000};
constexpr milliseconds kGreeting{2'000};
constexpr milliseconds kTrial{60'000};  // for the first scans, which a long interval makes long

struct Arguments {
  std::string image;
  std::string json;
  bool change = false;
  bool restart_charts = false;
  bool replace = false;
  bool bring_in = false;
};

const char* name_of(DownloadMode mode) {
  switch (mode) {
    case DownloadMode::Replace:
      return "replace";
    case DownloadMode::Change:
      return "change";
    case DownloadMode::ChangeRestartCharts:
      return "restart_charts";
  }
  return "";
}

// The status that follows the greeting.
std::optional<host::RuntimeStatus> status_of(service::Connection& connection) {
  const auto deadline = std::chrono::steady_clock::now() + kGreeting;
  while (std::chrono::steady_clock::now() < deadline && !connection.closed()) {
    const auto message = connection.receive(milliseconds(100));
    if (!message) continue;
    if (const auto* status = std::get_if<host::RuntimeStatus>(&*message)) return *status;
  }
  return std::nullopt;
}

// Nobody stops a machine by leaving a word out.
result::Result<DownloadMode> mode_of(const Arguments& arguments, const host::RuntimeStatus& status) {
  if (arguments.change) return DownloadMode::Change;
  if (arguments.bring_in && status.state == RuntimeState::Running) return DownloadMode::Change;
  if (arguments.restart_charts) return DownloadMode::ChangeRestartCharts;
  if (arguments.replace || status.state != RuntimeState::Running) return DownloadMode::Replace;
  return result::fail("R0039", {}, "a program is running",
                      "say what becomes of it: --change (it goes on as the new one), --restart-charts (its "
                      "charts begin anew), or --replace (it stops, outputs are safe)");
}

nlohmann::json report(DownloadMode mode, const service::Reply& reply) {
  const host::ChangeReport& change = reply.change;
  return {{"mode", name_of(mode)},
          {"digest", reply.digest},
          {"carried", change.carried},
          {"initialised", change.initialised},
          {"dropped", change.dropped},
          {"retyped", change.retyped},
          {"dropped_forces", change.dropped_forces},
          {"pause_us", change.pause_us},
          {"diagnostics", process::diagnostics_json(reply.problems)}};
}

ExitCode write_report(const std::string& file, const nlohmann::json& json) {
  if (file.empty()) return ExitCode::Done;
  const result::Diagnostics unwritten = files::write_file(file, json.dump(2) + "\n");
  if (unwritten.empty()) return ExitCode::Done;
  static_cast<void>(process::fail(unwritten, ExitCode::RuntimeFault));
  return ExitCode::RuntimeFault;
}

int refuse(const Arguments& arguments, const result::Diagnostics& problems, ExitCode exit) {
  static_cast<void>(write_report(arguments.json, {{"diagnostics", process::diagnostics_json(problems)}}));
  return process::fail(problems, exit);
}

// What is brought in may be started next: that is told then.
void print(DownloadMode mode, const service::Reply& reply, bool bring_in) {
  result::Diagnostics warnings;
  std::copy_if(reply.problems.begin(), reply.problems.end(), std::back_inserter(warnings),
               [](const result::Diagnostic& each) { return each.severity == result::Severity::Warning; });
  if (!warnings.empty()) static_cast<void>(process::fail(warnings, ExitCode::Done));
  const std::string digest = reply.digest.substr(0, 12);
  if (mode == DownloadMode::Replace) {
    std::printf("%s is loaded%s\n", digest.c_str(), bring_in ? "" : "; it is stopped");
    return;
  }
  std::printf("%s took over within %.1f us\n", digest.c_str(), reply.change.pause_us);
  for (const result::Diagnostic& note : reply.problems) {
    if (note.severity == result::Severity::Note) std::printf("  %s\n", note.message.c_str());
  }
  if (reply.change.dropped_forces > 0)
    std::printf("  %u forces are gone with their variables\n", reply.change.dropped_forces);
}

// In words, and as the process ends.
ExitCode tell(const ProgramVerdict& verdict, DownloadMode mode) {
  switch (verdict.verdict) {
    case Verdict::Runs:
      return ExitCode::Done;
    case Verdict::TakenBack:
      std::fprintf(stderr, "R0040: it trapped on trial: %s; the program before goes on\n",
                   verdict.detail.c_str());
      return ExitCode::RuntimeFault;
    case Verdict::Fault:
      std::fprintf(stderr, "R0040: it is in fault: %s\n  hint: outputs are safe; bring in a mended program\n",
                   verdict.detail.c_str());
      return ExitCode::RuntimeFault;
    case Verdict::Open:
      break;
  }
  std::printf("it is not known whether it runs: %s; `stepwright status` says how it is\n",
              verdict.detail.c_str());
  return mode == DownloadMode::Replace ? ExitCode::RuntimeFault : ExitCode::BudgetExhausted;
}

// A program that a fault had ended, or that none was there before, starts as at a start of the cell.
ExitCode start(service::Connection& connection, const config::CellConfig& config,
               const host::RuntimeStatus& before) {
  const bool stopped = before.state == RuntimeState::Stopped;
  if (stopped || !config.boot.autostart) {
    std::printf("%s: `stepwright start --config %s` starts it\n",
                stopped ? "the program before was stopped" : "[runtime] autostart is not set",
                config.file.c_str());
    return ExitCode::BudgetExhausted;
  }
  const auto started = connection.call(service::Start{}, kPatience);
  if (started) return ExitCode::Done;
  static_cast<void>(process::fail(started.error(), ExitCode::RuntimeFault));
  std::printf("it is loaded and does not run: `stepwright start --config %s` starts it\n",
              config.file.c_str());
  return ExitCode::BudgetExhausted;
}

// Until the runtime has said what runs: after a change, and where this command starts the program.
ExitCode follow(service::Connection& connection, const config::CellConfig& config, const Arguments& arguments,
                DownloadMode mode, const host::RuntimeStatus& before, const std::string& digest) {
  if (mode == DownloadMode::Replace) {
    if (!arguments.bring_in) return ExitCode::Done;
    if (const ExitCode exit = start(connection, config, before); exit != ExitCode::Done) return exit;
  } else if (config.change.trial_scans == 0) {
    return ExitCode::Done;
  }
  return tell(await_verdict(connection, digest, std::max(config.change.trial_scans, 1u), kTrial), mode);
}

int download(const config::CellConfig& config, const Arguments& arguments) {
  const auto image = files::read_file(arguments.image);
  if (!image) return refuse(arguments, image.error(), ExitCode::BadInput);
  // What is no program is left to the runtime, which says why.
  const auto bytes = std::as_bytes(std::span(*image));
  if (const auto problems = cell_monitors::missing_monitors(config, bytes); !problems.empty())
    return refuse(arguments, problems, ExitCode::BadInput);
  if (const auto own = processes::check_state_folder(config); !own)
    return refuse(arguments, own.error(), ExitCode::BadInput);
  auto connection = service::Connection::open(config.socket_path(),
                                              {.role = service::Role::Controller, .name = "download"});
  if (!connection) return refuse(arguments, connection.error(), ExitCode::RuntimeFault);
  const auto status = status_of(**connection);
  if (!status) {
    return refuse(arguments,
                  {{"R0001",
                    result::Severity::Error,
                    {config.socket_path().string(), 0, 0},
                    "the runtime does not say how it is",
                    {}}},
                  ExitCode::RuntimeFault);
  }
  const auto mode = mode_of(arguments, *status);
  if (!mode) return refuse(arguments, mode.error(), ExitCode::BadInput);
  // A controller behind a gateway keeps programs in a small flash, and shows nobody their sources.
  const std::vector<std::byte> sent =
      config.controller.remote() ? writer::without_document(bytes) : std::vector(bytes.begin(), bytes.end());
  const auto reply = (*connection)->download(sent, *mode, kPatience);
  if (!reply) {
    return refuse(arguments, reply.error(),
                  (*connection)->closed() ? ExitCode::RuntimeFault : ExitCode::BadInput);
  }
  print(*mode, *reply, arguments.bring_in);
  const ExitCode verdict = follow(**connection, config, arguments, *mode, *status, reply->digest);
  const ExitCode written = write_report(arguments.json, report(*mode, *reply));
  return to_int(verdict == ExitCode::Done ? written : verdict);
}

}  // namespace

int run_download(int argc, char** argv) {
  CLI::App app{"Bring a compiled program to a running cell", "stepwright download"};
  config::CellOptions options;
  Arguments arguments;
  config::add_cell_options(app, options);
  app.add_option("image", arguments.image, "the program (stepwright compile)")->required();
  auto* change = app.add_flag("--change", arguments.change,
                              "the running program goes on as this one: values, steps and forces stay");
  auto* restart = app.add_flag("--restart-charts", arguments.restart_charts,
                               "the same, but every chart begins at its initial steps");
  auto* replace = app.add_flag("--replace", arguments.replace, "stop the running program and load this one");
  auto* bring_in =
      app.add_flag("--bring-in", arguments.bring_in,
                   "what `up --watch` does: change a running program; after a fault, replace the "
                   "program and start it");
  bring_in->excludes(change)->excludes(restart)->excludes(replace);
  change->excludes(restart)->excludes(replace);
  restart->excludes(replace);
  app.add_option("--json", arguments.json, "write a report to this file");
  app.footer(
      "Exit codes: 0 done, after a change when its first scans are over; 1 it is refused, and nothing has "
      "changed; 2 usage;\n4 it is brought in, and not known to run; 5 it trapped in its first scans, or the "
      "runtime does not answer.");
  const auto config = config::parse_cell(app, options, argc, argv);
  return config ? download(*config, arguments) : config.error();
}

}  // namespace stepwright::download
