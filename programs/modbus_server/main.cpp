// `stepwright modbus-server --config CELL.toml`: the variables of the cell's runtime over Modbus. It may be
// killed and started at any time, and so may the runtime: without one every request gets exception 4.

#include <CLI/CLI.hpp>
#include <cstdio>

#include "cell/config/cell_options.h"
#include "cell/config/reload_log.h"
#include "cell/metrics_server/metrics_server.h"
#include "cell/modbus_server/acceptors.h"
#include "cell/modbus_server/server_metrics.h"
#include "cell/modbus_server/tls_reload.h"
#include "runtime/ground/log/logger.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/process/notify_socket.h"
#include "runtime/ground/process/reload_signal.h"
#include "runtime/ground/process/stop_signal.h"
#include "runtime/ground/result/exit_code.h"
#include "runtime/modbus/server/runtime_data.h"
#include "runtime/modbus/server/server.h"

namespace stepwright::modbus_server {
namespace {

using namespace modbus::server;
using result::ExitCode;

constexpr std::chrono::milliseconds kTurn{100};
constexpr std::chrono::seconds kFiguresPeriod{60};

RuntimeDataOptions data_options(const config::CellConfig& config) {
  RuntimeDataOptions options;
  options.socket = config.socket_path();
  options.map = config.modbus_server.map;
  options.writes = Access(config.modbus_server.server.clients).any_writes();
  options.real_time = config.clock.mode == config::ClockMode::Real;
  options.stale_after = config.modbus_server.stale_after;
  options.write_timeout = config.modbus_server.write_timeout;
  return options;
}

ServerOptions server_options(const config::CellConfig& config) {
  ServerOptions options = config.modbus_server.server;
  options.identification = {"Stepwright",          "stepwright", STEPWRIGHT_VERSION, "",
                            "Stepwright soft PLC", "",           config.name};
  return options;
}

News to_log(log::Logger& log) {
  return [&log](const char* kind, const std::string& text, const result::Diagnostics& problems) {
    log.info(kind, text);
    for (const result::Diagnostic& problem : problems)
      log.warning(kind, result::to_string(problem), {{"code", problem.code}});
  };
}

void log_figures(const ServerFigures& figures, log::Logger& log) {
  std::uint64_t exceptions = 0;
  for (const std::uint64_t count : figures.exceptions) exceptions += count;
  log.info(
      "figures",
      std::to_string(figures.requests) + " requests, " + std::to_string(figures.connections) + " connections",
      {{"connections", figures.connections},
       {"accepted", figures.accepted},
       {"turned_away", figures.turned_away},
       {"dropped", figures.dropped},
       {"requests", figures.requests},
       {"writes", figures.writes},
       {"exceptions", exceptions},
       {"malformed", figures.malformed},
       {"service_p50_us", static_cast<double>(figures.service_time.percentile_ns(50'000)) / 1e3},
       {"service_p99_us", static_cast<double>(figures.service_time.percentile_ns(99'000)) / 1e3}});
}

ServerStatus status_of(const Server& server, RuntimeData& data, const TlsAcceptor* tls) {
  ServerStatus status{server.figures(), data.serving(), std::nullopt};
  if (tls != nullptr) status.certificate_ends = tls->context().expires();
  return status;
}

int run(const config::CellConfig& config) {
  const process::StopSignal stop;
  process::ReloadSignal reload;
  process::NotifySocket init;
  if (!config.modbus_server.enabled) {
    return process::fail({{"C0508",
                           result::Severity::Error,
                           {config.file.string(), 0, 0},
                           "the cell serves no Modbus",
                           "[modbus.server] enabled = true"}},
                         ExitCode::BadInput);
  }
  auto log = log::Logger::open("modbus-server", config.log);
  if (!log) return process::fail(log.error(), ExitCode::BadInput);
  config::CellConfig running = config;
  auto acceptors = open_acceptors(config.modbus_server, **log);
  if (!acceptors) return process::fail(acceptors.error(), ExitCode::BadInput);
  const std::string listens = "modbus-server of '" + config.name + "' listens on " + acceptors->names;
  auto data = RuntimeData::create(data_options(config), to_log(**log));
  if (!data) return process::fail(data.error(), ExitCode::RuntimeFault);
  auto server = Server::create(server_options(config), **data);
  if (!server) return process::fail(server.error(), ExitCode::RuntimeFault);
  for (auto& acceptor : acceptors->all) (*server)->add(std::move(acceptor));
  LatestStatus status;
  auto figures = metrics::MetricsServer::start(config.modbus_server.metrics, "modbus.server.metrics",
                                               [&] { return server_metrics(config.name, status.newest()); });
  if (!figures) return process::fail(figures.error(), ExitCode::BadInput);
  (*server)->watch(stop.descriptor());
  (*server)->watch(reload.descriptor());
  (*log)->info("listens", listens, {{"cell", config.name}, {"port", std::uint32_t{acceptors->port}}});
  if (!(*figures)->address().empty()) (*log)->info("metrics", "figures at " + (*figures)->address());
  if (acceptors->tls != nullptr)
    (*log)->info("tls", "the server's certificate ends " + expiry_text(acceptors->tls->context()));
  init.ready(listens);
  const config::ReloadPart reloaded = tls_part(acceptors->tls, **log);
  process::Heartbeat heartbeat(init);
  auto next_figures = Clock::now() + kFiguresPeriod;
  while (!stop.came()) {
    (*server)->run_for(kTurn);
    heartbeat.turn();
    status.publish(status_of(**server, **data, acceptors->tls));
    if (reload.take()) config::reload_log(running, **log, init, reloaded);
    (*log)->tick();
    if (Clock::now() < next_figures) continue;
    next_figures = Clock::now() + kFiguresPeriod;
    log_figures((*server)->figures(), **log);
  }
  init.stopping();
  log_figures((*server)->figures(), **log);
  (*log)->info("ends", "modbus-server of '" + config.name + "' ends");
  return to_int(ExitCode::Done);
}

}  // namespace
}  // namespace stepwright::modbus_server

int main(int argc, char** argv) {
  CLI::App app{"Serve the variables of a runtime over Modbus", "stepwright modbus-server"};
  stepwright::config::CellOptions options;
  stepwright::config::add_cell_options(app, options);
  bool concerned = false;
  app.add_flag("--concerned", concerned,
               "only tell by the exit code whether this cell serves Modbus: 0 yes, 1 no");
  if (const auto exit = stepwright::process::parse(app, argc, argv)) return *exit;
  if (concerned) {
    return to_int(stepwright::config::concerned(
        options, [](const stepwright::config::CellConfig& cell) { return cell.modbus_server.enabled; }));
  }
  const auto config = stepwright::config::load_cell(options);
  return config ? stepwright::modbus_server::run(*config) : config.error();
}
