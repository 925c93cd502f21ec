// `stepwright hmi --config CELL.toml [--port N]`: shows the cell in a browser. Attaches over Fast DDS only,
// so that it can come, go and fail without any effect on the scan.

#include <CLI/CLI.hpp>
#include <csignal>
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
#include "runtime/result/exit_code.h"

namespace stepwright {
namespace {

using result::ExitCode;

int fail(const result::Diagnostics& diagnostics, ExitCode code) {
  std::fprintf(stderr, "%s\n", result::to_string(diagnostics).c_str());
  return to_int(code);
}

// Blocked before the first thread starts, so that all of them leave these signals to wait_for_end().
sigset_t block_end_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

void wait_for_end(const sigset_t& signals) {
  int signal = 0;
  sigwait(&signals, &signal);
}

int run(const config::CellConfig& config) {
  const sigset_t signals = block_end_signals();
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
    wait_for_end(signals);
  }
  (*http)->stop();
  network.join();
  return to_int(ExitCode::Done);
}

}  // namespace
}  // namespace stepwright

int main(int argc, char** argv) {
  using stepwright::result::ExitCode;
  CLI::App app{"Show the cell in a browser", "stepwright hmi"};
  stepwright::config::CellOptions options;
  std::optional<std::uint16_t> port;
  stepwright::config::add_cell_options(app, options);
  app.add_option("--port", port, "instead of hmi.port of the configuration; 0 takes any free port");
  try {
    app.parse(argc - 1, argv + 1);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : stepwright::result::to_int(ExitCode::Usage);
  }
  auto config = stepwright::config::load_or_report(options);
  if (!config) return stepwright::result::to_int(ExitCode::BadInput);
  if (port) config->hmi.port = *port;
  return stepwright::run(*config);
}
