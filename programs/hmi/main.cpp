// `stepwright hmi --config CELL.toml [--port N]`: shows the cell in a browser. Attaches over Fast DDS only,
// so that it can come, go and fail without any effect on the scan.

#include <CLI/CLI.hpp>
#include <chrono>
#include <optional>
#include <string>
#include <thread>

#include "hmi_web/client/client_assets.h"
#include "hmi_web/server/cell_poller.h"
#include "hmi_web/server/http_server.h"
#include "programs/config/cell_options.h"
#include "programs/hmi/dds_cell_source.h"
#include "programs/hmi/plant_picture.h"
#include "programs/hmi/runtime_watch.h"
#include "programs/log/logger.h"
#include "programs/log/reload_log.h"
#include "programs/process/command_line.h"
#include "programs/process/notify_socket.h"
#include "programs/process/reload_signal.h"
#include "programs/process/stop_signal.h"
#include "runtime/result/exit_code.h"

namespace stepwright {
namespace {

using process::fail;
using result::ExitCode;

constexpr std::chrono::milliseconds kTurn{200};

int run(const config::CellConfig& config) {
  const process::StopSignal stop;
  process::ReloadSignal reload;
  process::NotifySocket init;
  auto log = log::Logger::open("hmi", config.log);
  if (!log) return fail(log.error(), ExitCode::BadInput);
  config::CellConfig running = config;
  const auto picture = hmi::picture_of(config.plant);
  if (!picture) return fail(picture.error(), ExitCode::BadInput);
  server::Feed feed({config.name, STEPWRIGHT_VERSION}, picture->synoptic);
  // The port first: it fails at once, and before anything else has begun.
  auto http = server::HttpServer::listen({config.hmi.host, config.hmi.port}, client::client_assets(), feed);
  if (!http) return fail(http.error(), ExitCode::BadInput);
  auto source = hmi::DdsCellSource::connect(config, **log);
  if (!source) return fail(source.error(), ExitCode::RuntimeFault);

  auto watch = hmi::RuntimeWatch::connect(config, (*source)->runtime());
  if (!watch) return fail(watch.error(), ExitCode::RuntimeFault);
  (*http)->serve_metrics([&] { return (*watch)->metrics(); }, std::string(metrics::kContentType));

  std::thread network([&] { (*http)->run(); });
  {
    const server::CellPoller poller(**source, server::CellViewer(picture->sources), feed,
                                    [&] { (*http)->notify(); });
    const std::string address = "http://" + config.hmi.host + ":" + std::to_string((*http)->port()) + "/";
    (*log)->info("listens", "cell " + config.name + " at " + address,
                 {{"cell", config.name}, {"address", address}});
    init.ready(address);
    process::Heartbeat heartbeat(init);
    while (!stop.wait_for(kTurn)) {
      if (reload.take()) log::reload_log(running, **log, init);
      heartbeat.turn();
      (*log)->tick();
    }
  }
  init.stopping();
  (*http)->stop();
  network.join();
  return to_int(ExitCode::Done);
}

}  // namespace
}  // namespace stepwright

int main(int argc, char** argv) {
  CLI::App app{"Show the cell in a browser", "stepwright hmi"};
  stepwright::config::CellOptions options;
  std::optional<std::uint16_t> port;
  stepwright::config::add_cell_options(app, options);
  app.add_option("--port", port, "instead of hmi.port of the configuration; 0 takes any free port");
  auto config = stepwright::config::parse_cell(app, options, argc, argv);
  if (!config) return config.error();
  if (port) config->hmi.port = *port;
  return stepwright::run(*config);
}
