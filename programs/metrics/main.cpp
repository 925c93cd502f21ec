// Commands for whoever attends a running runtime, over its service socket:
//   `stepwright metrics --config CELL.toml [-o FILE]`   its figures in the text form of Prometheus
//   `stepwright reload --config CELL.toml`              has it read its configuration again

#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <string>

#include "cell/config/cell_options.h"
#include "runtime/ground/files/files.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/result/exit_code.h"
#include "runtime/metrics/metrics_text.h"
#include "runtime/service/connection.h"

namespace stepwright::metrics_command {
namespace {

using process::fail;
using result::ExitCode;

constexpr std::chrono::seconds kPatience{5};

// The status comes with the greeting.
std::optional<host::RuntimeStatus> ask_status(const config::CellConfig& config) {
  auto connection = service::Connection::open(config.socket_path(), {.name = "metrics"});
  if (!connection) return std::nullopt;
  while (auto message = (*connection)->receive(kPatience)) {
    if (auto* status = std::get_if<host::RuntimeStatus>(&*message)) return std::move(*status);
  }
  return std::nullopt;
}

// A runtime that does not answer is a figure too; the exit code says it as well.
int run_metrics(const config::CellConfig& config, const std::string& file) {
  const auto status = ask_status(config);
  const std::array<metrics::RuntimeMetrics, 1> runtimes = {
      {{config.dds.runtime_id, status.has_value(), status}}};
  const std::string text = metrics::metrics_text(runtimes);
  if (file.empty()) {
    std::fputs(text.c_str(), stdout);
  } else if (const auto failed = files::write_file(file, text); !failed.empty()) {
    return fail(failed, ExitCode::BadInput);
  }
  return to_int(status ? ExitCode::Done : ExitCode::RuntimeFault);
}

int run_reload(const config::CellConfig& config) {
  auto connection =
      service::Connection::open(config.socket_path(), {.role = service::Role::Controller, .name = "reload"});
  if (!connection) return fail(connection.error(), ExitCode::RuntimeFault);
  auto reply = (*connection)->call(service::Reload{}, kPatience);
  if (!reply) return fail(reply.error(), ExitCode::BadInput);
  if (reply->problems.empty()) {
    std::puts("nothing has changed");
  } else {
    std::puts(result::to_string(reply->problems).c_str());
  }
  return to_int(ExitCode::Done);
}

// The running process reads the file, so that only the place of its socket is needed of it here: what is
// wrong with the rest is for the runtime to say.
int reload_main(int argc, char** argv) {
  CLI::App app{"Have a runtime read its configuration again", "stepwright reload"};
  config::CellOptions options;
  config::add_cell_options(app, options);
  if (const auto exit = process::parse(app, argc, argv)) return *exit;
  const config::CellReading cell = config::read_cell_config(options.config, options.overrides);
  // Of a file that is no TOML not even the socket is known; the runtime would refuse it as well.
  if (cell.config.state_dir.empty()) return fail(cell.problems, ExitCode::BadInput);
  return run_reload(cell.config);
}

int metrics_main(int argc, char** argv) {
  CLI::App app{"The figures of a runtime in the text form of Prometheus", "stepwright metrics"};
  config::CellOptions options;
  std::string file;
  config::add_cell_options(app, options);
  app.add_option("-o,--out", file,
                 "write them to this file, whole or not at all, instead of standard output");
  const auto config = config::parse_cell(app, options, argc, argv);
  return config ? run_metrics(*config, file) : config.error();
}

}  // namespace
}  // namespace stepwright::metrics_command

int main(int argc, char** argv) {
  const bool reload = argc > 1 && std::string(argv[1]) == "reload";
  return reload ? stepwright::metrics_command::reload_main(argc, argv)
                : stepwright::metrics_command::metrics_main(argc, argv);
}
