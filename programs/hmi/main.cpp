// `stepwright hmi --config CELL.toml [--port N]`: shows the cell in a browser. Attaches over Fast DDS only,
// so that it can come, go and fail without any effect on the scan.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <optional>
#include <string>
#include <thread>

#include "hmi_web/client/client_assets.h"
#include "hmi_web/server/cell_poller.h"
#include "hmi_web/server/http_server.h"
#include "programs/config/cell_options.h"
#include "programs/hmi/dds_cell_source.h"
#include "programs/hmi/plant_picture.h"
#include "programs/process/command_line.h"
#include "programs/process/stop_signal.h"
#include "runtime/result/exit_code.h"

namespace stepwright {
namespace {

using process::fail;
using result::ExitCode;

int run(const config::CellConfig& config) {
  const process::StopSignal stop;
  const hmi::PlantPicture picture = hmi::picture_of(config.plant);
  server::Feed feed({config.name, STEPWRIGHT_VERSION}, picture.synoptic);
  // The port first: it fails at once, and before anything else has begun.
  auto http = server::HttpServer::listen({config.hmi.host, config.hmi.port}, client::client_assets(), feed);
  if (!http) return fail(http.error(), ExitCode::BadInput);
  auto source = hmi::DdsCellSource::connect(config);
  if (!source) return fail(source.error(), ExitCode::RuntimeFault);

  std::thread network([&] { (*http)->run(); });
  {
    const server::CellPoller poller(**source, server::CellViewer(picture.sources), feed,
                                    [&] { (*http)->notify(); });
    std::printf("stepwright hmi: cell %s at http://%s:%u/\n", config.name.c_str(), config.hmi.host.c_str(),
                static_cast<unsigned>((*http)->port()));
    std::fflush(stdout);
    stop.wait();
  }
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
