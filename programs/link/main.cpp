// `stepwright link --config CELL.toml`: carries the service of the cell's runtime over Fast DDS. It may be
// killed and started at any time; the scan does not notice.

#include <CLI/CLI.hpp>
#include <cstdio>

#include "cell/config/cell_options.h"
#include "cell/config/dds_options.h"
#include "cell/config/reload_log.h"
#include "programs/link/bridge.h"
#include "programs/link/device_watch.h"
#include "runtime/ground/log/logger.h"
#include "runtime/ground/log/refused_samples.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/process/notify_socket.h"
#include "runtime/ground/process/reload_signal.h"
#include "runtime/ground/process/stop_signal.h"
#include "runtime/ground/result/exit_code.h"

namespace stepwright::link {
namespace {

using result::ExitCode;

int run(const config::CellConfig& config) {
  const process::StopSignal stop;
  process::ReloadSignal reload;
  process::NotifySocket init;
  auto log = log::Logger::open("link", config.log);
  if (!log) return process::fail(log.error(), ExitCode::BadInput);
  config::CellConfig running = config;
  dds::ParticipantConfig participant = config::participant_of(config.dds, "link");
  participant.on_trouble = log::refused_samples(**log);
  auto endpoint = dds::LinkEndpoint::create(participant);
  if (!endpoint) return process::fail(endpoint.error(), ExitCode::BadInput);
  const std::string between = "link of '" + config.name + "' between " + config.socket_path().string() +
                              " and Fast DDS domain " + std::to_string(config.dds.domain_id);
  (*log)->info("listens", between, {{"cell", config.name}, {"domain_id", config.dds.domain_id}});
  init.ready(between);
  const DeviceWatch devices(config);
  Bridge bridge(std::move(*endpoint), config.socket_path(), devices, **log);
  process::Heartbeat heartbeat(init);
  while (!stop.came()) {
    bridge.turn(stop.descriptor());
    if (reload.take()) config::reload_log(running, **log, init);
    heartbeat.turn();
    (*log)->tick();
  }
  init.stopping();
  (*log)->info("ends", "link of '" + config.name + "' ends");
  return to_int(ExitCode::Done);
}

}  // namespace
}  // namespace stepwright::link

int main(int argc, char** argv) {
  CLI::App app{"Carry the service of a runtime over Fast DDS", "stepwright link"};
  stepwright::config::CellOptions options;
  stepwright::config::add_cell_options(app, options);
  const auto config = stepwright::config::parse_cell(app, options, argc, argv);
  return config ? stepwright::link::run(*config) : config.error();
}
